#include "layer/simulation_engine.h"

#include <utility>

#include "core/at.h"
#include "layer/engine_surfaces.h"
#include "layer/model_contacts.h"

namespace myotact::layer {
namespace {

std::vector<int> bodies_of_surfaces(const anatomy::Specimen& specimen) {
  std::vector<int> bodies(specimen.muscles.size(), -1);
  for (const anatomy::Bone& bone : specimen.bones) bodies.push_back(bone.body);
  return bodies;
}

}  // namespace

void name_touched_triangle(const simulation::Simulation& simulation, messages::ToolState& tool) {
  if (tool.contact.surface < 0 || tool.contact.triangle >= 0) return;
  messages::ToolState there = tool;
  there.proxy_position_world_m = tool.touched_world_m;
  messages::LocalModel around;
  simulation.write_local_model(there, around);
  name_touched_triangle(around, tool);
}

SimulationEngine::SimulationEngine(const anatomy::Specimen& specimen, const simulation::SimulationSettings& settings,
                                   std::vector<double> tool_radii_m)
    : simulation_(specimen, settings),
      step_s_(settings.dt_s),
      bodies_(bodies_of_surfaces(specimen)),
      radii_m_(std::move(tool_radii_m)),
      tools_(radii_m_.size()) {}

void SimulationEngine::move_tool(int tool, const messages::ToolState& state) {
  tools_[at(tool)] = state;
  name_touched_triangle(simulation_, tools_[at(tool)]);
}

void SimulationEngine::report_contacts(int tool, messages::ReportedContacts& reported) const {
  reported = {};
  messages::ToolState around = tools_[at(tool)];
  const Vec3 middle_m = to_vec3(around.tool_position_world_m);
  if (!middle_m.allFinite()) return;
  around.proxy_position_world_m = around.tool_position_world_m;  // round which a model is looked up
  simulation_.write_local_model(around, around_, tool);
  reported = contacts_in_model(around_, middle_m, radii_m_[at(tool)]);
}

Pose SimulationEngine::body_pose(int surface) const {
  const int body = bodies_[at(surface)];
  return body < 0 ? Pose{} : simulation_.body_pose(body);
}

void SimulationEngine::write_surface(int tool, messages::LocalModel& model) const {
  simulation_.write_local_model(tools_[at(tool)], model, tool);
}

}  // namespace myotact::layer
