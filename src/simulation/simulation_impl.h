#pragma once

#include "simulation/limb.h"
#include "simulation/line_model.h"
#include "simulation/simulation.h"
#include "simulation/surfaces.h"

// What Simulation is made of; for its own files alone: simulation (stepping), simulation_readout, simulation_output.

namespace myotact::simulation {

/// A muscle line with what does not change.
struct LineRest {
  const anatomy::MuscleLine* line = nullptr;
  std::vector<double> fractions;  // arc length, one a point that is drawn
  double length_m = 0.0;          // at the file pose
};

/// What a muscle's line is and does at one instant.
struct LineReading {
  LineGeometry geometry;
  LineForce force;
};

struct Simulation::Impl {
  Impl(const anatomy::Specimen& given, const SimulationSettings& chosen);

  anatomy::Specimen specimen;
  SimulationSettings settings;
  Limb limb;
  WorkerPool workers;
  Surfaces surfaces;
  std::optional<Tether> tether;
  std::vector<double> excitations;
  std::vector<LineRest> lines;  // one a muscle
  std::uint64_t steps = 0;
  int whole_steps = 0;   // of equal length since the last restart; the second-order rule needs one
  int next_refresh = 0;  // muscle whose stiffness is refreshed by the next step
  int failed_steps = 0;
  double residual_share = 0.0;     // of the last step
  std::vector<int> offered_lines;  // of each tool: the muscle whose line was nearest after the last step

  double time_s() const { return static_cast<double>(steps) * settings.dt_s; }
  bool advance_in_parts(double dt_s, int halvings);
  Pose body_pose(int body) const;
  LineGeometry line_geometry_of(int muscle) const;
  LineForce line_force_of(int muscle, const LineGeometry& geometry) const;
  /// All muscles' lines as they are now.
  std::vector<LineReading> read_lines() const;
  MuscleAtJoint at_joint(int muscle, int joint, const LineReading& line) const;
  JointReadout joint(int joint, const std::vector<LineReading>& lines_now) const;
  double tension_N(int muscle) const;
  double fibre_stretch(int muscle, const LineReading& line) const;  // fibre length over optimal, mean
  // `index`: of the tool among those of the last step.
  void write_contact(const messages::ToolContact& contact, int index, messages::LocalModel& model) const;
  messages::LocalLine line_at(const messages::ToolState& tool, int index) const;
  void write_joint(int joint, const std::vector<LineReading>& lines_now, messages::JointFrame& frame) const;
  void write_grip(const messages::ToolState& tool, int index, messages::LocalModel& model) const;
};

}  // namespace myotact::simulation
