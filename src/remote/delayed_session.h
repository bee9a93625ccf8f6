#pragma once

#include <cstdint>

#include "device/simulated_device.h"
#include "haptics/haptic_loop.h"
#include "messages/local_model.h"
#include "messages/tool_state.h"
#include "net/delay_line.h"
#include "scene/conductor.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::remote {

/// Both directions between a hand and its simulation.
struct DelayedLink {
  net::LinkSettings up;    // from the hand
  net::LinkSettings down;  // to it
};

/// A link of this round trip, half of it each way; jitter and stalls each way, independent of each other.
DelayedLink symmetric_link(double round_trip_s, double jitter_s, double stalls_per_s, std::uint64_t seed);

/// The first tool of a scene on one side of a slow link and the simulation on the other, on one virtual clock, which
/// both know exactly:
///
///   HapticLoop, 1 kHz --ToolState--> [delay] --> the newest that has come, once a step --> Simulation
///            ^---------------------- [delay] <--LocalModel-------------------------------------'
///
/// Without delay the same, bit for bit, as LockstepSession.
class DelayedSession {
 public:
  /// Both references outlive it. The hand is the caller's. Throws Error.
  DelayedSession(const scene::Scene& scene, simulation::Simulation& simulation, const DelayedLink& link);

  /// One tick of the loop with the hand's target there, and a step of the simulation where one is due.
  void tick(const device::HandTarget& hand);

  double time_s() const;  // of the next tick
  const scene::Conductor& conductor() const { return conductor_; }
  scene::Conductor& conductor() { return conductor_; }
  const haptics::HapticLoop& loop() const { return loop_; }
  haptics::HapticLoop& loop() { return loop_; }
  const device::SimulatedDevice& device() const { return device_; }

 private:
  void step();
  void send_model();
  void take_arrivals();

  const scene::Scene* scene_;
  simulation::Simulation* simulation_;
  scene::Conductor conductor_;
  device::SimulatedDevice device_;
  haptics::HapticLoop loop_;
  net::DelayLine<messages::ToolState> up_;
  net::DelayLine<messages::LocalModel> down_;
  messages::ToolState arrived_;  // at the simulation
  messages::LocalModel model_;   // as it is written
  scene::StepRecord input_;
  std::uint64_t step_ns_;
  std::uint64_t ticks_a_step_;
  std::uint64_t clock_ns_ = haptics::kTickPeriod_ns;  // of the next tick; 0 means "never" to a device
  std::uint64_t ticks_ = 0;
  std::uint64_t model_sequence_ = 0;
};

}  // namespace myotact::remote
