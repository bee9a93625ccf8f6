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
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/camera_device.h"
#include "app/equipment.h"
#include "app/guarded_motors.h"
#include "app/interruption.h"
#include "app/options.h"
#include "app/stage.h"
#include "core/error.h"
#include "core/file.h"
#include "view/window/display_loss.h"
#include "view/window/window.h"

namespace myotact::app {

namespace {

constexpr double kForever_s = 1e12;

/// The picture gives way: it is drawn at most 60 times a second and takes at most half of the time, or a software
/// renderer would starve the simulation.
void leave_time_to_the_simulation(std::chrono::steady_clock::duration drawing) {
  constexpr std::chrono::milliseconds kPicture(16);
  std::this_thread::sleep_for(std::max<std::chrono::steady_clock::duration>(kPicture - drawing, drawing));
}

/// A file that is whole whenever it is read; unlike write_file() it does not wait for the disk.
void replace_file(const std::filesystem::path& path, const std::string& text) {
  const std::filesystem::path next = path.string() + ".next";
  std::ofstream(next, std::ios::binary) << text;
  std::filesystem::rename(next, path);
}

/// Writes what the window shows, with every picture that takes as long as a software renderer's, where a file was named
/// for it.
class WindowReport {
 public:
  explicit WindowReport(std::optional<std::filesystem::path> path) : path_(std::move(path)) {}

  void write(view::Window& window, const messages::SceneFrame& frame) {
    if (!path_ || std::chrono::steady_clock::now() < next_) return;
    constexpr std::chrono::milliseconds kPeriod(40);
    next_ = std::chrono::steady_clock::now() + kPeriod;
    replace_file(*path_, window.describe(frame));
  }

 private:
  std::optional<std::filesystem::path> path_;
  std::chrono::steady_clock::time_point next_;
};

/// How long pictures take, for whoever asks by --log-level debug.
class PictureTimes {
 public:
  void add(std::chrono::steady_clock::duration drawing) {
    constexpr std::size_t kPictures = 100;
    taken_ms_.push_back(std::chrono::duration<double, std::milli>(drawing).count());
    if (taken_ms_.size() < kPictures) return;
    std::sort(taken_ms_.begin(), taken_ms_.end());
    spdlog::debug("of {} pictures the quickest took {:.1f} ms, half at most {:.1f} ms", kPictures, taken_ms_.front(),
                  taken_ms_[kPictures / 2]);
    taken_ms_.clear();
  }

 private:
  std::vector<double> taken_ms_;
};

/// What the person asked for, as the command line would have said it.
Options options_of(const Options& given, const view::SceneWish& wish) {
  Options options = given;
  options.scene = wish.scene;
  options.record = wish.recording;
  options.recording = wish.replay;
  options.connect.reset();  // another scene is simulated here
  if (wish.to_join) {
    options.connect = wish.to_join->address;
    options.token = wish.to_join->token;
    options.devices = {"mouse"};  // a hand in it, by what everybody has
    return options;
  }
  if (wish.tissue.empty() && !wish.work) return options;
  std::erase_if(options.set, [](const std::string& pair) { return pair.starts_with("tissue.default="); });
  if (!wish.tissue.empty()) options.set.push_back("tissue.default=" + wish.tissue);
  return options;
}

/// The window and what it shows: one stage that runs and, after a wish for another, the next one being built.
class WindowApp {
 public:
  explicit WindowApp(const Options& options)
      : options_(options), equipment_(options), report_(options.report_state), window_({}, options.offers_start) {
    if (options.camera && equipment_.has(*options.camera)) {
      throw Error(ExitStatus::Usage, "--camera " + *options.camera + ": moves a tool already (--device)");
    }
    if (options.camera) camera_.emplace(*options.camera, device_settings_of(options));
    begin();  // last: no scene is built where there is no window to show it
  }

  ~WindowApp() {
    view::on_display_loss({});
    if (next_.valid()) next_.wait();
  }
  WindowApp(const WindowApp&) = delete;
  WindowApp& operator=(const WindowApp&) = delete;

  /// Until the window is closed, the time is over or the program is interrupted. Throws Error when there is no display,
  /// or when the first scene cannot be opened.
  void run(double end_s) {
    view::on_display_loss([this] {
      if (shown_) shown_->session().stop();
    });
    while (!window_.should_close() && interruption() == 0 && runs()) {
      if (next_.valid() && next_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) change_stage();
      if (!draw(end_s)) break;
    }
    end_session();
  }

 private:
  bool runs() const { return !shown_ || shown_->session().running() || next_.valid(); }

  std::future<std::unique_ptr<Stage>> build(const Options& options) {
    building_ = options;
    return std::async(std::launch::async, [this, options] { return make_stage(options, guarded_, equipment_); });
  }

  void begin() {
    if (options_.session) work_ = view::read_work(*options_.session, scene::built_in_scenes());
    next_ = build(work_ ? options_of(options_, {work_->scene, work_->tissue, {}, work_}) : options_);
  }

  void change_stage() {
    std::unique_ptr<Stage> built;
    try {
      built = next_.get();
    } catch (const Error& failure) {
      if (!shown_) throw;
      spdlog::warn("{}", failure.what());
      window_.show_message(failure.what());
      return;
    }
    const bool is_first = !shown_;
    if (shown_) let_go(shown_->session());
    view::WindowSettings settings = built->window_settings(building_);
    settings.work = std::exchange(work_, std::nullopt);
    window_.open(built->scene().specimen, settings);
    retire(std::exchange(shown_, std::move(built)));
    frame_ = {};
    start_session(is_first);
    heard_ = opened_ = std::chrono::steady_clock::now();
  }

  /// A device that no longer starts costs the window no more than its force: the mouse leads until a scene is opened
  /// again. Not for the first scene, whose device was asked for by its name.
  void start_session(bool is_first) {
    scene::Session& session = shown_->session();
    if (stopped_) session.start_stopped();
    try {
      session.start();
    } catch (const Error& failure) {
      if (is_first || building_.devices.empty()) throw;
      session.stop();  // ends a recording, which begins anew
      const std::string message = fmt::format("{}. The mouse leads until you open a scene again.", failure.what());
      spdlog::warn("{}", message);
      window_.show_message(message);
      Options without = building_;
      without.devices.clear();
      next_ = build(without);
    }
  }

  void let_go(scene::Session& session) {
    if (session.running()) stopped_ = session.forces_stopped();  // a scene that is opened does not bring them back
    session.let_go();
  }

  static void end(Stage& stage) {
    stage.session().stop();
    if (const std::string refused = stage.refused(); !refused.empty()) spdlog::warn("{}", refused);
  }

  /// A step that hangs may keep its scene for as long as it likes: the next one does not wait for it.
  void retire(std::unique_ptr<Stage> stage) {
    if (!stage) return;
    std::erase_if(retiring_,
                  [](const auto& one) { return one.wait_for(std::chrono::seconds(0)) == std::future_status::ready; });
    retiring_.push_back(std::async(std::launch::async, [stage = std::move(stage)]() mutable {
      try {
        end(*stage);
      } catch (const std::exception& failure) {
        spdlog::warn("the scene before ended with a fault: {}", failure.what());
      }
      stage.reset();  // now, and not with the future: a whole limb takes hundreds of megabytes
    }));
  }

  void end_session() {
    if (shown_) end(*shown_);
  }

  /// One picture; false when it was the last.
  bool draw(double end_s) {
    const auto since = std::chrono::steady_clock::now();
    if (shown_ && shown_->session().fetch_frame(frame_)) heard_ = since;
    const bool last = shown_ && shown_->shown_s(frame_) >= end_s;
    if (last) window_.save_next_picture(options_.out / "window.png");
    if (shown_) {
      const double silence_s = std::chrono::duration<double>(since - heard_).count();
      window_.set_news(
          {next_.valid(), shown_->simulates() ? silence_s : 0.0, shown_->device_news(), shown_->class_news()});
      window_.set_readings(shown_->readings(frame_));
    }
    if (camera_) follow_camera();
    const view::ViewControls& controls = window_.draw(frame_);
    if (shown_) report_.write(window_, frame_);
    const auto drawing = std::chrono::steady_clock::now() - since;
    times_.add(drawing);
    leave_time_to_the_simulation(drawing);
    lead(controls);
    if (const auto wish = window_.take_wish(); wish && !next_.valid()) follow(*wish);
    return !last;
  }

  void follow_camera() {
    window_.push_view(camera_->push());
    if (const std::string hint = camera_->take_hint(); !hint.empty())
      window_.show_message(*options_.camera + ": " + hint);
  }

  /// What the person asks for goes to the session and the hand; a stop before anything else.
  void lead(const view::ViewControls& controls) {
    if (!shown_) return;
    scene::Session& session = shown_->session();
    if (const auto on = window_.take_forces_on()) session.stop_forces(!*on);
    for (const messages::Command& command : window_.take_commands()) {
      if (const std::string why_not = session.push(command); !why_not.empty()) window_.show_message(why_not);
    }
    shown_->lead(controls);
    constexpr std::chrono::seconds kPatience(5);  // between two tries, where this machine lacks the files
    if (!shown_->is_outdated() || next_.valid() || std::chrono::steady_clock::now() < opened_ + kPatience) return;
    opened_ = std::chrono::steady_clock::now();
    next_ = build(options_);
  }

  /// Builds the scene that the person wants.
  void follow(const view::SceneWish& wish) {
    if (wish.recording && !shown_->simulates()) {
      return window_.show_message("a scene is recorded where it is simulated: start the server with --record FILE");
    }
    work_ = wish.work;
    next_ = build(options_of(options_, wish));
  }

  GuardedMotors guarded_;                // first: the watchdog is forked off before there are threads
  Options options_;                      // of the command line
  Equipment equipment_;                  // opened once; scenes come and go
  std::optional<CameraDevice> camera_;   // that rotates the view
  Options building_;                     // of the newest stage
  std::optional<view::SavedWork> work_;  // that it is to begin with
  WindowReport report_;
  PictureTimes times_;
  std::unique_ptr<Stage> shown_;              // none before the first is built
  std::vector<std::future<void>> retiring_;   // scenes before whose last step has not ended
  std::future<std::unique_ptr<Stage>> next_;  // being built
  view::Window window_;                       // after the stages: it shows their specimens
  messages::SceneFrame frame_;
  std::chrono::steady_clock::time_point heard_;   // when the newest frame came
  std::chrono::steady_clock::time_point opened_;  // what is shown
  bool stopped_ = false;                          // forces, when the session before ended
};

}  // namespace

int view(const Options& options) {
  if (options.seconds) make_writable_folder(options.out);
  WindowApp app(options);
  watch_for_interruption();
  app.run(options.seconds.value_or(kForever_s));
  return interruption();
}

}  // namespace myotact::app
