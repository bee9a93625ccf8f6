#pragma once

#include <cstdint>

#include "messages/local_model.h"
#include "scene/recording.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Whom a model is for, and how.
struct ModelRequest {
  const messages::ToolState& tool;
  int index = 0;  // of the tool in the scene
  const ModelRecord& record;
  std::uint64_t step_ns = 0;
  double report_radius_m = 0.0;  // of a tool that goes by reports of contacts; 0: it does not
};

/// Of the tool's sphere where its force method goes by reports of contacts, else 0.
double report_radius_m(const ToolSettings& tool);

/// Fills `model` with what the simulation shows of itself to a tool: the surface played over a step from the record's
/// time on, or standing where the record states that it holds still.
void write_model(const simulation::Simulation& simulation, const ModelRequest& request, messages::LocalModel& model);

}  // namespace myotact::scene
