#include "view/overlay/opposing_pulls.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "view/look/posing.h"

namespace myotact::view {

namespace {

/// Of a line where it passes a joint.
struct Passing {
  glm::vec3 place_m{0.0f};
  glm::vec3 towards_origin{0.0f};  // unit; zero for a line without length
  float length_m = 0.0f;           // of the whole line
};

Passing passing_of(const std::vector<std::array<double, 3>>& line, const glm::vec3& centre_m) {
  Passing passing;
  float nearest_m = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const glm::vec3 a = to_glm(line[i]), way = to_glm(line[i + 1]) - a;
    const float length_m = glm::length(way);
    if (!(length_m > 0.0f)) continue;
    passing.length_m += length_m;
    const float share = std::clamp(glm::dot(centre_m - a, way) / (length_m * length_m), 0.0f, 1.0f);
    const glm::vec3 place_m = a + share * way;
    if (glm::distance(place_m, centre_m) >= nearest_m) continue;
    nearest_m = glm::distance(place_m, centre_m);
    passing.place_m = place_m;
    passing.towards_origin = -way / length_m;
  }
  return passing;
}

}  // namespace

std::array<GroupPull, 2> opposing_pulls(const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                                        int joint) {
  std::array<GroupPull, 2> groups;
  const auto index = static_cast<std::size_t>(joint);
  if (joint < 0 || index >= frame.joints.size() || index >= specimen.joints.size()) return groups;
  const anatomy::Joint& hinge = specimen.joints[index];
  const auto body = static_cast<std::size_t>(hinge.child);
  const glm::mat4 pose = body < frame.body_poses.size() ? to_glm(frame.body_poses[body]) : glm::mat4(1.0f);
  const glm::vec3 centre_m(pose * glm::vec4(to_glm(hinge.centre_m), 1.0f));
  std::array<float, 2> weights_N{};
  const auto& muscles = frame.joints[index].muscles;
  for (const anatomy::MuscleLine& line : specimen.lines) {
    const auto muscle = static_cast<std::size_t>(line.muscle);
    const auto row = static_cast<std::size_t>(&line - specimen.lines.data());
    if (muscle >= muscles.size() || muscle >= frame.tensions_N.size() || row >= frame.lines_world_m.size()) continue;
    if (muscles[muscle].torque_Nm == 0.0) continue;
    const Passing passing = passing_of(frame.lines_world_m[row], centre_m);
    const auto tension_N = static_cast<float>(frame.tensions_N[muscle]);
    const std::size_t side = muscles[muscle].torque_Nm > 0.0 ? 0 : 1;
    GroupPull& group = groups[side];
    const float weight_N = std::max(tension_N, 1e-6f);  // a slack group has its place, too
    group.place_m += weight_N * passing.place_m;
    group.force_N += tension_N * passing.towards_origin;
    group.full_N += static_cast<float>(specimen.muscles[muscle].peak_force_N);
    group.longest_m = std::max(group.longest_m, passing.length_m);
    weights_N[side] += weight_N;
  }
  for (std::size_t side = 0; side < groups.size(); ++side) {
    if (weights_N[side] > 0.0f) groups[side].place_m /= weights_N[side];
  }
  return groups;
}

}  // namespace myotact::view
