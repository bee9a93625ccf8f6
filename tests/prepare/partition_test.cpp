#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <set>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/measure/share_out.h"
#include "prepare/part/film.h"
#include "prepare/partition/cut_parts.h"
#include "prepare/partition/interfaces.h"
#include "prepare/partition/part_volume_file.h"
#include "prepare/partition/smooth_interfaces.h"
#include "prepare/partition/smooth_labels.h"
#include "prepare/surface/surface_pieces.h"
#include "prepare/volume/read_label_volume.h"
#include "support/temporary_folder.h"

// Volumes of shapes whose measures are known in closed form.

namespace myotact::prepare {
namespace {

using geometry::TriangleMesh;
using Depth = std::function<double(const Vec3&)>;  // of a place in a body [m], negative outside

Lattice cube_lattice(int points, double step_m) {
  Lattice lattice;
  lattice.counts = {points, points, points};
  lattice.steps_m = step_m * Mat3::Identity();
  lattice.origin_m = Vec3::Constant(-0.5 * (points - 1) * step_m);
  return lattice;
}

Depth ball(const Vec3& middle_m, double radius_m) {
  return [=](const Vec3& p) { return radius_m - (p - middle_m).norm(); };
}

Depth ring(double radius_m, double thickness_m) {
  return [=](const Vec3& p) { return thickness_m - std::hypot(std::hypot(p.x(), p.y()) - radius_m, p.z()); };
}

/// Claims with the radius given, as sample_depths() would find them.
Claim claim(const Lattice& lattice, const std::string& key, const Depth& depth, double radius_m) {
  Claim claim{key, false, {}};
  for (std::size_t point = 0; point < lattice.size(); ++point) {
    const double steps = depth(place_m(lattice, point)) / step_m(lattice);
    if (steps < -kDepthBand) continue;
    claim.samples.push_back(
        {static_cast<std::uint32_t>(point), static_cast<float>(steps), static_cast<float>(radius_m / step_m(lattice))});
  }
  return claim;
}

PartVolume volume_of(const Lattice& lattice, const std::vector<Claim>& claims) {
  std::vector<Share> shares;
  return share_out(lattice, claims, shares);
}

/// Two balls of 8 mm that reach 3 mm into each other.
PartVolume two_balls() {
  const Lattice lattice = cube_lattice(44, 1e-3);
  return volume_of(lattice, {claim(lattice, "a", ball({-6.5e-3, 0, 0}, 8e-3), 8e-3),
                             claim(lattice, "b", ball({6.5e-3, 0, 0}, 8e-3), 8e-3)});
}

double ball_m3(double radius_m) {
  return 4.0 / 3.0 * std::numbers::pi * std::pow(radius_m, 3);
}

/// Volume of a ball's cap of that height.
double cap_m3(double radius_m, double height_m) {
  return std::numbers::pi * height_m * height_m * (radius_m - height_m / 3.0);
}

void expect_whole(const TriangleMesh& surface, int handles) {
  EXPECT_EQ(geometry::bad_edge_count(surface), 0);
  EXPECT_EQ(pieces_of(surface).size(), 1U);
  EXPECT_EQ(genus(surface), handles);
}

TEST(Partition, OverlappingBallsMeetHalfWay) {
  const CutParts parts = cut_parts(two_balls(), 2);
  const double expected_m3 = ball_m3(8e-3) - cap_m3(8e-3, 1.5e-3);
  for (const auto* surfaces : {&parts.fine, &parts.skins}) {
    for (const TriangleMesh& surface : *surfaces) {
      expect_whole(surface, 0);
      EXPECT_NEAR(geometry::enclosed_volume_m3(surface) / expected_m3, 1.0, 0.01);
      for (const Vec3& p : surface.positions_m) {
        const double off_m =
            std::abs(std::min((p - Vec3(-6.5e-3, 0, 0)).norm(), (p - Vec3(6.5e-3, 0, 0)).norm()) - 8e-3);
        EXPECT_LT(std::min(off_m, std::abs(p.x())), 5e-4);
      }
    }
  }
}

/// Area on which the two surfaces lie on each other, triangle by triangle.
double shared_m2(const TriangleMesh& a, const TriangleMesh& b) {
  const auto place = [](const TriangleMesh& mesh, const std::array<int, 3>& t) {
    std::array<std::array<double, 3>, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions_m[static_cast<std::size_t>(t[k])];
      corners[k] = {p.x(), p.y(), p.z()};
    }
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  std::set<std::array<std::array<double, 3>, 3>> of_a;
  for (const auto& t : a.triangles) of_a.insert(place(a, t));
  TriangleMesh shared{b.positions_m, {}};
  for (const auto& t : b.triangles) {
    if (of_a.contains(place(b, t))) shared.triangles.push_back(t);
  }
  return geometry::surface_area_m2(shared);
}

TEST(Partition, NeighboursShareTheirTriangles) {
  const CutParts parts = cut_parts(two_balls(), 2);
  const double disc_m = std::sqrt(8e-3 * 8e-3 - 6.5e-3 * 6.5e-3);  // radius of the disc on which they meet
  const double close_m = 7e-4;  // of a step: in the crevice round the disc no point belongs to nothing
  EXPECT_NEAR(std::sqrt(shared_m2(parts.fine[0], parts.fine[1]) / std::numbers::pi), disc_m, close_m);
  EXPECT_NEAR(std::sqrt(shared_m2(parts.skins[0], parts.skins[1]) / std::numbers::pi), disc_m, close_m);
}

/// Round a line through a place, askew to the lattice.
const Vec3 kAlong = Vec3(1.0, 0.37, 0.21).normalized();

Depth tube(const Vec3& middle_m, double radius_m) {
  return [=](const Vec3& p) {
    const Vec3 away_m = p - middle_m;
    return std::min(radius_m - (away_m - kAlong * kAlong.dot(away_m)).norm(), 12e-3 - std::abs(kAlong.dot(away_m)));
  };
}

TEST(Partition, ThinTendonsStayInOnePiece) {
  const Lattice lattice = cube_lattice(40, 1e-3);
  Claim thin = claim(lattice, "tendon", tube({0.3e-3, 0.2e-3, 0.4e-3}, 0.5e-3), 0.5e-3);
  const PartVolume before = volume_of(lattice, {thin});
  EXPECT_GT(pieces_of(surfaces_of(cut_interfaces(before), 1)[0]).size(), 1U);
  thicken(thin.samples);
  const CutParts parts = cut_parts(volume_of(lattice, {thin}), 1);
  expect_whole(parts.skins[0], 0);
  const double length_m = 24e-3, radius_m = kLeastRadius * 1e-3;  // longer at both ends by what it is thicker
  const double expected_m3 = std::numbers::pi * radius_m * radius_m * (length_m + 2.0 * (radius_m - 0.5e-3));
  EXPECT_NEAR(geometry::enclosed_volume_m3(parts.skins[0]) / expected_m3, 1.0, 0.13);  // 2.4 steps thick
}

/// Length of the lines where two tubes and the free meet, away from the tubes' ends [m]: longer, the more jagged.
double line_length_m(const Interfaces& interfaces) {
  std::map<std::pair<int, int>, std::set<std::uint16_t>> labels;  // by edge
  for (const auto& [vertices, inner, outer] : interfaces.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto ends = std::minmax(vertices[k], vertices[(k + 1) % 3]);
      labels[{ends.first, ends.second}].insert({inner, outer});
    }
  }
  double length_m = 0.0;
  for (const auto& [edge, meeting] : labels) {
    const Vec3& p = interfaces.positions_m[static_cast<std::size_t>(edge.first)];
    const Vec3& q = interfaces.positions_m[static_cast<std::size_t>(edge.second)];
    if (meeting.size() == 3 && std::abs(kAlong.dot(p + q)) < 16e-3) length_m += (p - q).norm();
  }
  return length_m;
}

TEST(Partition, LinesWhereThreeMeetAreEvened) {
  const Lattice lattice = cube_lattice(40, 1e-3);
  const Vec3 across = kAlong.cross(Vec3(0.2, -0.3, 1.0)).normalized();
  const auto half = [&](const char* key, double side) {
    return claim(lattice, key, tube(0.8e-3 * side * across, 1.2e-3), 1.2e-3);
  };
  const PartVolume volume = volume_of(lattice, {half("superficial", 1.0), half("deep", -1.0)});
  const Interfaces cut = cut_interfaces(volume), smooth = smooth_interfaces(cut);
  const double straight_m = 2.0 * 16e-3;
  EXPECT_LT(line_length_m(smooth) - straight_m, 0.5 * (line_length_m(cut) - straight_m));
  const auto before = surfaces_of(cut, 2), after = surfaces_of(smooth, 2);
  for (std::size_t part = 0; part < 2; ++part) {
    const double ratio = geometry::enclosed_volume_m3(after[part]) / geometry::enclosed_volume_m3(before[part]);
    EXPECT_NEAR(ratio, 1.0, 0.05);
    EXPECT_EQ(before[part].triangles, after[part].triangles);
  }
}

TEST(Partition, KeepsHandles) {
  const Lattice lattice = cube_lattice(40, 1e-3);
  const CutParts parts = cut_parts(volume_of(lattice, {claim(lattice, "ring", ring(12e-3, 4e-3), 4e-3)}), 1);
  expect_whole(parts.skins[0], 1);
  const double expected_m3 = 2.0 * std::numbers::pi * std::numbers::pi * 12e-3 * 4e-3 * 4e-3;
  EXPECT_NEAR(geometry::enclosed_volume_m3(parts.skins[0]) / expected_m3, 1.0, 0.015);
}

TEST(Partition, DoesNotDependOnThreads) {
  const PartVolume volume = two_balls();
  const CutParts one = cut_parts(volume, 1), three = cut_parts(volume, 3);
  EXPECT_EQ(one.skins[0].positions_m, three.skins[0].positions_m);
  EXPECT_EQ(one.skins[1].triangles, three.skins[1].triangles);
}

/// A point where three parts and nothing meet has neither gap nor overlap: the parts' volumes add up to the whole's.
TEST(Partition, ThreePartsLeaveNoGap) {
  const Lattice lattice = cube_lattice(44, 1e-3);
  const Depth whole = ball(Vec3::Zero(), 15e-3);
  PartVolume volume = volume_of(lattice, {claim(lattice, "whole", whole, 15e-3)});
  const double whole_m3 = geometry::enclosed_volume_m3(surfaces_of(cut_interfaces(volume), 1)[0]);
  volume.keys = {"a", "b", "c"};
  for (std::size_t point = 0; point < volume.labels.size(); ++point) {
    if (volume.labels[point] == 0) continue;
    const Vec3 p = place_m(lattice, point);
    volume.labels[point] = p.x() > 0.0 ? 1 : p.y() > 0.0 ? 2 : 3;
  }
  double sum_m3 = 0.0;
  for (const TriangleMesh& surface : surfaces_of(cut_interfaces(volume), 3)) {
    expect_whole(surface, 0);
    sum_m3 += geometry::enclosed_volume_m3(surface);
  }
  // The whole's outer surface cuts where three meet a little otherwise.
  EXPECT_NEAR(sum_m3 / whole_m3, 1.0, 2e-3);
}

TEST(ShareOut, AThinBodyInsideAThickOneKeepsItsShare) {
  const Lattice lattice = cube_lattice(44, 1e-3);
  std::vector<Share> shares;
  share_out(lattice,
            {claim(lattice, "thick", ball(Vec3::Zero(), 16e-3), 16e-3),
             claim(lattice, "thin", ball({6e-3, 0, 0}, 4e-3), 4e-3)},
            shares);
  EXPECT_GE(static_cast<double>(shares[1].kept), kLeastShare * static_cast<double>(shares[1].claimed));
  EXPECT_EQ(shares[0].kept + shares[1].kept, shares[0].claimed);
}

/// A segmentation of a ball and a sheet of two voxels beside it, voxels of 1 x 1 x 2 mm, turned about all axes.
LabelVolume ball_and_sheet() {
  LabelVolume volume;
  volume.lattice.counts = {60, 60, 30};
  const Mat3 turned = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  volume.lattice.steps_m = turned * Vec3(1e-3, 1e-3, 2e-3).asDiagonal();
  volume.lattice.origin_m = {0.3, -0.1, 0.2};
  volume.layers.emplace_back(volume.lattice.size(), std::uint16_t{0});
  for (std::size_t point = 0; point < volume.lattice.size(); ++point) {
    const auto [x, y, z] = index_of(volume.lattice.counts, point);
    if ((Vec3(x, y, 2.0 * z) - Vec3(25, 30, 30)).norm() < 15.0) volume.layers[0][point] = 7;
    if ((x == 45 || x == 46) && y > 15 && y < 45 && z > 7 && z < 22) volume.layers[0][point] = 300;
  }
  volume.segments = {{"ball", 7, 0, {}}, {"sheet", 300, 0, {}}};
  return volume;
}

TEST(SmoothLabels, KeepsVolumesOnObliqueUnequalLattices) {
  std::vector<SmoothedPart> parts;
  const PartVolume volume = smooth_labels(ball_and_sheet(), {{"ball", 7, 0}, {"sheet", 300, 0}}, 1e6, 2, parts);
  const CutParts cut = cut_parts(volume, 2);
  EXPECT_NEAR(geometry::enclosed_volume_m3(cut.fine[0]) / ball_m3(15e-3), 1.0, 0.03);
  EXPECT_NEAR(geometry::enclosed_volume_m3(cut.fine[1]) / parts[1].voxels_m3, 1.0, 0.15);
  for (const TriangleMesh& surface : cut.skins) expect_whole(surface, 0);
  Vec3 middle_m = Vec3::Zero();
  for (const Vec3& p : cut.fine[0].positions_m) middle_m += p / static_cast<double>(cut.fine[0].positions_m.size());
  const LabelVolume source = ball_and_sheet();
  EXPECT_LT((middle_m - place_m(source.lattice, Vec3(25, 30, 15))).norm(), 6e-4);
}

TEST(PartVolumeFile, ComesBackAsItWas) {
  const testing::TemporaryFolder folder;
  const PartVolume volume = two_balls();
  const std::filesystem::path file = folder.path() / "balls.seg.nrrd";
  write_part_volume(file, volume);
  const LabelVolume read = read_label_volume(file);
  ASSERT_EQ(read.layers[0], volume.labels);
  const auto margins = read_margins(file, read.lattice, read.layers[0]);
  ASSERT_TRUE(margins);
  const PartVolume again{read.lattice, volume.keys, read.layers[0], *margins};
  const auto before = surfaces_of(cut_interfaces(volume), 2), after = surfaces_of(cut_interfaces(again), 2);
  ASSERT_EQ(before[0].triangles, after[0].triangles);
  for (std::size_t v = 0; v < before[0].positions_m.size(); ++v) {
    EXPECT_LT((before[0].positions_m[v] - after[0].positions_m[v]).norm(), 1e-4);
  }
}

TEST(PartVolumeFile, RefusesMarginsOfAnotherVolume) {
  const testing::TemporaryFolder folder;
  PartVolume volume = two_balls();
  const std::filesystem::path file = folder.path() / "balls.seg.nrrd";
  write_part_volume(file, volume);
  std::replace(volume.labels.begin(), volume.labels.end(), std::uint16_t{2}, std::uint16_t{0});
  EXPECT_THROW(read_margins(file, volume.lattice, volume.labels), Error);
}

}  // namespace
}  // namespace myotact::prepare
