#include "view/window/description.h"

#include <algorithm>
#include <array>

#include <imgui.h>
#include <nlohmann/json.hpp>

#include "view/panels/device_part.h"
#include "view/ui/controls.h"

namespace myotact::view {

namespace {

using Json = nlohmann::ordered_json;

template <typename Part>
std::string key_of(const std::vector<Part>& parts, int index) {
  return index >= 0 && index < static_cast<int>(parts.size()) ? parts[static_cast<std::size_t>(index)].key : "";
}

template <typename Part>
Json keys_where(const std::vector<Part>& parts, const std::vector<PartLook>& looks, bool PartLook::*what) {
  Json keys = Json::array();
  for (std::size_t i = 0; i < parts.size() && i < looks.size(); ++i) {
    if (looks[i].*what) keys.push_back(parts[i].key);
  }
  return keys;
}

Json view_json(const anatomy::Specimen& specimen, const ViewState& view) {
  return {{"selected_muscle", key_of(specimen.muscles, view.selected_muscle)},
          {"selected_bone", key_of(specimen.bones, view.selected_bone)},
          {"hidden_muscles", keys_where(specimen.muscles, view.muscles, &PartLook::hidden)},
          {"hidden_bones", keys_where(specimen.bones, view.bones, &PartLook::hidden)},
          {"faded_muscles", keys_where(specimen.muscles, view.muscles, &PartLook::faded)},
          {"faded_bones", keys_where(specimen.bones, view.bones, &PartLook::faded)},
          {"camera",
           {{"azimuth_rad", view.camera.azimuth_rad},
            {"elevation_rad", view.camera.elevation_rad},
            {"distance_m", view.camera.distance_m}}}};
}

Json scene_json(const PanelContext& context) {
  const messages::ControlState& scene = context.scene.state();
  const char* drive = scene.drive == Drive::Script ? "script" : scene.drive == Drive::Levels ? "levels" : "balance";
  return {{"drive", drive},           {"flexors", scene.flexors},       {"extensors", scene.extensors},
          {"common", scene.common},   {"difference", scene.difference}, {"hold_posture", scene.hold_posture},
          {"gravity", scene.gravity}, {"paused", scene.paused},         {"clutch", context.controls.clutch}};
}

Json frame_json(const PanelContext& context) {
  Json joints = Json::object(), tools = Json::array();
  for (std::size_t j = 0; j < context.frame.joints.size() && j < context.specimen.joints.size(); ++j) {
    const messages::JointFrame& joint = context.frame.joints[j];
    joints[context.specimen.joints[j].key] = {{"angle_rad", joint.angle_rad}, {"K_Nm_rad", joint.stiffness_Nm_rad}};
  }
  for (const messages::ToolFrame& tool : context.frame.tools) {
    tools.push_back({{"force_world_N", tool.force_world_N},
                     {"tool_world_m", tool.tool_world_m},
                     {"proxy_world_m", tool.proxy_world_m},
                     {"radius_m", tool.radius_m},
                     {"in_contact", tool.in_contact},
                     {"touched_muscle", key_of(context.specimen.muscles, tool.touched_muscle)},
                     {"grabbed_line", key_of(context.specimen.muscles, tool.grabbed_line)},
                     {"forces_stopped", tool.forces_stopped}});
  }
  return {{"time_s", context.frame.time_s}, {"notice", context.frame.notice}, {"joints", joints}, {"tools", tools}};
}

Json devices_json(const std::vector<DeviceNews>& devices) {
  Json all = Json::array();
  for (const DeviceNews& device : devices) {
    all.push_back({{"name", device.name},
                   {"hand", device.left ? "left" : "right"},
                   {"phase", phase_name(device.report.phase)},
                   {"rate_hz", device.report.rate_Hz},
                   {"warmth", device.report.warmth},
                   {"hint", device.report.hint},
                   {"clutched", device.clutched}});
  }
  return all;
}

/// Where the middles of muscles' skins and lines are on the screen [pixels of the window], whatever hides them.
Json places_json(const PanelContext& context, const Area& scene) {
  if (scene.empty()) return Json::object();
  const glm::mat4 clip_from_world = context.view.camera.clip_from_world(scene.width / scene.height);
  const auto on_screen = [&](const glm::vec3& place_world_m) {
    const glm::vec4 clip = clip_from_world * glm::vec4(place_world_m, 1.0f);
    return std::array{scene.x + scene.width * (0.5f + 0.5f * clip.x / clip.w),
                      scene.y + scene.height * (0.5f - 0.5f * clip.y / clip.w)};
  };
  Json skins = Json::object(), lines = Json::object();
  const messages::SceneFrame& frame = context.frame;
  for (std::size_t m = 0; m < context.specimen.muscles.size() && m < frame.skins_world_m.size(); ++m) {
    glm::vec3 sum(0.0f);
    for (const auto& p : frame.skins_world_m[m]) sum += glm::vec3(p[0], p[1], p[2]);
    const auto count = static_cast<float>(std::max<std::size_t>(frame.skins_world_m[m].size(), 1));
    skins[context.specimen.muscles[m].key] = on_screen(sum / count);
    if (m >= frame.lines_world_m.size() || frame.lines_world_m[m].empty()) continue;
    const auto& p = frame.lines_world_m[m][frame.lines_world_m[m].size() / 2];
    lines[context.specimen.muscles[m].key] = on_screen(glm::vec3(p[0], p[1], p[2]));
  }
  return {{"muscles", skins}, {"lines", lines}};
}

}  // namespace

std::string describe(const PanelContext& context, const Layout& layout, const ShownMoment& moment) {
  Json controls = Json::array();
  for (const ui::ControlPlace& control : ui::controls_of_last_picture()) {
    controls.push_back({{"key", control.key},
                        {"value", control.value},
                        {"focused", control.focused},
                        {"box", {control.x, control.y, control.width, control.height}}});
  }
  const Area& scene = layout.scene;
  return Json{{"scene_name", context.facts.name},
              {"recording", context.scene.state().recording},
              {"opening", context.news.opening},
              {"filming", context.filming},
              {"replay_s", context.facts.replay_s},
              {"looking_back", moment.looking_back},
              {"turning", moment.turning},
              {"newest_s", moment.newest_s},
              {"picture", ImGui::GetFrameCount()},
              {"view", view_json(context.specimen, context.view)},
              {"scene", scene_json(context)},
              {"frame", frame_json(context)},
              {"pictures_per_s", ImGui::GetIO().Framerate},
              {"devices", devices_json(context.news.devices)},
              {"places", places_json(context, layout.scene)},
              {"scene_box", {scene.x, scene.y, scene.width, scene.height}},
              {"controls", controls}}
      .dump(1);
}

}  // namespace myotact::view
