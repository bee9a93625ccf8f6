#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "device/device.h"
#include "haptics/effects/effects.h"
#include "haptics/force_parts.h"
#include "haptics/gate/force_gate.h"
#include "haptics/gate/haptic_ports.h"
#include "haptics/haptic_settings.h"
#include "messages/felt_tool.h"
#include "messages/held_tool.h"
#include "messages/local_model.h"
#include "messages/tool_state.h"
#include "realtime/bounded_fifo.h"
#include "realtime/latest_value.h"

namespace myotact::haptics {

inline constexpr std::uint64_t kTickPeriod_ns = 1'000'000;

/// What a tick read, decided and wrote, for recorder and tables. tool.force_world_N is what the device was given.
struct HapticTick {
  messages::DeviceState device;
  std::uint64_t model_sequence = 0;  // model in use, 0: none
  messages::ToolState tool;
  double line_tension_N = 0.0;  // of the line in hand, 0: none
  GateState gate = GateState::Off;
  messages::ToolShape chosen = messages::ToolShape::Ball;  // asked for last; in hand once the force has faded out
};

/// One tool, once a millisecond: reads the device and the newest model, computes, gates and writes in the same tick.
///
///   device.read --> [effects: contact + texture + line + bone + tether] --> [energy ports] --> [force gate]
///   models() newest --^                             device.write, tool_states() newest, ticks() all <--'
///
/// Whoever calls tick() owns the clock: a virtual one in lockstep, HapticThread's when it runs free.
class HapticLoop {
 public:
  /// `device` outlives the loop.
  HapticLoop(device::Device& device, const HapticSettings& settings);

  /// Opens the device, puts the tool where it is and arms the gate. Allocates; throws Error Unavailable. Before the
  /// first tick, by the same clock.
  void prepare(std::uint64_t now_ns);
  /// Never allocates, locks, waits, logs or throws. A clock that stands or runs backwards counts as 1 ms. One thread.
  void tick(std::uint64_t now_ns) noexcept;
  /// Any thread: true: force zero from the next tick on, as the device's stop button does; it stays zero until false:
  /// the gate arms again and ramps up.
  void stop_forces(bool stopped) noexcept { stopped ? gate_.stop() : gate_.enable(); }
  /// Any thread: true: no force, and the hand lets go, as while its clutch is held; false: the gate opens again where
  /// little is wanted. Apart from any stop, which stays what it is. For a scene whose tissue is put elsewhere at once.
  void hold_off(bool on) noexcept { held_off_.store(on ? HoldOff::Yes : HoldOff::Ending, std::memory_order_release); }
  /// Any thread.
  bool is_stopped() const noexcept { return gate_.is_stopped(); }
  /// Haptic thread: the next tick learns that a watchdog took the force away: it comes back through the ramp.
  void note_cut() noexcept { cut_ = true; }
  /// What was changed of the settings because the device does not support it, one line; or nothing.
  const std::string& notice() const noexcept { return notice_; }
  /// Haptic thread: the next tick learns that deadlines went by.
  void note_missed(std::uint64_t ticks) noexcept { missed_ = missed_ || ticks > 0; }

  realtime::LatestValue<messages::LocalModel>& models() noexcept { return models_; }     // written by the simulation
  realtime::LatestValue<messages::ToolState>& tool_states() noexcept { return tools_; }  // read by the simulation
  realtime::LatestValue<messages::FeltTool>& felt() noexcept { return felt_; }           // read for the drawing
  /// Written by whoever obeys a person's choice: the tool that the hand is to hold. The force fades out, the tool
  /// changes where nothing of it is felt, and the force comes back through the ramp.
  realtime::LatestValue<messages::HeldTool>& chosen_tools() noexcept { return choices_; }
  realtime::BoundedFifo<HapticTick>& ticks() noexcept { return ticks_; }  // read by the recorder

  // ---- after tick(), in the thread that calls it
  const HapticTick& last_tick() const noexcept { return last_; }
  const messages::ToolState& tool_state() const noexcept { return last_.tool; }
  const messages::FeltTool& felt_tool() const noexcept { return felt_now_; }
  GateState gate_state() const noexcept { return gate_.state(); }
  const messages::HeldTool& held() const noexcept { return held_; }
  const HapticPorts& ports() const noexcept { return ports_; }

 private:
  messages::DeviceState read_device(std::uint64_t now_ns) noexcept;
  void change_tool() noexcept;
  bool take_model() noexcept;
  void advance_clock(std::uint64_t now_ns) noexcept;
  HandTick hand_tick(const messages::DeviceState& state, bool is_new) const noexcept;
  Vec3 felt_force_N(const HandTick& hand) noexcept;
  Vec3 gate_and_write(const Vec3& wanted_N, const messages::DeviceState& state) noexcept;
  void report(const messages::DeviceState& state) noexcept;
  double model_age_s() const noexcept;

  device::Device& device_;
  HapticSettings settings_;  // as the device supports them
  realtime::LatestValue<messages::LocalModel> models_;
  realtime::LatestValue<messages::ToolState> tools_;
  realtime::LatestValue<messages::FeltTool> felt_;
  realtime::LatestValue<messages::HeldTool> choices_;
  realtime::BoundedFifo<HapticTick> ticks_;

  Effects effects_;
  HapticPorts ports_;
  ForceGate gate_;
  std::string notice_;

  enum class HoldOff : std::uint8_t { No, Yes, Ending };
  std::atomic<HoldOff> held_off_{HoldOff::No};
  int ending_ticks_ = 0;                         // for which the end was asked for
  const messages::LocalModel* model_ = nullptr;  // in use; null: none came yet, or the newest was unsound
  std::uint64_t model_arrived_ns_ = 0;
  std::uint64_t model_interval_ns_ = 0;  // between the last two models; 0: not known
  std::uint64_t last_ns_ = 0;
  double dt_s_ = 1e-3;
  bool ticked_ = false;
  bool missed_ = false;
  bool cut_ = false;
  messages::HeldTool held_, chosen_;  // they differ while the force fades out
  // Of the last tick
  std::uint32_t faults_ = 0;
  bool device_is_sound_ = false;
  TickForces forces_;
  messages::FeltTool felt_now_;
  HapticTick last_;
};

}  // namespace myotact::haptics
