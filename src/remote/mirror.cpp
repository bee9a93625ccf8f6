#include "remote/mirror.h"

#include <fmt/format.h>

#include "remote/controls.h"
#include "remote/frame_fit.h"

namespace myotact::remote {

std::string Mirror::trouble() const {
  const net::LinkStatus link = client_->status();
  if (link.is_final) return fmt::format("the server closed the connection for good: {}", link.why);
  if (!link.connected) return fmt::format("no connection to the server ({}); it is tried again and again", link.why);
  if (!misfit_.empty()) return fmt::format("the server shows what does not fit this scene: {}", misfit_);
  return "";
}

bool Mirror::fetch_frame(messages::SceneFrame& frame) {
  const bool is_new = client_->fetch_frame(newest_);
  if (is_new) misfit_ = misfit(newest_, scene_->specimen);
  if (is_new && misfit_.empty()) fitting_ = newest_;
  const std::string notice = trouble();
  if (!is_new && notice == told_) return false;
  told_ = notice;
  frame = fitting_;
  if (!notice.empty()) frame.notice = notice;
  return true;
}

void Mirror::request(const scene::Requests& requests) {
  if (asked_ && requests.stops != asked_->stops) client_->ask_stop();
  if (asked_ && is_instructor()) {
    for (const std::string& control : controls_between(*asked_, requests)) client_->ask(control);
  }
  asked_ = requests;
}

bool Mirror::shows_another_scene(const std::string& scene_json) const {
  const net::LinkStatus link = client_->status();
  return link.connected && !link.scene_json.empty() && link.scene_json != scene_json;
}

}  // namespace myotact::remote
