#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "device/device.h"
#include "device/simulated_device.h"
#include "haptics/haptic_group.h"
#include "haptics/haptic_loop.h"
#include "haptics/haptic_thread.h"
#include "messages/command.h"
#include "messages/scene_frame.h"
#include "realtime/bounded_fifo.h"
#include "realtime/latest_value.h"
#include "realtime/period_histogram.h"
#include "scene/conductor.h"
#include "scene/extremes.h"
#include "scene/fault_notice.h"
#include "scene/rate_meter.h"
#include "scene/recording.h"
#include "scene/remote_hand.h"
#include "scene/scene_file.h"
#include "scene/session.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// What a free run reports when it ends.
struct FreeTiming {
  double wall_s = 0.0;
  double simulated_s = 0.0;
  std::uint64_t steps = 0;
  std::uint64_t ticks = 0, missed_ticks = 0;
  realtime::DurationSummary tick, tick_period, step;  // a tick: of all tools, one after the other
  std::vector<realtime::DurationSummary> tool_ticks;  // of each alone
  std::string refused;                                // what the system did not permit
  Extremes extremes;
};

/// The device of one tool, or the hand that it has elsewhere.
struct ToolDevice {
  device::Device* device = nullptr;
  device::SimulatedDevice* scripted = nullptr;  // the same one when the script moves its hand, else null
  RemoteHand remote = {};                       // in place of a device
};

/// Who watches the ticks of a session, and who makes them.
struct Ticking {
  realtime::Watchdog* watchdog = nullptr;  // of all devices, notified of every tick; null: none
  device::ServoClock* servo = nullptr;     // null: the session's own thread
};

/// Runs a scene on the wall clock: the haptic thread at 1 kHz, the simulation thread at its own step, the caller draws.
/// Every tool has a device, a haptic loop and channels of its own; no lock is shared between them. A remote hand has
/// its loop and device elsewhere, and here the channels alone.
class FreeSession final : public Session {
 public:
  /// `devices`: one a tool of the scene. All references must outlive the session. Throws Error.
  FreeSession(const Scene& scene, simulation::Simulation& simulation, std::span<const ToolDevice> devices,
              RecordingWriter* recorder, const Ticking& ticking = {});
  ~FreeSession() override;

  void start_stopped() override { starts_stopped_ = true; }
  void start() override;
  /// Before start(): what the simulation's thread calls when the models of the hands are new.
  void on_models(std::function<void()> call) { on_models_ = std::move(call); }
  void let_go() override;
  void stop() override;
  /// After stop().
  FreeTiming timing() const;

  bool forces_stopped() const noexcept override;
  bool running() const override { return running_.load(std::memory_order_relaxed); }
  double script_end_s() const { return conductor_.script_end_s(); }
  const std::string& notice() const { return notice_; }  // what the devices do not support of the settings

  /// All haptic loops, whatever the simulation is busy with.
  void stop_forces(bool stopped) noexcept override { haptics::stop_forces(loops_, stopped); }

  // ---- the drawing thread
  /// Obeyed in order, before the next step. With a full queue it is dropped and the reason returned. One
  /// thread.
  [[nodiscard]] std::string push(const messages::Command& command) override;
  bool fetch_frame(messages::SceneFrame& frame) override;
  /// Whether a recording is being written. One that cannot be written any more ends, and the notice states why; what
  /// was written stays readable, and the session goes on.
  bool recording() const { return recording_.load(std::memory_order_relaxed); }
  /// After stop(): why the recording could not be written to its end; empty when it was, or when there was none.
  const std::string& recording_fault() const { return recording_fault_; }
  /// The newest shove test that came to its end; joint -1: none has.
  ShoveRecord fetch_shove();

 private:
  /// What belongs to one tool.
  struct Tool {
    Tool(const ToolSettings& settings, const ToolDevice& given);
    device::SimulatedDevice* scripted;
    std::unique_ptr<haptics::HapticLoop> loop;  // none: it runs elsewhere
    RemoteHand hand;                            // the channels of either
    messages::ToolState newest;                 // from its loop, or the accepted one of a remote hand
    std::uint64_t heard_ns = 0;                 // when that came
    std::uint64_t model_sequence = 0;
    FaultNotice faults;
  };

  void simulate();
  void move_scripted_hands(double time_s);
  void hear(Tool& tool) const;
  messages::FeltTool felt_by(std::size_t index) const;
  void obey(const messages::Command& command);
  void hand_over_tools();
  void go_on(const messages::Command& command);
  void hold_off_hands(bool on) noexcept;
  ToolSettings settings_of(std::size_t tool) const;
  void step();
  void publish_models();
  void publish_frame();
  std::string fault_text() const;
  template <typename... Record>
  void record(const Record&... what);
  void end_recording();
  /// Ticks since the last time: for the summary and the recording.
  void take_ticks();

  const Scene* scene_;
  simulation::Simulation* simulation_;
  RecordingWriter* recorder_;  // null: none, or it ended
  std::atomic<bool> recording_;
  std::string recording_fault_;  // why it ended, if it had to
  Conductor conductor_;
  std::vector<std::unique_ptr<Tool>> tools_;  // as in the scene
  std::vector<haptics::HapticLoop*> loops_;   // those that run here
  std::string notice_;
  std::function<void()> on_models_;
  std::optional<haptics::HapticThread> haptic_thread_;  // from the constructor on, where loops run here
  std::thread thread_;
  std::atomic<bool> running_{false};
  std::exception_ptr failure_;
  realtime::BoundedFifo<messages::Command> commands_;  // from the drawing to the simulation
  bool paused_ = false;
  int single_steps_ = 0;   // asked for and not made yet
  bool set_back_ = false;  // the next step begins elsewhere than the last one ended
  bool starts_stopped_ = false;
  // From the simulation to the drawing: neither waits for the other.
  realtime::LatestValue<messages::SceneFrame> frames_;
  realtime::LatestValue<ShoveRecord> shoves_;
  realtime::PeriodHistogram steps_;
  RateMeter rates_;
  std::uint64_t step_count_ = 0;
  std::uint64_t started_ns_ = 0, stopped_ns_ = 0;
  Extremes extremes_;
  StepRecord input_;
};

}  // namespace myotact::scene
