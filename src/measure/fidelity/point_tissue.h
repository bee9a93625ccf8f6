#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "core/vector.h"
#include "device/simulated_device.h"
#include "haptics/haptic_loop.h"

namespace myotact::measure {

/// A plate on a mass on springs, as soft one way as the other: tissue whose answer to a press is a closed form. It
/// steps implicitly (Euler's rule), the tool's coupling spring inside the step, as finite elements do.
struct PointTissue {
  double mass_kg = 0.02;
  double stiffness_N_m = 300.0;
  double dt_s = 0.01;          // whole milliseconds
  int late_steps = 1;          // the result of a step is played that many steps after the step's end
  Vec3 normal{0.0, 0.0, 1.0};  // unit, of the plate
  double told_share = 1.0;     // of the true compliance that the model reports
};

/// Tissue, loop, device and hand on one virtual clock.
class PointPress {
 public:
  PointPress(const PointTissue& tissue, const haptics::HapticSettings& settings, const device::DeviceProfile& profile,
             const device::HandProfile& hand);

  /// One tick of the loop with the hand's target there; a step of the tissue where one is due.
  void tick(const Vec3& hand_target_m, std::uint32_t buttons = 0);

  Vec3 force_N() const { return to_vec3(loop_.tool_state().force_world_N); }  // on the hand
  Vec3 device_m() const { return device_.position_world_m(); }
  const Vec3& tissue_m() const { return now_m_; }         // from where it rests
  const Vec3& tissue_force_N() const { return used_N_; }  // of the tool on the tissue in the last step
  const haptics::HapticLoop& loop() const { return loop_; }
  double time_s() const { return 1e-9 * static_cast<double>(now_ns_); }
  /// Where the middle of a tool that just touches the plate at its middle is.
  Vec3 touching_m() const;

 private:
  void step();
  void publish();

  PointTissue tissue_;
  device::SimulatedDevice device_;
  haptics::HapticLoop loop_;
  double radius_m_;
  std::array<Vec3, 4> corners_m_;
  Vec3 now_m_ = Vec3::Zero(), last_m_ = Vec3::Zero(), velocity_m_s_ = Vec3::Zero(), used_N_ = Vec3::Zero();
  bool touched_ = false;
  std::deque<std::unique_ptr<messages::LocalModel>> waiting_;
  std::uint64_t now_ns_ = 0;
  std::uint64_t sequence_ = 0;
};

/// What is left of a signal above 20 Hz (first order), as root of its mean square.
class Jitter {
 public:
  void add(double value, double dt_s = 1e-3);
  double rms() const;

 private:
  double slow_ = 0.0, sum_ = 0.0;
  std::uint64_t count_ = 0;
};

}  // namespace myotact::measure
