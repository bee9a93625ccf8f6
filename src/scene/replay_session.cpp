#include "scene/replay_session.h"

#include <chrono>
#include <variant>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/json_reader.h"
#include "realtime/real_time_thread.h"
#include "scene/recording_header.h"
#include "scene/tool_frame.h"

namespace myotact::scene {

namespace {

constexpr std::size_t kMostCommands = 256;  // of some pictures

}  // namespace

LoadedRecording load_recording(const std::filesystem::path& file, const Overrides& overrides) {
  Recording recording = read_recording(file);
  const nlohmann::json header = parse_json(recording.header_json, file.string() + " (header)");
  Scene scene = scene_of_recording(header, file, overrides);
  require_fit(recording, scene, file);
  if (recording.steps.empty()) {
    throw bad_data(file.string(), "", "holds no step: it was ended at once. Record it again, for some seconds");
  }
  return {std::move(recording), std::move(scene), devices_of_recording(header, file)};
}

ReplaySession::ReplaySession(const LoadedRecording& loaded)
    : loaded_(&loaded),
      simulation_(loaded.scene.specimen, loaded.scene.settings),
      start_(loaded.scene, simulation_),
      hands_(loaded.scene, loaded.recording, loaded.devices),
      start_s_(simulation_.time_s()),
      commands_(kMostCommands) {}

ReplaySession::~ReplaySession() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
}

double ReplaySession::length_s() const {
  return loaded_->scene.settings.dt_s * static_cast<double>(loaded_->recording.steps.size());
}

void ReplaySession::start() {
  hands_.feel(simulation_);
  publish_frame();
  running_ = true;
  thread_ = std::thread([this] {
    realtime::name_this_thread("replay");
    try {
      simulate();
    } catch (...) {
      failure_ = std::current_exception();
      running_ = false;
    }
  });
}

void ReplaySession::stop() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
}

std::string ReplaySession::push(const messages::Command& command) {
  return commands_.push(command) ? "" : "the recording is simulated too slowly to obey; try again";
}

bool ReplaySession::fetch_frame(messages::SceneFrame& frame) {
  if (!frames_.update()) return false;
  frame = frames_.front();
  return true;
}

void ReplaySession::simulate() {
  const std::vector<StepRecord>& steps = loaded_->recording.steps;
  std::size_t next = 0;
  while (running_.load(std::memory_order_relaxed)) {
    if (obey()) publish_frame();
    const double ahead_s = simulation_.time_s() - start_s_;
    if (next == steps.size() || ahead_s >= wanted_s_.load(std::memory_order_relaxed)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));  // a fifth of a step
      continue;
    }
    apply(steps[next], simulation_);
    simulation_.step(steps[next].tools);
    hands_.feel(simulation_);
    ++next;
    publish_frame();
  }
}

/// True where something is shown otherwise from now on.
bool ReplaySession::obey() {
  const bool before = paused_;
  for (messages::Command command; commands_.pop(command);) {
    if (const auto* pause = std::get_if<messages::Pause>(&command.order)) paused_ = pause->on;
  }
  return paused_ != before;
}

void ReplaySession::publish_frame() {
  messages::SceneFrame& frame = frames_.back();
  simulation_.write_frame(frame);
  frame.tools.clear();
  for (std::size_t t = 0; t < hands_.tool_count(); ++t) {
    frame.tools.push_back(tool_frame(hands_.felt_tool(t), loaded_->scene, t, simulation_));
    for (haptics::HapticTick tick; hands_.ticks(t).pop(tick);) {
    }
  }
  frame.time_s -= start_s_;
  frame.control = start_.control();  // a recording holds what the muscles got, not who asked for it
  frame.control.paused = paused_;
  ++frame.sequence;
  frames_.publish();
}

}  // namespace myotact::scene
