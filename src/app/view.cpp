#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/camera_device.h"
#include "app/interruption.h"
#include "app/mirror_stage.h"
#include "app/options.h"
#include "app/picture.h"
#include "app/stage.h"
#include "core/error.h"
#include "core/file.h"
#include "scene/replay_session.h"
#include "view/display_loss.h"
#include "view/window.h"

namespace myotact::app {

namespace {

constexpr double kForever_s = 1e12;

/// The picture gives way: it is drawn at most 60 times a second and takes at most half of the time, or a software
/// renderer would starve the simulation.
void leave_time_to_the_simulation(std::chrono::steady_clock::duration drawing) {
  constexpr std::chrono::milliseconds kPicture(16);
  std::this_thread::sleep_for(std::max<std::chrono::steady_clock::duration>(kPicture - drawing, drawing));
}

/// `driven`: the person took over from the script before; where undo goes back to the script's, the levels that the
/// scene started with stand for it.
scene::Requests requests_of(const view::ViewControls& controls, bool driven) {
  const view::SceneState& state = controls.scene;
  scene::Requests requests;
  requests.flexors = state.flexors;
  requests.extensors = state.extensors;
  requests.common = state.common;
  requests.difference = state.difference;
  requests.levels_asked = state.drive == view::Drive::Levels;
  requests.balance_asked = state.drive == view::Drive::Balance || (state.drive == view::Drive::Script && driven);
  requests.hold_posture = state.hold_posture;
  requests.gravity = state.gravity;
  requests.paused = controls.paused;
  requests.stops = controls.stops;
  requests.arms = controls.arms;
  requests.steps = controls.steps;
  requests.resets = controls.resets;
  requests.shoves = controls.shoves;
  requests.recording_ends = controls.recording_ends;
  return requests;
}

/// A file that is whole whenever it is read; unlike write_file() it does not wait for the disk.
void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path next = path.string() + ".next";
  std::ofstream(next, std::ios::binary) << text;
  std::filesystem::rename(next, path);
}

/// Tells what the window shows, a few times a second, where a file was named for it.
class WindowReport {
 public:
  explicit WindowReport(std::optional<std::filesystem::path> path) : path_(std::move(path)) {}

  void write(view::Window& window, const messages::SceneFrame& frame) {
    if (!path_ || std::chrono::steady_clock::now() < next_) return;
    constexpr std::chrono::milliseconds kPeriod(100);
    next_ = std::chrono::steady_clock::now() + kPeriod;
    replace_file(*path_, window.describe(frame));
  }

 private:
  std::optional<std::filesystem::path> path_;
  std::chrono::steady_clock::time_point next_;
};

/// What the person asked for, as the command line would have said it.
Options options_of(const Options& given, const view::SceneWish& wish) {
  Options options = given;
  options.scene = wish.scene;
  options.record = wish.recording;
  options.recording = wish.replay;
  options.connect.reset();  // another scene is simulated here
  if (wish.tissue.empty() && !wish.work) return options;
  std::erase_if(options.set, [](const std::string& pair) { return pair.starts_with("tissue.default="); });
  if (!wish.tissue.empty()) options.set.push_back("tissue.default=" + wish.tissue);
  return options;
}

/// A recording that is played, and nothing that could be felt.
struct ReplayStage {
  explicit ReplayStage(const Options& options)
      : loaded(scene::load_recording(*options.recording, scene_overrides_of(options))), session(loaded) {}

  view::WindowSettings window_settings(const Options& options) const {
    view::WindowSettings settings;
    view::SceneFacts& facts = settings.facts;
    facts.scenes = scene::built_in_scenes();
    facts.name = loaded.scene.name;
    const bool built_in = std::find(facts.scenes.begin(), facts.scenes.end(), facts.name) != facts.scenes.end();
    facts.file = built_in ? facts.name : options.scene;  // to go back to
    facts.title = "Myotact: " + options.recording->filename().string();
    facts.joint = watched_joint(loaded.scene);
    facts.replay_s = session.length_s();
    return settings;
  }

  const scene::LoadedRecording loaded;
  scene::ReplaySession session;
};

/// One of the three.
struct Built {
  std::unique_ptr<Stage> stage;
  std::unique_ptr<ReplayStage> replay;
  std::unique_ptr<MirrorStage> mirror;

  explicit operator bool() const { return stage || replay || mirror; }
  const anatomy::Specimen& specimen() const {
    if (mirror) return mirror->scene().specimen;
    return stage ? stage->scene().specimen : replay->loaded.scene.specimen;
  }
  view::WindowSettings window_settings(const Options& options) const {
    if (mirror) return mirror->window_settings();
    return stage ? stage->window_settings(options) : replay->window_settings(options);
  }
};

/// The window and what it shows: one stage that runs and, after a wish for another, the next one being built.
class Performance {
 public:
  explicit Performance(const Options& options)
      : options_(options), equipment_(options), report_(options.report_state), next_(begin()) {
    if (options.camera && equipment_.has(*options.camera)) {
      throw Error(ExitStatus::Usage, "--camera " + *options.camera + ": moves a tool already (--device)");
    }
    if (options.camera) camera_.emplace(*options.camera, device_settings_of(options));
  }

  ~Performance() {
    view::on_display_loss({});
    if (next_.valid()) next_.wait();
  }
  Performance(const Performance&) = delete;
  Performance& operator=(const Performance&) = delete;

  /// Until the window is closed, the time is over or the program is interrupted. Throws Error when there is no display,
  /// or when the first scene cannot be opened.
  void run(double end_s) {
    view::on_display_loss([this] {
      if (shown_.stage) shown_.stage->session().stop();
      if (shown_.mirror) shown_.mirror->stop();
    });
    while (!window_.should_close() && interruption() == 0 && runs()) {
      if (next_.valid() && next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) change_stage();
      if (!draw(end_s)) break;
    }
    end_session();
  }

 private:
  bool runs() const {
    return (!shown_.stage || shown_.stage->session().running() || next_.valid()) &&
           (!shown_.replay || shown_.replay->session.running());
  }

  std::future<Built> build(const Options& options) {
    building_ = options;
    return std::async(std::launch::async, [this, options]() -> Built {
      if (options.connect) return {nullptr, nullptr, std::make_unique<MirrorStage>(options)};
      if (options.recording) return {nullptr, std::make_unique<ReplayStage>(options), nullptr};
      return {std::make_unique<Stage>(options, guarded_, equipment_), nullptr, nullptr};
    });
  }

  std::future<Built> begin() {
    if (!options_.session) return build(options_);
    work_ = view::read_work(*options_.session, scene::built_in_scenes());
    return build(options_of(options_, {work_->scene, work_->tissue, {}, work_}));
  }

  void change_stage() {
    Built built;
    try {
      built = next_.get();
    } catch (const Error& failure) {
      if (!shown_) throw;
      spdlog::warn("{}", failure.what());
      window_.tell(failure.what());
      return;
    }
    end_session();
    const bool is_first = !shown_;
    view::WindowSettings settings = built.window_settings(building_);
    settings.work = std::exchange(work_, std::nullopt);
    window_.open(built.specimen(), settings);
    shown_ = std::move(built);
    frame_ = {};
    driven_ = false;
    if (shown_.stage) start_stage(is_first);
    if (shown_.replay) shown_.replay->session.start();
    if (shown_.mirror) shown_.mirror->start();
    heard_ = opened_ = std::chrono::steady_clock::now();
  }

  /// A device that no longer starts costs the window no more than its force: the mouse leads until a scene is opened
  /// again. Not for the first scene, whose device was asked for by its name.
  void start_stage(bool is_first) {
    scene::FreeSession& session = shown_.stage->session();
    session.follow_on(requests_of(window_.controls(), driven_), stopped_);
    try {
      session.start();
    } catch (const Error& failure) {
      if (is_first || building_.devices.empty()) throw;
      session.stop();  // ends a recording, which begins anew
      const std::string told = fmt::format("{}. The mouse leads until you open a scene again.", failure.what());
      spdlog::warn("{}", told);
      window_.tell(told);
      Options without = building_;
      without.devices.clear();
      next_ = build(without);
    }
  }

  void end_session() {
    if (shown_.replay) shown_.replay->session.stop();
    if (shown_.mirror) shown_.mirror->stop();
    if (!shown_.stage) return;
    scene::FreeSession& session = shown_.stage->session();
    if (session.running()) stopped_ = session.forces_stopped();  // a scene that is opened does not bring them back
    if (const scene::FreeTiming timing = session.stop(); !timing.refused.empty()) {
      spdlog::warn("{}", timing.refused);
    }
  }

  /// One picture; false when it was the last.
  bool draw(double end_s) {
    const auto since = std::chrono::steady_clock::now();
    if (shown_.stage && shown_.stage->session().fetch_frame(frame_)) heard_ = since;
    if (shown_.replay) shown_.replay->session.fetch_frame(frame_);
    if (shown_.mirror) shown_.mirror->fetch_frame(frame_);
    // A server's time began long ago.
    const double shown_s = shown_.mirror ? std::chrono::duration<double>(since - opened_).count() : frame_.time_s;
    const bool last = shown_s >= end_s;
    if (last) window_.save_next_picture(options_.out / "window.png");
    if (shown_.stage) {
      const double silence_s = std::chrono::duration<double>(since - heard_).count();
      window_.set_news({shown_.stage->session().recording(), next_.valid(), silence_s, shown_.stage->device_news()});
      window_.set_readings(shown_.stage->readings(frame_, common_));
    } else if (shown_) {
      window_.set_news({false, next_.valid(), 0.0});
    }
    if (camera_) follow_camera();
    const view::ViewControls& controls = window_.draw(frame_);
    if (shown_) report_.write(window_, frame_);
    leave_time_to_the_simulation(std::chrono::steady_clock::now() - since);
    lead(controls);
    if (const auto wish = window_.take_wish(); wish && !next_.valid()) follow(*wish);
    return !last;
  }

  void follow_camera() {
    window_.push_view(camera_->push());
    if (const std::string hint = camera_->take_hint(); !hint.empty()) window_.tell(*options_.camera + ": " + hint);
  }

  /// What the person asks for goes to the session and the hand.
  void lead(const view::ViewControls& controls) {
    common_ = controls.scene.common;
    driven_ = driven_ || controls.scene.drive != view::Drive::Script;
    if (shown_.replay) shown_.replay->session.play_to(controls.replay_to_s);
    if (shown_.stage) {
      shown_.stage->session().request(requests_of(controls, driven_));
      shown_.stage->move_hand(controls);
    }
    if (!shown_.mirror) return;
    const std::string refused = shown_.mirror->lead(controls, requests_of(controls, driven_));
    if (!refused.empty()) window_.tell(refused);
    constexpr std::chrono::seconds kPatience(5);  // between two tries, where this machine lacks the files
    if (!shown_.mirror->is_outdated() || next_.valid() || std::chrono::steady_clock::now() < opened_ + kPatience)
      return;
    opened_ = std::chrono::steady_clock::now();
    next_ = build(options_);
  }

  /// Builds the scene that the person wants.
  void follow(const view::SceneWish& wish) {
    if (shown_.mirror && wish.recording) {
      return window_.tell("a scene is recorded where it is simulated: start the server with --record FILE");
    }
    work_ = wish.work;
    next_ = build(options_of(options_, wish));
  }

  GuardedMotors guarded_;                // first: the watchdog is forked off before there are threads
  Options options_;                      // of the command line
  Equipment equipment_;                  // opened once; scenes come and go
  std::optional<CameraDevice> camera_;   // that turns the view
  Options building_;                     // of the newest stage
  std::optional<view::SavedWork> work_;  // that it is to begin with
  WindowReport report_;
  Built shown_;              // none before the first is built
  std::future<Built> next_;  // being built
  view::Window window_;      // after the stages: it shows their specimens
  messages::SceneFrame frame_;
  std::chrono::steady_clock::time_point heard_;   // when the newest frame came
  std::chrono::steady_clock::time_point opened_;  // what is shown
  double common_ = 0.0;
  bool driven_ = false;
  bool stopped_ = false;  // forces, when the session before ended
};

}  // namespace

int view(const Options& options) {
  if (options.seconds) make_writable_folder(options.out);
  Performance performance(options);
  watch_for_interruption();
  performance.run(options.seconds.value_or(kForever_s));
  return interruption();
}

}  // namespace myotact::app
