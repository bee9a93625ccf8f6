#include "simulation/touch/tool_springs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/at.h"
#include "simulation/line/line_model.h"

namespace myotact::simulation {
namespace {

/// Stiffest spring that enters a solve [N/m]: above what any device can couple with, far below overflow.
constexpr double kStiffestSpring_N_m = 1e6;
/// Hardest pull of a spring [N]: five times what the strongest desk-top devices give. Harder ones are a broken
/// client's, and would keep the solver from balancing a step.
constexpr double kHardestPull_N = 200.0;
/// A target farther away than this is not a hand's [m].
constexpr double kFarthestTarget_m = 10.0;

bool usable_stiffness(double stiffness_N_m) {
  return stiffness_N_m > 0.0 && stiffness_N_m <= kStiffestSpring_N_m;
}
bool usable_target(const Vec3& target_m) {
  return target_m.allFinite() && target_m.norm() < kFarthestTarget_m;
}

bool usable_barycentric(const std::array<double, 3>& b) {
  return std::all_of(b.begin(), b.end(), [](double v) { return v >= -1.0 && v <= 2.0; });
}

const geometry::TriangleMesh* surface_of(const anatomy::Specimen& specimen, int surface) {
  const int muscles = static_cast<int>(specimen.muscles.size());
  if (surface < 0 || surface >= muscles + static_cast<int>(specimen.bones.size())) return nullptr;
  return surface < muscles ? &specimen.muscles[at(surface)].skin : &specimen.bones[at(surface - muscles)].surface;
}

std::optional<ToolSpring> contact_spring(const messages::ToolContact& contact, const TouchableParts& parts) {
  const geometry::TriangleMesh* surface = surface_of(parts.specimen, contact.surface);
  const bool usable = surface != nullptr && contact.triangle >= 0 && at(contact.triangle) < surface->triangles.size() &&
                      usable_stiffness(contact.stiffness_N_m) && usable_target(to_vec3(contact.target_world_m)) &&
                      usable_barycentric(contact.barycentric);
  if (!usable) return std::nullopt;
  ToolSpring spring;
  spring.surface = contact.surface;
  spring.target_W_m = to_vec3(contact.target_world_m);
  spring.stiffness_N_m = contact.stiffness_N_m;
  spring.normal_W = to_vec3(contact.normal_world);
  const std::array<int, 3>& triangle = surface->triangles[at(contact.triangle)];
  const int muscles = static_cast<int>(parts.specimen.muscles.size());
  if (contact.surface < muscles) {
    spring.muscle = contact.surface;
    spring.point = material_point(parts.skins[at(contact.surface)], triangle, contact.barycentric);
    return spring;
  }
  spring.body = parts.specimen.bones[at(contact.surface - muscles)].body;
  for (std::size_t c = 0; c < 3; ++c)
    spring.body_rest_m += contact.barycentric[c] * surface->positions_m[at(triangle[c])];
  return spring;
}

/// The spring, softened where it would pull harder than any hand from where its point is now.
ToolSpring bounded(ToolSpring spring, const Limb& limb) {
  const double length_m = (spring.target_W_m - spring_point(limb, spring)).norm();
  if (spring.stiffness_N_m * length_m > kHardestPull_N) spring.stiffness_N_m = kHardestPull_N / length_m;
  return spring;
}

/// The place of the line in the belly: nearest material point of its rest position.
MaterialPoint belly_point(const anatomy::MuscleLine& line, double fraction, const MuscleTissue& tissue) {
  const std::vector<Vec3> rest_m = line_points_L(line);
  const LinePlace place = place_at_fraction(rest_m, arc_fractions(rest_m), fraction);
  const geometry::TriangleMesh single{{place.position_m}, {}};
  const NodeWeights weights = embed_skin(single, tissue.mesh).vertices[0];
  MaterialPoint point;
  point.count = weights.count;
  std::copy(weights.nodes.begin(), weights.nodes.end(), point.nodes.begin());
  std::copy(weights.weights.begin(), weights.weights.end(), point.weights.begin());
  return point;
}

std::optional<ToolSpring> line_spring(const messages::ToolState& tool, const TouchableParts& parts, const Limb& limb) {
  const bool usable = tool.grabbed_line >= 0 && at(tool.grabbed_line) < parts.specimen.muscles.size() &&
                      std::isfinite(tool.grab_fraction) && usable_stiffness(tool.line_stiffness_N_m) &&
                      usable_target(to_vec3(tool.tool_position_world_m));
  if (!usable) return std::nullopt;
  const auto line = std::find_if(parts.specimen.lines.begin(), parts.specimen.lines.end(),
                                 [&](const anatomy::MuscleLine& l) { return l.muscle == tool.grabbed_line; });
  if (line == parts.specimen.lines.end()) return std::nullopt;
  ToolSpring spring;
  spring.muscle = tool.grabbed_line;
  spring.point = belly_point(*line, tool.grab_fraction, limb.muscles[at(tool.grabbed_line)].tissue);
  spring.target_W_m = to_vec3(tool.tool_position_world_m);
  spring.stiffness_N_m = tool.line_stiffness_N_m;
  return spring;
}

std::optional<ToolSpring> body_spring(const messages::ToolState& tool, const anatomy::Specimen& specimen) {
  const bool usable = tool.grabbed_body >= 0 && at(tool.grabbed_body) < specimen.bodies.size() &&
                      usable_stiffness(tool.body_stiffness_N_m) && usable_target(to_vec3(tool.body_target_world_m)) &&
                      usable_target(to_vec3(tool.body_point_rest_m));
  if (!usable) return std::nullopt;
  ToolSpring spring;
  spring.body = tool.grabbed_body;
  spring.body_rest_m = to_vec3(tool.body_point_rest_m);
  spring.target_W_m = to_vec3(tool.body_target_world_m);
  spring.stiffness_N_m = tool.body_stiffness_N_m;
  return spring;
}

/// The springs of one tool's contacts: of a sphere that they hold together, by one coupling, which is soft enough that
/// none of them pulls harder than a hand. Each triangle counts once; nothing lies beside no contact.
std::vector<ToolSpring> contact_springs(const messages::ToolState& tool, const TouchableParts& parts,
                                        const Limb& limb) {
  const std::optional<ToolSpring> first = contact_spring(tool.contact, parts);
  if (!first) return {};
  const auto place_of = [](const messages::ToolContact& contact) {
    return std::pair(contact.surface, contact.triangle);
  };
  std::vector<std::pair<std::int32_t, std::int32_t>> taken = {place_of(tool.contact)};
  std::vector<ToolSpring> springs = {bounded(*first, limb)};
  for (const messages::ToolContact& beside : tool.beside) {
    std::optional<ToolSpring> spring = contact_spring(beside, parts);
    if (!spring || std::find(taken.begin(), taken.end(), place_of(beside)) != taken.end()) continue;
    taken.push_back(place_of(beside));
    spring->stiffness_N_m = first->stiffness_N_m;
    springs.push_back(bounded(*spring, limb));
  }
  double coupling_N_m = first->stiffness_N_m;
  for (const ToolSpring& spring : springs) coupling_N_m = std::min(coupling_N_m, spring.stiffness_N_m);
  for (ToolSpring& spring : springs) spring.stiffness_N_m = coupling_N_m;
  return springs;
}

/// Of a spring ahead [N/m]: 15 nN over kAhead_m, a millionth of what a finger feels.
constexpr double kNoForce_N_m = 1e-6;

}  // namespace

std::vector<ToolSpring> springs_ahead(std::span<const messages::ToolState> tools, const TouchableParts& parts,
                                      const LocalPatch& patch) {
  std::vector<ToolSpring> springs;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const messages::ToolState& tool = tools[t];
    const Vec3 middle_m = to_vec3(tool.proxy_position_world_m);
    const bool free = tool.sequence > 0 && tool.contact.stiffness_N_m <= 0.0 && tool.grabbed_line < 0 &&
                      tool.grabbed_body < 0 && usable_target(middle_m);
    if (!free) continue;
    const LocalPatch::Place place = patch.nearest(middle_m, 0, kAhead_m);
    if (place.surface < 0) continue;
    std::optional<ToolSpring> spring = contact_spring(
        {place.surface, place.triangle, place.barycentric, {}, to_array(place.position_m), kNoForce_N_m}, parts);
    if (!spring) continue;
    spring->tool = static_cast<int>(t);
    spring->ahead = true;
    springs.push_back(*spring);
  }
  return springs;
}

std::vector<ToolSpring> tool_springs(std::span<const messages::ToolState> tools, const TouchableParts& parts,
                                     const Limb& limb) {
  std::vector<ToolSpring> springs;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const messages::ToolState& tool = tools[t];
    std::vector<ToolSpring> of_tool = contact_springs(tool, parts, limb);
    for (const std::optional<ToolSpring>& spring :
         {line_spring(tool, parts, limb), body_spring(tool, parts.specimen)}) {
      if (spring) of_tool.push_back(bounded(*spring, limb));
    }
    for (ToolSpring& spring : of_tool) {
      spring.tool = static_cast<int>(t);
      springs.push_back(spring);
    }
  }
  return springs;
}

}  // namespace myotact::simulation
