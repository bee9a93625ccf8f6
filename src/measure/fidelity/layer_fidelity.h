#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/vector.h"
#include "device/simulated_device.h"
#include "layer/engine.h"
#include "layer/lockstep_layer.h"
#include "measure/fidelity/goal.h"
#include "scene/scene_file.h"

namespace myotact::measure {

/// Engines that this program was built with, at 60 Hz, with the scene's specimen, gravity and first tool.
std::vector<std::string> layer_engines();
std::unique_ptr<layer::Engine> make_layer_engine(const std::string& name, const scene::Scene& scene);

/// One tick of a run.
struct LayerTick {
  double t_s = 0.0;
  Vec3 target_m = Vec3::Zero();  // of the hand
  Vec3 hand_m = Vec3::Zero();    // true place of the stylus, behind its encoder
  Vec3 force_N = Vec3::Zero();   // on the hand
};

/// The layer over one engine with the scene's tool, a simulated device and a simulated hand, on one virtual clock.
class LayerRun {
 public:
  /// `start_m`: where hand and stylus begin.
  LayerRun(const std::string& engine, const scene::Scene& scene, const haptics::HapticSettings& settings,
           const Vec3& start_m);

  const LayerTick& tick(const Vec3& target_m, const Vec3& target_velocity_m_s, std::uint32_t buttons);
  const layer::Engine& engine() const { return *engine_; }
  const messages::ToolState& tool() { return layer_.loop(0).tool_state(); }

 private:
  std::unique_ptr<layer::Engine> engine_;
  device::SimulatedDevice device_;
  std::array<layer::LayerTool, 1> tools_;
  layer::LockstepLayer layer_;
  LayerTick last_;
};

/// What the layer's tests and `myotact fidelity plane` and `plate` give: figures beside goals, a table, and the force
/// over time of each run.
struct LayerFidelity {
  std::string title;
  std::vector<std::string> columns;            // with units
  std::vector<std::vector<std::string>> rows;  // names
  std::vector<std::vector<double>> values;     // one a column after the names; NaN: none
  std::vector<Figure> figures;                 // what has a goal
  std::vector<std::string> notes;              // definitions and conditions
  struct Trace {
    std::string engine, name;
    std::vector<LayerTick> ticks;
  };
  std::vector<Trace> traces;

  bool passed() const;
};

/// A hand presses on the plane with about 1 N and slides along x, then along y, by methods A, B and the proxy.
LayerFidelity measure_plane(const scene::Scene& scene, Effort effort);
/// A hand lifts the plate by method C and by our own grip.
LayerFidelity measure_plate(const scene::Scene& scene, Effort effort);

std::string layer_text(const LayerFidelity& fidelity);
std::string layer_json(const LayerFidelity& fidelity);
/// Target, hand and force of all runs that left a trace: `engine,run,t_s,target_x_m,..`.
std::string layer_csv(const LayerFidelity& fidelity);

}  // namespace myotact::measure
