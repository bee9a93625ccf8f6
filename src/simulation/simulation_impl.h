#pragma once

#include "simulation/limb/calibration.h"
#include "simulation/limb/limb.h"
#include "simulation/limb/sleep.h"
#include "simulation/line/line_model.h"
#include "simulation/simulation.h"
#include "simulation/touch/surfaces.h"

// What Simulation is made of; for its own files alone: simulation (stepping), simulation_readout, simulation_output.

namespace myotact::simulation {

/// A muscle line with what does not change.
struct LineRest {
  const anatomy::MuscleLine* line = nullptr;  // of Impl's own specimen
  std::vector<double> fractions;              // arc length, one a point that is drawn
  double length_m = 0.0;                      // at the file pose
};

/// What a muscle's line is and does at one instant.
struct LineReading {
  LineGeometry geometry;  // length and its derivatives by all joints
  LineForce force;        // along the line; of a Line muscle at rest at its present length
};

/// State and private steps of a Simulation. Built in the order of its members: surfaces and lines
/// refer to the specimen here.
struct Simulation::Impl {
  /// Both are copied. Calibrates the fibres of all soft muscles, fits the others to the bones. Throws Error BadData as
  /// Limb, Surfaces and Tether do.
  Impl(const anatomy::Specimen& given, const SimulationSettings& chosen);

  anatomy::Specimen specimen;   // never changes: lines and surfaces point into it
  SimulationSettings settings;  // as given
  Limb limb;                    // all that moves
  WorkerPool workers;
  Surfaces surfaces;                           // of skins and bones, as of the last step or settle
  std::optional<Tether> tether;                // when the settings ask for one: then nothing else is felt
  std::vector<double> excitations;             // one a muscle, 0 .. 1
  std::vector<LineRest> lines;                 // one a muscle
  std::vector<LineAgreement> line_agreements;  // one a muscle; that of a rigid one is perfect
  std::uint64_t steps = 0;                     // since construction
  int whole_steps = 0;          // of equal length since the last restart; the second-order rule needs one
  int settled_steps = 0;        // since the last settle: they say when a stiffness is refreshed
  int refreshed = -1;           // muscle whose stiffness was refreshed last in a step; -1: none since the last settle
  int failed_steps = 0;         // since construction
  double residual_share = 0.0;  // of the last step
  std::vector<int> offered_lines;  // of each tool: the muscle whose line was nearest after the last step

  double time_s() const { return static_cast<double>(steps) * settings.dt_s; }
  /// Repeats a failed step of dt_s in two halves, each of which is halved again where it fails; `halvings` counts how
  /// often it has been. False when the shortest part fails: the state is then the last usable one.
  bool advance_in_parts(double dt_s, int halvings);
  /// The next muscle after `refreshed` whose stiffness may have changed; puts it there. False: there is none.
  bool find_next_stale();
  void rest(int muscle, AfterSettle after_settle);  // falls asleep where it may; right after a refresh of its stiffness
  LineAgreement fit_fibres(int muscle);             // as the specimen has it, or by calibration
  void fit_followers();                             // to the bones, over the joints' ranges
  void place_followers();                           // where the bones are now
  Pose body_pose(int body) const;                   // X_WL
  /// The muscle's line in the present pose, and what pulls along it at the present activation.
  LineGeometry line_geometry_of(int muscle) const;
  LineForce line_force_of(int muscle, const LineGeometry& geometry) const;
  /// All muscles' lines as they are now.
  std::vector<LineReading> read_lines() const;
  /// One muscle's part in one joint, and the whole joint; `line` and `lines_now` are readings of the present pose.
  MuscleAtJoint at_joint(int muscle, int joint, const LineReading& line) const;
  JointReadout joint(int joint, const std::vector<LineReading>& lines_now) const;
  double tension_N(int muscle) const;  // at the insertion; of a Rigid muscle what its line would carry
  double fibre_stretch(int muscle, const LineReading& line) const;  // fibre length over optimal, mean
  /// Parts of write_local_model() and write_frame(); each sets the whole of its part. `index`: of the tool among those
  /// of the last step.
  void write_contact(const messages::ToolContact& contact, int index, messages::LocalModel& model) const;
  messages::LocalLine line_at(const messages::ToolState& tool, int index) const;
  void write_joint(int joint, const std::vector<LineReading>& lines_now, messages::JointFrame& frame) const;
  void write_grip(const messages::ToolState& tool, int index, messages::LocalModel& model) const;
};

}  // namespace myotact::simulation
