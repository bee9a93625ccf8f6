// The probe against closed forms: a plane, a ball, a rising plane; and everything that its files may hold.

#include "measure/probe/probe.h"

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/depth_inside.h"
#include "geometry/mesh_files.h"
#include "geometry/plain_surfaces.h"
#include "measure/fidelity/shapes.h"
#include "measure/probe/csv_rows.h"
#include "measure/probe/surface_side.h"
#include "measure/probe/surface_touch.h"
#include "support/allocation_guard.h"
#include "support/complaint.h"
#include "support/mutator.h"
#include "support/temporary_folder.h"

namespace myotact::measure {
namespace {

using testing::complaint;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// One row of the answer.
struct Row {
  std::array<double, 11> field{};
  double t_s() const { return field[0]; }
  Vec3 proxy_m() const { return {field[1], field[2], field[3]}; }
  Vec3 force_N() const { return {field[4], field[5], field[6]}; }
};

std::vector<Row> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "t_s,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N,contacts,rescues,inside,tick_us");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    Row row;
    std::istringstream fields(line);
    std::string field;
    for (double& value : row.field) {
      EXPECT_TRUE(std::getline(fields, field, ','));
      value = std::stod(field);
    }
    rows.push_back(row);
  }
  return rows;
}

bool go_on() {
  return true;
}

ProbeInput input_of(const geometry::TriangleMesh& surface, ProbePath path) {
  ProbeInput input;
  input.surface = &surface;
  input.path = std::move(path);
  input.contact.damping_Ns_m = 0.0;
  return input;
}

TEST(Probe, PressingAPlaneGivesStiffnessTimesDepth) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.1, 20);
  const ProbeInput input = input_of(plane, {{0.0, 0.1, 0.2}, {Vec3(0, 0, 0.01), Vec3(0, 0, 0.001), Vec3(0, 0, 0.001)}});
  const ProbeAnswer answer = run_probe(input, go_on);
  const std::vector<Row> rows = rows_of(answer.csv);
  ASSERT_EQ(rows.size(), 201u);
  EXPECT_NEAR(rows.back().force_N().z(), 800.0 * 2e-3, 1e-9);
  EXPECT_NEAR(rows.back().proxy_m().z(), 3e-3, 1e-9);
  EXPECT_EQ(answer.summary.inside, 0u);
  EXPECT_EQ(answer.summary.rescues, 0u);
}

TEST(Probe, RadiusZeroIsAPointOfATenthOfAMillimetre) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.1, 20);
  ProbeInput input = input_of(plane, {{0.0, 0.1}, {Vec3(0, 0, 0.005), Vec3(0, 0, -0.001)}});
  input.contact.radius_m = 0.0;
  const std::vector<Row> rows = rows_of(run_probe(input, go_on).csv);
  EXPECT_NEAR(rows.back().force_N().z(), 800.0 * 1.1e-3, 1e-9);
}

TEST(Probe, EveryRowTellsTheSurfaceAtItsOwnTime) {
  const TemporaryFolder folder;
  geometry::TriangleMesh plane = geometry::make_plane(0.04, 8);
  std::ofstream times(folder / "times.csv");
  times << "file, t_s\n";
  for (int frame = 0; frame < 3; ++frame) {  // z = 0, 2 mm, 1 mm at 0, 37, 80 ms
    geometry::TriangleMesh moved = plane;
    for (Vec3& x : moved.positions_m) x.z() += std::array{0.0, 2e-3, 1e-3}[static_cast<std::size_t>(frame)];
    geometry::write_ply(moved, folder / ("000" + std::to_string(frame) + ".ply"));
    times << "000" << frame << ".ply, " << std::array{"0", "0.037", "0.08"}[static_cast<std::size_t>(frame)] << "\n";
  }
  times.close();
  const ProbeFrames frames(folder.path());
  ProbeInput input = input_of(plane, {{0.0, 0.12}, {Vec3(0, 0, 2e-3), Vec3(1e-3, 0, 2e-3)}});
  input.frames = &frames;
  input.contact.static_friction = input.contact.dynamic_friction = 0.0;
  for (const Row& row : rows_of(run_probe(input, go_on).csv)) {
    const double t = row.t_s();
    const double height_m = t < 0.037 ? 2e-3 * t / 0.037 : std::max(1e-3, 2e-3 - 1e-3 * (t - 0.037) / 0.043);
    EXPECT_NEAR(row.proxy_m().z(), height_m + 3e-3, 1e-8) << t;
    EXPECT_NEAR(row.force_N().z(), 800.0 * (height_m + 1e-3), 1e-5) << t;
  }
}

TEST(Probe, AFineSurfaceIsFollowedWithoutLag) {
  const geometry::TriangleMesh ball =
      geometry::make_ball(0.025, 7);  // 327,680 triangles of 0.2 mm: a patch reaches 1.6 mm
  ProbePath path;
  for (int i = 0; i <= 60; ++i) {
    const double angle = 0.02 * i;  // 0.5 m/s
    path.t_s.push_back(1e-3 * i);
    path.position_m.push_back(0.0265 * Vec3(std::sin(angle), 0.0, std::cos(angle)));
  }
  ProbeInput input = input_of(ball, path);
  input.contact.static_friction = input.contact.dynamic_friction = 0.0;
  for (const Row& row : rows_of(run_probe(input, go_on).csv)) EXPECT_NEAR(row.force_N().norm(), 1.2, 0.03) << row.t_s();
}

TEST(Probe, TheSameInputGivesTheSameRows) {
  const geometry::TriangleMesh ball = geometry::make_ball(0.02, 3);
  const ProbeInput input =
      input_of(ball, {{0.0, 0.1, 0.3}, {Vec3(0, 0, 0.03), Vec3(0, 0, 0.02), Vec3(0.01, 0, 0.018)}});
  const std::vector<Row> first = rows_of(run_probe(input, go_on).csv), second = rows_of(run_probe(input, go_on).csv);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(std::equal(first[i].field.begin(), first[i].field.end() - 1, second[i].field.begin()));
  }
}

TEST(Probe, DegenerateAndTangledSurfacesGiveFiniteForces) {
  geometry::TriangleMesh mesh = geometry::make_ball(0.02, 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) mesh.triangles[t][2] = mesh.triangles[t][0];  // no area
  mesh.triangles.insert(mesh.triangles.end(), {{0, 1, 2}, {0, 2, 1}, {0, 1, 2}, {5, 5, 5}});
  const SurfaceDefects defects = find_defects(mesh);
  EXPECT_GT(defects.triangles_without_area, 100);
  EXPECT_GT(defects.non_manifold_edges, 0);
  const ProbeInput input =
      input_of(mesh, {{0.0, 0.1, 0.2, 0.3}, {Vec3(0, 0, 0.03), Vec3(0, 0, 0), Vec3(0, 0.02, 0), Vec3(0, 0, 0.03)}});
  const std::vector<Row> rows = rows_of(run_probe(input, go_on).csv);
  EXPECT_EQ(rows.size(), 301u);
  for (const Row& row : rows) {
    EXPECT_TRUE(row.proxy_m().allFinite());
    EXPECT_LE(row.force_N().norm(), kLargestProbeForce_N * (1.0 + 1e-12));
  }
}

TEST(Probe, AForceBeyondTheLimitIsCutAndCounted) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.1, 20);
  ProbeInput input = input_of(plane, {{0.0, 0.1}, {Vec3(0, 0, 0.01), Vec3(0, 0, -0.1)}});
  input.contact.stiffness_N_m = 10'000.0;
  const ProbeAnswer answer = run_probe(input, go_on);
  EXPECT_GT(answer.summary.limited, 0u);
  EXPECT_NEAR(rows_of(answer.csv).back().force_N().norm(), kLargestProbeForce_N, 1e-9);
}

TEST(ProbeSide, AgreesWithTheWindingNumber) {
  geometry::TriangleMesh ball = geometry::make_ball(0.02, 3);
  std::vector<Vec3> positions_m = ball.positions_m;
  swell(ball, {2e-3, 0.1, 0.3, 1.5e-3}, 0.1, positions_m);
  SurfaceSide side(ball);
  side.fit(positions_m, positions_m);
  EXPECT_TRUE(side.closed());
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const double u = 0.001 * i;
    const Vec3 p = 0.023 * std::cos(1.7 * u) * Vec3(std::sin(11.0 * u), std::cos(11.0 * u), std::sin(7.0 * u));
    const bool wound = geometry::winding_number(ball, positions_m, p) > 0.5;
    EXPECT_EQ(side.inside(p, positions_m), wound);
    inside += wound ? 1 : 0;
  }
  EXPECT_GT(inside, 300);
  EXPECT_LT(inside, 1700);
}

TEST(ProbeSide, OfAnOpenSurfaceIsBehindItButNotBeyondItsBorder) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.02, 4);
  const SurfaceSide side(plane);
  EXPECT_FALSE(side.closed());
  EXPECT_TRUE(side.inside(Vec3(1e-3, 2e-3, -1e-4), plane.positions_m));
  EXPECT_FALSE(side.inside(Vec3(1e-3, 2e-3, 1e-4), plane.positions_m));
  EXPECT_FALSE(side.inside(Vec3(0.02, 2e-3, -1e-4), plane.positions_m));
}

TEST(SurfaceTouch, TheProxysPartOfATickAllocatesNothing) {
  const geometry::TriangleMesh ball = geometry::make_ball(0.025, 4);
  SurfaceTouch touch(ball, {});
  touch.tick({Vec3(0, 0, 0.03), Vec3::Zero()}, 1'000'000);
  const support::AllocationGuard guard;
  for (int tick = 2; tick < 300; ++tick) {
    const double angle = 2e-3 * tick;
    touch.tick({0.026 * Vec3(std::sin(angle), 0.0, std::cos(angle)), Vec3::Zero()},
               1'000'000ULL * static_cast<std::uint64_t>(tick));
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

// ---- files

ProbePath path_of(const TemporaryFolder& folder, const std::string& text) {
  testing::write_quickly(folder / "path.csv", text);
  return load_path(folder / "path.csv");
}

TEST(ProbePath, IsReadWithBlanksEmptyLinesAndCarriageReturns) {
  const TemporaryFolder folder;
  const ProbePath path = path_of(folder, "\xef\xbb\xbft_s, x_m ,y_m,z_m\r\n0,0,0,+0.5\r\n\r\n 1e-1 ,\t0.1,0,0.5\r\n");
  ASSERT_EQ(path.t_s.size(), 2u);
  EXPECT_NEAR(path.at(0.05).x(), 0.05, 1e-15);
  EXPECT_EQ(path.at(-1.0), Vec3(0, 0, 0.5));
  EXPECT_EQ(path.at(9.0), Vec3(0.1, 0, 0.5));
}

TEST(ProbePath, WrongPathsNameLineValueRangeAndRemedy) {
  const TemporaryFolder folder;
  const auto text = [&](const std::string& rows) {
    return complaint(ExitStatus::BadData, [&] { path_of(folder, "t_s,x_m,y_m,z_m\n0,0,0,0\n" + rows); });
  };
  EXPECT_THAT(text("0.1,nan,0,0\n"), HasSubstr("path.csv: line 3: x_m is \"nan\"; must be a finite number"));
  EXPECT_THAT(text("0.1,0,0,1e999\n"), HasSubstr("line 3: z_m is \"1e999\""));
  EXPECT_THAT(text("0,0,0,0\n"), HasSubstr("line 3: t_s is 0 after 0; must rise"));
  EXPECT_THAT(text("-1,0,0,0\n"), HasSubstr("t_s is -1 after 0"));
  EXPECT_THAT(text("0.001,0.5,0,0\n"), HasSubstr("line 3: jumps by 0.5 m in 0.001 s; must move at 0 .. 10 m/s"));
  EXPECT_THAT(text("100,120,0,0\n"), HasSubstr("x_m is 120; must be in -10 .. 10 m; a path in millimetres"));
  EXPECT_THAT(text("0.1,0,0\n"), HasSubstr("line 3: has 3 fields; must have 4"));
  EXPECT_THAT(text("0.1,0,0,0,0,0,0,0,0,0,0\n"), HasSubstr("has 11 fields"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { path_of(folder, ""); }), HasSubstr("is empty"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { path_of(folder, "t_s,x_m,y_m,z_m\n"); }), HasSubstr("no points"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { path_of(folder, "time,x,y,z\n0,0,0,0\n"); }),
              HasSubstr("must be the column names \"t_s, x_m, y_m, z_m\""));
}

TEST(ProbePath, ATooLongOneIsRefusedBeforeItRuns) {
  const geometry::TriangleMesh plane = geometry::make_plane(0.1, 2);
  const ProbeInput input = input_of(plane, {{0.0, 1e9}, {Vec3(0, 0, 0.01), Vec3(0, 0, 0.01)}});
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { run_probe(input, go_on); }), HasSubstr("must be at most 2000000"));
}

TEST(ProbeFrames, WrongFramesAreRefused) {
  const TemporaryFolder folder;
  const geometry::TriangleMesh plane = geometry::make_plane(0.04, 4), finer = geometry::make_plane(0.04, 5);
  geometry::write_ply(plane, folder / "0000.ply");
  geometry::write_ply(finer, folder / "0001.ply");
  geometry::TriangleMesh turned = plane;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  geometry::write_ply(turned, folder / "0002.ply");
  const auto frames = [&](const std::string& rows) {
    testing::write_quickly(folder / "times.csv", "file,t_s\n" + rows);
    return ProbeFrames(folder.path());
  };
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { frames("0000.ply,0\n0009.ply,1\n"); }),
              HasSubstr("times.csv: line 3: there is no frame \"0009.ply\""));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { frames("../0000.ply,0\n"); }), HasSubstr("plain name"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { frames("0000.ply,1\n0000.ply,0.5\n"); }), HasSubstr("must rise"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { frames(""); }), HasSubstr("names no frames"));
  const ProbeFrames film = frames("0000.ply,0\n0001.ply,1\n0002.ply,2\n");
  EXPECT_EQ(film.positions_m(0, plane).size(), plane.positions_m.size());
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { film.positions_m(1, plane); }),
              HasSubstr("0001.ply: has 36 vertices; must have the 25"));
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { film.positions_m(2, plane); }), HasSubstr("triangle 3"));
  std::filesystem::remove(folder / "times.csv");
  EXPECT_THAT(complaint(ExitStatus::NoInput, [&] { ProbeFrames nothing(folder.path()); }), HasSubstr("times.csv"));
}

TEST(ProbeSurface, OneInMillimetresIsNoticed) {
  const TemporaryFolder folder;
  geometry::TriangleMesh ball = geometry::make_ball(40.0, 2);
  geometry::write_ply(ball, folder / "ball.ply");
  std::vector<std::string> notes;
  load_probe_surface(folder / "ball.ply", notes);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0], HasSubstr("millimetres"));
}

TEST(ProbeFuzz, BrokenTablesAreReadOrRefused) {
  const TemporaryFolder folder;
  geometry::write_ply(geometry::make_plane(0.04, 2), folder / "0000.ply");
  testing::Mutator mutator;
  int refused = 0;
  for (int round = 0; round < 1500; ++round) {
    try {
      const ProbePath path =
          path_of(folder, mutator.broken("t_s,x_m,y_m,z_m\n0,0,0,0.01\n0.001,1e-3,0,0.01\n0.5,0.1,-0.2,3\n"));
      for (const Vec3& p : path.position_m) EXPECT_LE(p.cwiseAbs().maxCoeff(), kFarthest_m);
      for (std::size_t i = 1; i < path.t_s.size(); ++i) EXPECT_GT(path.t_s[i], path.t_s[i - 1]);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData) << error.what();
      ++refused;
    }
    try {
      testing::write_quickly(folder / "times.csv", mutator.broken("file,t_s\n0000.ply,0\n0000.ply,0.5\n"));
      EXPECT_GE(ProbeFrames(folder.path()).count(), 1u);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace myotact::measure
