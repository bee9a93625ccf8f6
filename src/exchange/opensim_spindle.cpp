#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "core/at.h"
#include "exchange/opensim_convert.h"
#include "geometry/tet_topology.h"
#include "simulation/line/line_model.h"

namespace myotact::exchange::opensim {
namespace {

constexpr int kSections = 12, kCorners = 6;  // of a spindle: along it, round it
constexpr int kRing = kCorners + 1;          // nodes of a section, the last in its middle
constexpr double kSpecificTension_Pa = 300e3;
constexpr double kThinnest = 0.3;  // ends, over the middle

double profile(int section) {
  return kThinnest + (1.0 - kThinnest) * std::sin(std::numbers::pi * section / kSections);
}

/// Thickness in the middle [m] that gives the spindle the volume of the fibres: F0 lo over the specific tension.
double middle_radius_m(const anatomy::Muscle& muscle, double length_m) {
  double mean_square = 0.0;
  for (int s = 0; s < kSections; ++s) mean_square += 0.5 * (profile(s) * profile(s) + profile(s + 1) * profile(s + 1));
  mean_square /= kSections;
  const double volume_m3 = muscle.peak_force_N * muscle.optimal_fibre_m / kSpecificTension_Pa;
  const double radius_m = std::sqrt(volume_m3 / (std::numbers::pi * length_m * mean_square));
  return std::clamp(radius_m, 1e-4, 0.2 * length_m);
}

/// Three tets of the prism between two sections over one wedge (a, b: neighbours on the ring; the middle is the third).
void add_wedge(int section, int corner, geometry::TetMesh& mesh) {
  const int low = section * kRing, high = low + kRing;
  const int a = corner, b = (corner + 1) % kCorners, m = kCorners;
  // Diagonals from the lower of a and b, and from both to the middle above: neighbours agree.
  const int first = std::min(a, b), second = std::max(a, b);
  const std::array<std::array<int, 4>, 3> tets = {{{low + first, low + second, low + m, high + m},
                                                   {low + first, low + second, high + m, high + second},
                                                   {low + first, high + first, high + second, high + m}}};
  for (std::array<int, 4> tet : tets) {
    if (b != second) std::swap(tet[0], tet[1]);
    mesh.corners.push_back(tet);
  }
}

/// The sections' middles, evenly spread along the line.
std::vector<Vec3> middles_of(const std::vector<Vec3>& points_m) {
  const std::vector<double> fractions = simulation::arc_fractions(points_m);
  std::vector<Vec3> middles;
  for (int s = 0; s <= kSections; ++s) {
    middles.push_back(
        simulation::place_at_fraction(points_m, fractions, static_cast<double>(s) / kSections).position_m);
  }
  return middles;
}

void place_nodes(const std::vector<Vec3>& middles, double radius_m, geometry::TetMesh& mesh) {
  mesh.nodes_m.clear();
  Vec3 across = (middles[1] - middles[0]).unitOrthogonal();
  for (int s = 0; s <= kSections; ++s) {
    const Vec3 way = (middles[at(std::min(s + 1, kSections))] - middles[at(std::max(s - 1, 0))]).normalized();
    across -= across.dot(way) * way;
    across = across.norm() > 1e-6 ? Vec3(across.normalized()) : Vec3(way.unitOrthogonal());
    const Vec3 third = way.cross(across);
    for (int c = 0; c < kCorners; ++c) {
      const double angle_rad = 2.0 * std::numbers::pi * c / kCorners;
      mesh.nodes_m.push_back(middles[at(s)] +
                             radius_m * profile(s) * (std::cos(angle_rad) * across + std::sin(angle_rad) * third));
    }
    mesh.nodes_m.push_back(middles[at(s)]);
  }
}

bool has_volume(const geometry::TetMesh& mesh) {
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    if (!(geometry::corner_volume_m3(mesh, t) > 0.0)) return false;
  }
  return true;
}

void add_skin(anatomy::Muscle& muscle) {
  std::vector<int> vertex(muscle.tets.nodes_m.size(), -1);
  muscle.skin = {};
  for (const geometry::BoundaryTriangle& face : geometry::boundary_triangles(muscle.tets)) {
    std::array<int, 3> triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      int& index = vertex[at(face.corners[c])];
      if (index < 0) {
        index = static_cast<int>(muscle.skin.positions_m.size());
        muscle.skin.positions_m.push_back(muscle.tets.nodes_m[at(face.corners[c])]);
      }
      triangle[c] = index;
    }
    muscle.skin.triangles.push_back(triangle);
  }
}

/// False where that cannot be done, however thin.
bool make_tets(const std::vector<Vec3>& middles, anatomy::Muscle& muscle, double& radius_m) {
  double length_m = 0.0;
  for (std::size_t s = 1; s < middles.size(); ++s) length_m += (middles[s] - middles[s - 1]).norm();
  if (!(length_m > 1e-4) || !std::isfinite(length_m)) return false;
  muscle.tets = {};
  for (int s = 0; s < kSections; ++s) {
    for (int c = 0; c < kCorners; ++c) add_wedge(s, c, muscle.tets);
  }
  // Where the line bends sharply, a thick spindle would fold; a thin one does not.
  constexpr int kMostHalvings = 12;
  radius_m = middle_radius_m(muscle, length_m);
  int halvings = 0;
  for (place_nodes(middles, radius_m, muscle.tets); !has_volume(muscle.tets) && halvings < kMostHalvings; ++halvings) {
    radius_m *= 0.5;
    place_nodes(middles, radius_m, muscle.tets);
  }
  return has_volume(muscle.tets);
}

}  // namespace

bool draw_spindle(const anatomy::MuscleLine& line, anatomy::Muscle& muscle) {
  double radius_m = 0.0;
  std::vector<Vec3> middles = middles_of(simulation::line_points_L(line));
  if (!make_tets(middles, muscle, radius_m)) {  // a line that turns back on itself: straight from end to end
    middles = middles_of({line.points.front().position_m, line.points.back().position_m});
    if (!make_tets(middles, muscle, radius_m)) return false;
  }
  for (std::size_t t = 0; t < muscle.tets.corners.size(); ++t) {
    const int section = static_cast<int>(t) / (3 * kCorners);
    const double here_m = radius_m * 0.5 * (profile(section) + profile(section + 1));
    muscle.fibres.push_back((middles[at(section + 1)] - middles[at(section)]).normalized());
    muscle.sections_m2.push_back(std::numbers::pi * here_m * here_m);
    muscle.regions.push_back(anatomy::TissueRegion::Belly);
  }
  muscle.attachments.assign(muscle.tets.nodes_m.size(), -1);
  for (int n = 0; n < kRing; ++n) {
    muscle.attachments[at(n)] = line.points.front().body;
    muscle.attachments[at(kSections * kRing + n)] = line.points.back().body;
  }
  add_skin(muscle);
  return true;
}

}  // namespace myotact::exchange::opensim
