#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <thread>

#include "messages/command.h"
#include "messages/scene_frame.h"
#include "realtime/bounded_fifo.h"
#include "realtime/latest_value.h"
#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/recording.h"
#include "scene/scene_file.h"
#include "scene/session.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// A recording and the scene it is of.
struct LoadedRecording {
  Recording recording;
  Scene scene;
  std::vector<device::DeviceProfile> devices;  // that it was made with, one a tool
};

/// Throws Error NoInput, or BadData for a recording that is foreign, of another version, or does not fit its scene.
LoadedRecording load_recording(const std::filesystem::path& file, const Overrides& overrides);

/// Simulates a recording again for a window, on a thread of its own: as far as the window wants, no faster than the
/// computer can. There is no device in it: nothing is felt by anyone.
class ReplaySession final : public Session {
 public:
  /// Brings the scene to where the recording began, which takes seconds. `loaded` outlives it. Throws Error.
  explicit ReplaySession(const LoadedRecording& loaded);
  ~ReplaySession() override;

  void start_stopped() override { stopped_ = true; }
  void start() override;
  void stop() override;
  bool running() const override { return running_.load(std::memory_order_relaxed); }
  double length_s() const;  // of simulated time

  // ---- the drawing thread
  void play_to(double time_s) { wanted_s_.store(time_s, std::memory_order_relaxed); }
  bool fetch_frame(messages::SceneFrame& frame) override;
  /// A pause shows in the frames; nothing else can be asked of what is past.
  [[nodiscard]] std::string push(const messages::Command& command) override;
  /// Nothing is felt; remembered for the session after this one.
  void stop_forces(bool stopped) noexcept override { stopped_ = stopped; }
  bool forces_stopped() const noexcept override { return stopped_; }

 private:
  void simulate();
  bool obey();
  void publish_frame();

  const LoadedRecording* loaded_;
  simulation::Simulation simulation_;
  Conductor start_;  // puts the simulation where the recording began
  ForceReplay hands_;
  double start_s_;
  std::atomic<double> wanted_s_{0.0};
  realtime::BoundedFifo<messages::Command> commands_;
  bool paused_ = false;
  std::atomic<bool> stopped_{false};
  std::atomic<bool> running_{false};
  std::exception_ptr failure_;
  realtime::LatestValue<messages::SceneFrame> frames_;
  std::thread thread_;
};

}  // namespace myotact::scene
