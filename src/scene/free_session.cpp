#include "scene/free_session.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "core/error.h"
#include "haptics/faults.h"
#include "haptics/haptic_group.h"
#include "layer/simulation_engine.h"
#include "realtime/periodic_loop.h"
#include "realtime/real_time_thread.h"
#include "scene/lockstep_haptics.h"
#include "scene/model_writer.h"
#include "scene/tool_choice.h"
#include "scene/tool_frame.h"

namespace myotact::scene {

namespace {

/// Steps by which simulated time may lag and still be caught up: single long steps do not slow it, steady overload
/// does. 30 ms at 100 Hz is less than two frames of the window.
constexpr std::uint64_t kStepsToCatchUp = 3;

/// More than a person can say, or a class by the network, while one step takes its time.
constexpr std::size_t kMostCommands = 1024;

std::uint64_t nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds * 1e9));
}

}  // namespace

FreeSession::Tool::Tool(const ToolSettings& settings, const ToolDevice& given)
    : scripted(given.scripted), hand(given.remote) {
  if (given.device == nullptr) return;
  loop = std::make_unique<haptics::HapticLoop>(*given.device, haptic_settings(settings));
  hand = {&loop->tool_states(), &loop->models(), nullptr};
}

FreeSession::FreeSession(const Scene& scene, simulation::Simulation& simulation, std::span<const ToolDevice> devices,
                         RecordingWriter* recorder, const Ticking& ticking)
    : scene_(&scene),
      simulation_(&simulation),
      recorder_(recorder),
      recording_(recorder != nullptr),
      conductor_(scene, simulation),
      commands_(kMostCommands),
      rates_(scene.settings.dt_s),
      extremes_(devices.size()) {
  for (std::size_t t = 0; t < devices.size(); ++t) {
    tools_.push_back(std::make_unique<Tool>(scene.tools[t], devices[t]));
    if (tools_.back()->loop) loops_.push_back(tools_.back()->loop.get());
  }
  notice_ = stiffness_notices(loops_, scene);
  if (!loops_.empty()) haptic_thread_.emplace(loops_, ticking.watchdog, ticking.servo);
}

FreeSession::~FreeSession() {
  running_ = false;
  if (thread_.joinable()) thread_.join();
  if (haptic_thread_) haptic_thread_->stop();
}

void FreeSession::start() {
  started_ns_ = realtime::steady_now_ns();
  for (haptics::HapticLoop* loop : loops_) {
    loop->prepare(started_ns_);
  }
  if (starts_stopped_) haptics::stop_forces(loops_, true);  // before there is a tick
  for (const auto& tool : tools_) hear(*tool);  // where the hand is: the first model is of the surface there
  publish_models();
  publish_frame();
  if (haptic_thread_) haptic_thread_->start();
  running_ = true;
  thread_ = std::thread([this] {
    realtime::name_this_thread("simulation");
    try {
      simulate();
    } catch (...) {
      failure_ = std::current_exception();
    }
    running_ = false;
  });
}

void FreeSession::let_go() {
  haptics::stop_forces(loops_, true);
  running_ = false;
  if (haptic_thread_) haptic_thread_->stop();
}

void FreeSession::stop() {
  haptics::stop_forces(loops_, true);  // now, not after the step that is under way
  running_ = false;
  if (thread_.joinable()) thread_.join();
  if (haptic_thread_) haptic_thread_->stop();
  end_recording();
  stopped_ns_ = realtime::steady_now_ns();
  if (failure_) std::rethrow_exception(failure_);
}

FreeTiming FreeSession::timing() const {
  FreeTiming timing;
  timing.wall_s = static_cast<double>(stopped_ns_ - started_ns_) * 1e-9;
  timing.simulated_s = simulation_->time_s();
  timing.steps = step_count_;
  timing.step = steps_.summary();
  timing.extremes = extremes_;
  if (!haptic_thread_) return timing;
  timing.ticks = haptic_thread_->tick_count();
  timing.missed_ticks = haptic_thread_->missed_count();
  timing.tick = haptic_thread_->ticks().summary();
  for (std::size_t t = 0; t < loops_.size(); ++t) timing.tool_ticks.push_back(haptic_thread_->ticks(t).summary());
  timing.tick_period = haptic_thread_->periods().summary();
  timing.refused = haptic_thread_->refused();
  return timing;
}

bool FreeSession::forces_stopped() const noexcept {
  return std::any_of(loops_.begin(), loops_.end(), [](const haptics::HapticLoop* loop) { return loop->is_stopped(); });
}

std::string FreeSession::push(const messages::Command& command) {
  if (commands_.push(command)) return "";
  return "the simulation has too much to obey already, so that this was not done; try again when it goes on";
}

bool FreeSession::fetch_frame(messages::SceneFrame& frame) {
  if (!frames_.update()) return false;
  frame = frames_.front();
  return true;
}

ShoveRecord FreeSession::fetch_shove() {
  shoves_.update();
  return shoves_.front();
}

void FreeSession::obey(const messages::Command& command) {
  if (const auto* pause = std::get_if<messages::Pause>(&command.order)) {
    paused_ = pause->on;
  } else if (std::holds_alternative<messages::SingleStep>(command.order)) {
    ++single_steps_;
  } else if (std::holds_alternative<messages::EndRecording>(command.order)) {
    end_recording();
  } else if (std::holds_alternative<messages::GoOn>(command.order)) {
    go_on(command);
  } else {
    conductor_.apply(command);
    if (std::holds_alternative<messages::ChooseTool>(command.order)) hand_over_tools();
  }
}

/// What is set back jumps, and takes as long as a settle does: no hand feels it, and none drags at where things were.
/// The step is made even if somebody asks for a pause in the same breath, or what is touched would not be what is
/// recorded.
void FreeSession::go_on(const messages::Command& command) {
  hold_off_hands(true);
  set_back_ = true;
  conductor_.apply(command);
  paused_ = false;
  single_steps_ = std::max(single_steps_, 1);
}

void FreeSession::hold_off_hands(bool on) noexcept {
  for (haptics::HapticLoop* loop : loops_) loop->hold_off(on);
}

void FreeSession::hand_over_tools() {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    const ToolSettings asked = settings_of(t);
    if (tools_[t]->loop) tools_[t]->loop->chosen_tools().publish({asked.shape, asked.radius_m});
  }
}

/// With the tool that was chosen for this hand. One whose loop runs elsewhere keeps the scene's, a third one is a
/// guest's.
ToolSettings FreeSession::settings_of(std::size_t tool) const {
  const messages::ChosenTools chosen = conductor_.control().tools;
  const bool can_choose = tools_[tool]->loop && tool < chosen.size();
  return with_choice(scene_->tools[tool], can_choose ? chosen.at(tool) : std::nullopt);
}

/// A full disk ends the recording, not the session.
template <typename... Record>
void FreeSession::record(const Record&... what) {
  if (recorder_ == nullptr) return;
  try {
    recorder_->add(what...);
  } catch (const Error& failure) {
    recording_fault_ = failure.what();
    recorder_ = nullptr;
    recording_ = false;
  }
}

void FreeSession::end_recording() {
  if (recorder_ == nullptr) return;
  try {
    recorder_->close();
  } catch (const Error& failure) {
    recording_fault_ = failure.what();
  }
  recorder_ = nullptr;
  recording_ = false;
}

void FreeSession::simulate() {
  realtime::PeriodicLoop loop(nanoseconds(scene_->settings.dt_s), kStepsToCatchUp);
  loop.start();
  while (running_.load(std::memory_order_relaxed)) {
    loop.wait();
    for (messages::Command command; commands_.pop(command);) obey(command);
    if (!paused_ || single_steps_ > 0) {
      single_steps_ = std::max(single_steps_ - 1, 0);
      const std::uint64_t begin_ns = realtime::steady_now_ns();
      step();
      steps_.add(realtime::steady_now_ns() - begin_ns);
    } else {
      take_ticks();
    }
    publish_models();
    if (std::exchange(set_back_, false)) hold_off_hands(false);
    publish_frame();
  }
}

void FreeSession::move_scripted_hands(double time_s) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    if (tools_[t]->scripted == nullptr) continue;
    const HandTarget hand = conductor_.hand(t, time_s);
    const Vec3 ahead = conductor_.hand(t, time_s + scene_->settings.dt_s).position_world_m;
    const Vec3 velocity_m_s = (ahead - hand.position_world_m) / scene_->settings.dt_s;
    tools_[t]->scripted->set_hand_target({to_array(hand.position_world_m), to_array(velocity_m_s), hand.buttons});
  }
}

/// A remote hand that falls silent lets go, or its last spring would pull for ever.
void FreeSession::hear(Tool& tool) const {
  constexpr std::uint64_t kSilent_ns = 100'000'000;  // the same after which a haptic loop without models gives no force
  const std::uint64_t now_ns = realtime::steady_now_ns();
  if (tool.hand.states->update()) {
    const messages::ToolState& said = tool.hand.states->front();
    tool.newest = tool.loop ? said : heeded(said, scene_->specimen);
    tool.heard_ns = now_ns;
  }
  if (!tool.loop && now_ns - tool.heard_ns > kSilent_ns) tool.newest = messages::let_go(tool.newest);
}

void FreeSession::step() {
  const double time_s = simulation_->time_s();
  conductor_.prepare_step(time_s, input_);
  move_scripted_hands(time_s);
  input_.tools.clear();
  for (const auto& tool : tools_) {
    hear(*tool);
    if (set_back_) tool->newest = messages::let_go(tool->newest);
    input_.tools.push_back(tool->newest);
    layer::name_touched_triangle(*simulation_, input_.tools.back());
  }
  apply(input_, *simulation_);
  simulation_->step(input_.tools);
  ++step_count_;
  extremes_.add_step(*scene_, *simulation_);
  take_ticks();
  if (recorder_ == nullptr) return;
  input_.state_hash = simulation_->state_hash();
  record(input_);
}

void FreeSession::take_ticks() {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    if (!tools_[t]->loop) continue;
    std::vector<TickRecord> ticks;
    for (haptics::HapticTick tick; tools_[t]->loop->ticks().pop(tick);) {
      if (!running_) tick.tool.faults &= ~haptics::bit(haptics::Fault::Stopped);  // the run's end is no fault
      extremes_.add_tick(t, tick);
      tools_[t]->faults.add(tick.tool.faults, realtime::steady_now_ns());
      if (recorder_ != nullptr) ticks.push_back(record_of(tick));
    }
    if (!ticks.empty()) record(t, ticks);
  }
}

void FreeSession::publish_models() {
  const std::uint64_t step_ns = nanoseconds(scene_->settings.dt_s);
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    RemoteHand& hand = tools_[t]->hand;
    const messages::ToolState& state = tools_[t]->newest;
    const ModelRecord model{
        ++tools_[t]->model_sequence, realtime::steady_now_ns(), paused_, state.tool_position_world_m, 0,
        settings_of(t).shape};
    write_model(*simulation_, {state, static_cast<int>(t), model, step_ns, report_radius_m(settings_of(t))},
                hand.models->back());
    if (hand.forces != nullptr) hand.forces->publish({step_count_, force_on_hand_N(hand.models->back(), state)});
    hand.models->publish();
    record(t, model);
  }
  if (on_models_) on_models_();
}

/// Of a remote hand only the force is known, not what it is made of.
messages::FeltTool FreeSession::felt_by(std::size_t index) const {
  const Tool& tool = *tools_[index];
  if (tool.loop) {
    tool.loop->felt().update();
    return tool.loop->felt().front();
  }
  messages::FeltTool felt;
  felt.tool = tool.newest;
  felt.held = tool_in_hand(scene_->tools[index], std::nullopt);
  (scene_->settings.tether ? felt.parts.tether : felt.parts.contact) = felt.tool.force_world_N;
  return felt;
}

std::string FreeSession::fault_text() const {
  const std::uint64_t now_ns = realtime::steady_now_ns();
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    const std::string text = tools_[t]->faults.text(now_ns);
    if (!text.empty()) return tools_.size() > 1 ? fmt::format("{} hand: {}", scene_->tools[t].hand, text) : text;
  }
  return {};
}

void FreeSession::publish_frame() {
  messages::SceneFrame& frame = frames_.back();
  simulation_->write_frame(frame);
  frame.tools.clear();
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    const messages::FeltTool felt = felt_by(t);
    if (felt.tool.sequence > 0 || tools_[t]->loop) frame.tools.push_back(tool_frame(felt, *scene_, t, *simulation_));
  }
  RateMeter::Count count{realtime::steady_now_ns(), step_count_, 0, 0};
  if (haptic_thread_) {
    count.ticks = haptic_thread_->tick_count();
    count.missed_ticks = haptic_thread_->missed_count();
  }
  frame.rates = rates_.add(count);
  frame.control = conductor_.control();
  frame.control.paused = paused_;
  frame.control.recording = recording();
  frame.notice = recording_fault_.empty() ? fault_text() : recording_fault_;
  if (frame.notice.empty()) frame.notice = conductor_.notice();
  ++frame.sequence;
  frames_.publish();
  shoves_.publish(conductor_.shove_test().record());
}

}  // namespace myotact::scene
