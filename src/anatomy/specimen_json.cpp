#include "anatomy/specimen_json.h"

#include "core/at.h"

namespace myotact::anatomy {

Json json_of(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json json_of(const Body& body) {
  return {{"key", body.key},
          {"mass_kg", body.mass_kg},
          {"com_m", json_of(body.com_m)},
          {"inertia_kg_m2", body.inertia_kg_m2},
          {"estimated", body.estimated}};
}

Json json_of(const Joint& joint, const std::vector<Body>& bodies) {
  static constexpr const char* kTypes[] = {"hinge", "universal", "ball", "weld"};
  Json axes = Json::array();
  for (const Vec3& axis : joint.axes) axes.push_back(json_of(axis));
  Json ranges = Json::array();
  for (const auto& [lowest, highest] : joint.range_rad) ranges.push_back(Json::array({lowest, highest}));
  return {{"key", joint.key},
          {"type", kTypes[static_cast<int>(joint.type)]},
          {"parent", bodies[at(joint.parent)].key},
          {"child", bodies[at(joint.child)].key},
          {"centre_m", json_of(joint.centre_m)},
          {"axes", axes},
          {"range_rad", ranges},
          {"stiffness_Nm_rad", joint.stiffness_Nm_rad},
          {"damping_Nms_rad", joint.damping_Nms_rad},
          {"centre_uncertainty_m", joint.centre_uncertainty_m},
          {"axis_uncertainty_rad", joint.axis_uncertainty_rad}};
}

Json json_of_mechanics(const Muscle& muscle) {
  return {{"peak_force_N", muscle.peak_force_N},
          {"optimal_fibre_m", muscle.optimal_fibre_m},
          {"pennation_rad", muscle.pennation_rad},
          {"rest_stretch", muscle.rest_stretch},
          {"tendon_slack_m", muscle.tendon_slack_m},
          {"activation_tau_s", muscle.activation_tau_s},
          {"deactivation_tau_s", muscle.deactivation_tau_s},
          {"estimated", muscle.estimated},
          {"sources", muscle.sources}};
}
}  // namespace myotact::anatomy
