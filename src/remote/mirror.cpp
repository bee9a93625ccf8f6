#include "remote/mirror.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/vector.h"
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

bool Mirror::push(const messages::Command& command) {
  const std::optional<std::string> control = control_of(command.order);
  if (!control || client_->status().welcome.role != net::Role::Instructor) return false;
  client_->ask(*control);
  return true;
}

bool Mirror::shows_another_scene(const std::string& scene_json) const {
  const net::LinkStatus link = client_->status();
  return link.connected && !link.scene_json.empty() && link.scene_json != scene_json;
}

void show_own_hand(const messages::FeltTool& felt, messages::SceneFrame& frame) {
  const Vec3 hand_m = to_vec3(felt.tool.tool_position_world_m);
  const auto distance_m = [&](const messages::ToolFrame& tool) { return (to_vec3(tool.tool_world_m) - hand_m).norm(); };
  const auto own = std::min_element(frame.tools.begin(), frame.tools.end(),
                                    [&](const auto& a, const auto& b) { return distance_m(a) < distance_m(b); });
  if (own == frame.tools.end()) return;
  own->tool_world_m = felt.tool.tool_position_world_m;
  own->proxy_world_m = felt.tool.proxy_position_world_m;
  own->force_world_N = felt.tool.force_world_N;
  own->parts = felt.parts;
  own->line_tension_N = felt.line_tension_N;
  own->model_age_s = felt.model_age_s;
}

}  // namespace myotact::remote
