#pragma once

#include <cstdint>

#include "messages/local_model.h"
#include "scene/recording.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Fills `model` with what the simulation shows of itself to a tool: the surface played over `step_ns` from the
/// record's time on, or standing where the record says that it holds still.
void write_model(const simulation::Simulation& simulation, const messages::ToolState& tool, const ModelRecord& record,
                 std::uint64_t step_ns, messages::LocalModel& model);

}  // namespace myotact::scene
