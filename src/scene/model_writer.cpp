#include "scene/model_writer.h"

#include "layer/model_contacts.h"

namespace myotact::scene {

namespace {

/// What is paused stays touchable, and is not stale: the same positions in both frames, published again and again.
void hold_still(messages::LocalModel& model) {
  model.previous_world_m = model.current_world_m;
  model.grip.velocity_world_m_s = model.grip.acceleration_world_m_s2 = {};
  model.grip.mobility_1_kg = {};
  model.tether.anchor_velocity_world_m_s = {};
}

}  // namespace

double report_radius_m(const ToolSettings& tool) {
  const bool goes_by_reports =
      tool.method == haptics::ForceMethod::Penetration || tool.method == haptics::ForceMethod::Plane;
  return goes_by_reports ? tool.radius_m : 0.0;
}

void write_model(const simulation::Simulation& simulation, const ModelRequest& request, messages::LocalModel& model) {
  simulation.write_local_model(request.tool, model, request.index);
  if (request.record.holds_still) hold_still(model);
  model.reported = {};
  const Vec3 tool_m = to_vec3(request.tool.tool_position_world_m);
  if (request.report_radius_m > 0.0 && tool_m.allFinite()) {
    model.reported = layer::contacts_in_model(model, tool_m, request.report_radius_m);
  }
  model.sequence = request.record.sequence;
  model.published_at_ns = request.record.published_at_ns;
  model.dt_ns = request.step_ns;
  model.tool_sequence = request.tool.sequence;
}

}  // namespace myotact::scene
