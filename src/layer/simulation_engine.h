#pragma once

#include <memory>
#include <vector>

#include "anatomy/specimen.h"
#include "layer/engine.h"
#include "simulation/simulation.h"

namespace myotact::layer {

/// Names the triangle of a contact that is known by its place alone, as for other engines (engine_surfaces.h): the
/// springs of a tool hang on triangles.
void name_touched_triangle(const simulation::Simulation& simulation, messages::ToolState& tool);

/// Our own simulation behind the adapter. It has no collision detection of its own: what a sphere would meet is the
/// point of each surface that is deepest in it, among the triangles of the local model.
class SimulationEngine final : public Engine {
 public:
  /// `tool_radii_m`: of the tools' spheres. Starts at rest in the specimen's pose; the step is the settings'. Throws
  /// Error BadData when the specimen cannot be simulated.
  SimulationEngine(const anatomy::Specimen& specimen, const simulation::SimulationSettings& settings,
                   std::vector<double> tool_radii_m);

  std::string_view name() const override { return "myotact"; }
  double step_s() const override { return step_s_; }
  int surface_count() const override { return static_cast<int>(bodies_.size()); }
  void move_tool(int tool, const messages::ToolState& state) override;
  void advance() override { simulation_.step(tools_); }
  void report_contacts(int tool, messages::ReportedContacts& reported) const override;
  Pose body_pose(int surface) const override;
  void write_surface(int tool, messages::LocalModel& model) const override;

 private:
  simulation::Simulation simulation_;
  double step_s_;
  std::vector<int> bodies_;  // of a surface, -1: a skin
  std::vector<double> radii_m_;
  std::vector<messages::ToolState> tools_;
  mutable messages::LocalModel around_;  // scratch, kept for its size
};

}  // namespace myotact::layer
