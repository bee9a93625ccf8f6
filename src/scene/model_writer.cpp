#include "scene/model_writer.h"

namespace myotact::scene {

namespace {

/// What is paused stays touchable, and is not stale: the same positions in both frames, published again and again.
void hold_still(messages::LocalModel& model) {
  model.previous_world_m = model.current_world_m;
  model.grip.velocity_world_m_s = model.grip.acceleration_world_m_s2 = {};
  model.grip.mobility_1_kg = {};
}

}  // namespace

void write_model(const simulation::Simulation& simulation, const messages::ToolState& tool, const ModelRecord& record,
                 std::uint64_t step_ns, messages::LocalModel& model) {
  simulation.write_local_model(tool, model);
  if (record.holds_still) hold_still(model);
  model.sequence = record.sequence;
  model.published_at_ns = record.published_at_ns;
  model.dt_ns = step_ns;
  model.tool_sequence = tool.sequence;
}

}  // namespace myotact::scene
