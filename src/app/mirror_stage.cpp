#include "app/mirror_stage.h"

#include <algorithm>
#include <variant>

#include <fmt/format.h>

#include "app/network_options.h"
#include "app/scene_facts.h"
#include "core/error.h"
#include "remote/class_news.h"
#include "remote/scene_message.h"
#include "remote/served_scene.h"
#include "scene/conductor.h"

namespace myotact::app {

namespace {

bool takes_a_hand(const Options& options) {
  if (options.devices.empty()) return false;
  if (options.devices.size() == 1 && options.devices.front() == "mouse") return true;
  throw Error(ExitStatus::Usage,
              "--device: beside --connect the window takes the mouse or no device; `myotact feel` is for others");
}

net::Role role_of(const Options& options) {
  if (options.role == "instructor") return net::Role::Instructor;
  return options.role == "student" || takes_a_hand(options) ? net::Role::Student : net::Role::Viewer;
}

net::Token token_for(const Options& options) {
  const std::optional<net::Token> instructors =
      role_of(options) == net::Role::Instructor ? token_of("MYOTACT_INSTRUCTOR_TOKEN") : std::nullopt;
  return instructors ? *instructors : own_token(options);
}

net::ClientSettings client_settings(const Options& options) {
  net::ClientSettings settings;
  settings.server = server_of(options);
  settings.hello.role = role_of(options);
  settings.hello.wants.hand = takes_a_hand(options);
  settings.hello.wants.frames = settings.hello.wants.readings = settings.hello.wants.in_force = true;
  settings.hello.wants.announcements = settings.hello.role == net::Role::Instructor;
  settings.hello.token = token_for(options);
  settings.hello.name = "view";
  return settings;
}

}  // namespace

MirrorStage::MirrorStage(const Options& options)
    : answer_(net::ask_scene(server_of(options), token_for(options))),
      scene_(remote::scene_of_message(answer_.scene_json)),
      mouse_(scene::start_of_hand(scene_, 0)) {
  const net::ClientSettings settings = client_settings(options);
  if (settings.hello.wants.hand) {
    hand_ = std::make_unique<remote::FreeHand>(settings, mouse_, scene_.tools[0], nullptr);
  } else {
    watcher_ = std::make_unique<net::Client>(settings);
    watcher_->start();
  }
  mirror_ = std::make_unique<remote::Mirror>(hand_ ? hand_->client() : *watcher_, scene_);
}

void MirrorStage::start() {
  if (hand_) hand_->start();
  started_ = std::chrono::steady_clock::now();
}

void MirrorStage::stop() noexcept {
  if (hand_) hand_->stop();
  if (watcher_) watcher_->stop();
}

double MirrorStage::shown_s(const messages::SceneFrame&) const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

bool MirrorStage::fetch_frame(messages::SceneFrame& frame) {
  const bool is_new = mirror_->fetch_frame(frame);
  if (!hand_) return is_new;
  hand_->loop().felt().update();
  remote::show_own_hand(hand_->loop().felt().front(), frame);
  return true;
}

void MirrorStage::lead(const view::ViewControls& controls) {
  mouse_.set_pointer(to_vec3(controls.hand_world_m), controls.hand_buttons);
}

std::string MirrorStage::push(const messages::Command& command) {
  if (std::holds_alternative<messages::EndRecording>(command.order)) {
    return "a recording ends where the scene is simulated: at the server";
  }
  if (mirror_->push(command)) return "";
  return "only an instructor changes the scene: connect with --role instructor, and the instructor's token where the "
         "server has one";
}

void MirrorStage::stop_own_hand(bool stopped) noexcept {
  stopped_ = stopped;
  if (hand_) hand_->loop().stop_forces(stopped);
}

void MirrorStage::stop_forces(bool stopped) noexcept {
  stop_own_hand(stopped);
  if (stopped) mirror_->ask_stop();
}

std::optional<view::ClassNews> MirrorStage::class_news() {
  const std::string said = (hand_ ? hand_->client() : *watcher_).status().announcement;
  if (said != heard_) {
    heard_ = said;
    const auto news = remote::class_news(said);
    class_news_.reset();
    if (news && !news->join_link.empty()) class_news_ = {news->join_link, news->students, news->hands_up};
  }
  return class_news_;
}

view::WindowSettings MirrorStage::window_settings(const Options&) const {
  view::WindowSettings settings;
  settings.facts = facts_of(scene_);
  settings.facts.is_served = true;
  const auto& scenes = settings.facts.scenes;
  const bool built_in = std::find(scenes.begin(), scenes.end(), scene_.name) != scenes.end();
  settings.facts.file = built_in ? scene_.name : "elbow";  // to open one on this machine
  settings.facts.device_peaks_N.assign(remote::kMostHands, mouse_.profile().peak_force_N);
  settings.hand_start_world_m = to_array(scene::start_of_hand(scene_, 0));
  settings.start = start_of(scene_);
  return settings;
}

}  // namespace myotact::app
