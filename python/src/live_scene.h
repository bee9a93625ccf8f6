#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/overrides.h"
#include "gil.h"
#include "messages/command.h"
#include "scene/lockstep_session.h"
#include "scene/samples.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::python {

/// Which scene, and how it is run.
struct SceneChoice {
  std::string scene;           // a built-in name, a path, or a scene file's text
  std::string folder;          // of such a text: where its relative paths start; empty: `scene` is no text
  Overrides set;               // as --set
  bool script = false;         // the scene's script plays
  bool co_contraction = true;  // the scene's co-contraction drives its muscles
  int workers = 2;
  std::uint64_t seed = 1;  // of what is random
  int samples = 0;         // a row of samples every so many ticks; 0: none
};

/// What arrays of a muscle there are, each three numbers a row, in W.
enum class MuscleArray { Nodes, NodeVelocities, Skin };

/// Numbers whose place in memory stays, for whoever looks at them for as long as he likes.
using Numbers = std::shared_ptr<const std::vector<double>>;

/// One contact of a tool.
struct TouchedPoint {
  std::string part;  // key of the muscle or bone
  int triangle = -1;
  Vec3 point_m = Vec3::Zero(), normal = Vec3::Zero();  // W
};

/// A scene in lockstep: haptic ticks on a virtual clock, then the step. It is single-threaded; Turns keeps callers
/// apart.
///
/// Arrays are copies that follow the simulation: refresh() is called with the interpreter's lock, so that a reader that
/// has the lock never sees half a step, and the simulation is free to move its own memory about.
class LiveScene {
 public:
  /// Settles the scene. Throws Error.
  explicit LiveScene(const SceneChoice& choice);

  Turns& turns() const { return turns_; }
  const scene::Scene& scene() const { return *scene_; }
  std::shared_ptr<const anatomy::Specimen> specimen() const { return {scene_, &scene_->specimen}; }
  const simulation::Simulation& simulation() const { return *simulation_; }
  simulation::Simulation& simulation() { return *simulation_; }
  scene::Conductor& conductor() { return session_->conductor(); }
  const messages::ToolState& tool(int index) const { return session_->tool(static_cast<std::size_t>(index)); }
  std::vector<TouchedPoint> touched(int tool) const;
  const std::string& samples_csv() const { return samples_->csv(); }

  /// Without the interpreter's lock. Arrays are as before until refresh().
  void step() { session_->step(); }
  /// Every array that was asked for is as the last step left it. With the lock.
  void refresh();
  /// The same memory every time it is asked for.
  Numbers array(int muscle, MuscleArray what);

  void command(const messages::Order& order, double over_s);
  void begin(int tool, double duration_s, const scene::Action& action);
  /// Whether the co-contraction decides the level of this muscle.
  bool is_driven(int muscle) const;

 private:
  /// Into numbers that stay where they are once they have been read.
  void read(int muscle, MuscleArray what, std::vector<double>& numbers) const;

  mutable Turns turns_;
  std::shared_ptr<const scene::Scene> scene_;
  std::unique_ptr<simulation::Simulation> simulation_;
  std::unique_ptr<scene::SampleTable> samples_;
  std::unique_ptr<scene::LockstepSession> session_;
  bool co_contracts_ = false;    // the balance or the levels of its sides drive muscles
  double script_start_s_ = 0.0;  // simulated time of the last reset
  std::map<std::pair<int, MuscleArray>, std::shared_ptr<std::vector<double>>> arrays_;
};

/// The scene that is meant, without its simulation. Throws Error.
scene::Scene read_scene(const SceneChoice& choice);

/// Gives up the scene; in a forked child its threads are not there to be joined, so that it is left to the system.
struct LiveSceneDeleter {
  void operator()(LiveScene* scene) const;
};

}  // namespace myotact::python
