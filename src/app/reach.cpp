#include "app/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/scripted_hand.h"

namespace myotact::app {

namespace {

constexpr double kBeam_m = 0.006;  // half the width of a skin's triangles and the tool together
constexpr double kNothing_m = -std::numeric_limits<double>::infinity();

/// How far out along the ray the points reach that lie within the beam about it.
class Beam {
 public:
  Beam(const Vec3& origin_m, const Vec3& direction) : origin_m_(origin_m), direction_(direction) {}

  void add(const Vec3& point_m) {
    const Vec3 offset_m = point_m - origin_m_;
    const double along_m = offset_m.dot(direction_);
    if ((offset_m - along_m * direction_).squaredNorm() > kBeam_m * kBeam_m) return;
    outermost_m = std::max(outermost_m, along_m);
  }

  double outermost_m = kNothing_m;

 private:
  Vec3 origin_m_, direction_;
};

double clearance_m(int muscle, const Reach& reach, const anatomy::Specimen& specimen,
                   const simulation::Simulation& simulation) {
  const Vec3 origin_m = scene::point_at_fraction(simulation.line_world_m(muscle), reach.at);
  Beam own(origin_m, reach.from), others(origin_m, reach.from);
  for (int m = 0; m < simulation.muscle_count(); ++m) {
    for (const Vec3& point_m : simulation.skin_world_m(m)) (m == muscle ? own : others).add(point_m);
  }
  for (const anatomy::Bone& bone : specimen.bones) {
    const Pose pose = simulation.body_pose(bone.body);
    for (const Vec3& rest_m : bone.surface.positions_m) others.add(pose * rest_m);
  }
  return own.outermost_m > 0.0 ? own.outermost_m - std::max(0.0, others.outermost_m) : kNothing_m;
}

}  // namespace

std::vector<Reach> reaches_of(int muscle, const anatomy::Specimen& specimen, const simulation::Simulation& simulation) {
  constexpr int kDirections = 12, kTenths = 10;
  constexpr double kFullTurn_rad = 6.283185307179586;
  std::vector<Reach> reaches;
  for (int tenth = 1; tenth < kTenths; ++tenth) {
    for (int d = 0; d < kDirections; ++d) {
      const double angle_rad = kFullTurn_rad * d / kDirections;
      Reach reach{static_cast<double>(tenth) / kTenths, Vec3(std::cos(angle_rad), std::sin(angle_rad), 0.0), 0.0};
      reach.clear_m = clearance_m(muscle, reach, specimen, simulation);
      if (reach.clear_m > 0.0) reaches.push_back(reach);
    }
  }
  std::stable_sort(reaches.begin(), reaches.end(),
                   [](const Reach& a, const Reach& b) { return a.clear_m > b.clear_m; });
  return reaches;
}

}  // namespace myotact::app
