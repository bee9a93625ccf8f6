#include "view/window/pointer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "messages/device.h"
#include "view/look/part_actions.h"

namespace myotact::view {

namespace {

constexpr float kTurn_rad = 0.008f;       // of the camera, a pixel
constexpr float kCloser = 0.9f;           // of the camera's distance, a click of the wheel
constexpr float kWheel_px = 0.1f;         // clicks of the wheel, a pixel of a drag that comes nearer
constexpr float kClick_px = 5.0f;         // a press that moves less is a click
constexpr double kFreeDepth_m = 0.005;    // of the free hand, a click of the wheel
constexpr double kHover_m = 0.008;        // of the tool's surface above the limb's: it does not touch by accident
constexpr double kClear_m = 0.03;         // of a hand let go above the dent that it made: tissue swells back
constexpr double kPressTime_s = 0.6;      // from touching to the whole depth
constexpr double kDepthStep_m = 0.00025;  // a click of the wheel
constexpr double kDeepest_m = 0.006;      // 800 N/m times this is more than any small device gives
constexpr double kHandSpeed_m_s = 0.35;   // of a hand that is in no hurry; below every device's cut-off
constexpr double kArrived_m = 0.002;

glm::dvec3 to_dvec3(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

float metres_a_pixel(const Camera& camera, const Area& scene) {
  return 2.0f * camera.distance_m * std::tan(0.5f * Camera::kFieldOfView_rad) / scene.height;
}

/// In the plane of the picture with the mouse, in its depth with the wheel.
void move_freely(const Area& scene, const Camera& camera, bool wheel, ViewControls& controls) {
  const ImGuiIO& io = ImGui::GetIO();
  const glm::vec3 step =
      metres_a_pixel(camera, scene) * (io.MouseDelta.x * camera.right_world() - io.MouseDelta.y * camera.up_world()) +
      (wheel ? static_cast<float>(kFreeDepth_m) * io.MouseWheel : 0.0f) * camera.forward_world();
  for (int k = 0; k < 3; ++k) controls.hand_world_m[static_cast<std::size_t>(k)] += static_cast<double>(step[k]);
}

/// Nearer, about the place under the pointer: that one stays where it is in the picture.
void zoom_to_pointer(const Area& scene, Camera& camera) {
  const ImGuiIO& io = ImGui::GetIO();
  const float factor = std::pow(kCloser, io.MouseWheel);
  const float before = metres_a_pixel(camera, scene);
  const float distance_m = camera.distance_m;
  camera.zoom(factor);
  const float moved = before * (1.0f - camera.distance_m / distance_m);
  const float right = io.MousePos.x - (scene.x + 0.5f * scene.width);
  const float down = io.MousePos.y - (scene.y + 0.5f * scene.height);
  camera.target_world_m += moved * (right * camera.right_world() - down * camera.up_world());
}

bool is_click(ImGuiMouseButton button) {
  const ImGuiIO& io = ImGui::GetIO();
  return ImGui::IsMouseReleased(button) && io.MouseDragMaxDistanceSqr[button] < kClick_px * kClick_px;
}

/// Where a hand behind the limb goes first, so that bones do not hold it back there: aside, then towards the eye.
/// Nothing: it is not behind. `way`: from the hand to its target; `towards_eye`: a unit vector.
std::optional<glm::dvec3> way_round(const glm::dvec3& way, const glm::dvec3& towards_eye, const glm::dvec3& right) {
  constexpr double kBehind_m = 0.03, kBeside_m = 0.1;  // a limb is thicker than the first, half of it thinner than this
  const double behind_m = glm::dot(way, towards_eye);
  if (behind_m < kBehind_m) return std::nullopt;
  const double beside_m = glm::dot(way, right);
  if (std::abs(beside_m) >= kBeside_m) return behind_m * towards_eye;
  constexpr double kFarther = 1.1;  // than what counts as beside
  return (beside_m + (beside_m > 0.0 ? -kFarther : kFarther) * kBeside_m) * right;
}

/// Of the ring of standard views the next one in the direction of a drag.
const char* next_view(const Camera& camera, bool left_limb, const ImVec2& drag) {
  constexpr float kLevel_rad = 0.7f;
  if (std::abs(drag.y) > std::abs(drag.x)) {
    if (std::abs(camera.elevation_rad) > kLevel_rad) return "lateral";
    return drag.y > 0.0f ? "dorsal" : "palmar";
  }
  constexpr std::array kRing = {"cranial", "lateral", "caudal", "medial"};  // by the azimuth of a left limb's eye
  const float side = left_limb ? 1.0f : -1.0f;
  const auto quarter = static_cast<int>(std::lround(side * camera.azimuth_rad / 1.5707964f));
  const int step = (drag.x < 0.0f ? 1 : -1) * static_cast<int>(side);
  return kRing[static_cast<std::size_t>(((quarter + step) % 4 + 4) % 4)];
}

}  // namespace

std::optional<PickHit> Pointer::look_through(const PanelContext& context, const Area& scene,
                                             const std::vector<bool>& superficial) const {
  const ImVec2 at = ImGui::GetIO().MousePos;
  const Ray ray = ray_through(context.view.camera, (at.x - scene.x) / scene.width, (at.y - scene.y) / scene.height,
                              scene.width / scene.height);
  if (!context.view.names_hidden || mode_ == PointerMode::Look) {
    return pick(context.specimen, context.frame, context.view, superficial, ray);
  }
  // What is to be known by touch is felt where it cannot be seen.
  ViewState uncovered = context.view;
  for (PartLook& look : uncovered.muscles) look = {};
  return pick(context.specimen, context.frame, uncovered, superficial, ray);
}

void Pointer::begin_camera_drag() {
  const ImGuiIO& io = ImGui::GetIO();
  if (camera_press_ || (mode_ != PointerMode::Look && arrived_)) return;
  const int mods =
      (io.KeyShift ? GLFW_MOD_SHIFT : 0) | (io.KeyCtrl ? GLFW_MOD_CONTROL : 0) | (io.KeyAlt ? GLFW_MOD_ALT : 0);
  for (const int button : {ImGuiMouseButton_Left, ImGuiMouseButton_Right, ImGuiMouseButton_Middle}) {
    if (!ImGui::IsMouseClicked(button)) continue;
    if (const auto drag = camera_drag(preset, button, mods, mode_ == PointerMode::Look))
      camera_press_ = {button, *drag};
  }
}

void Pointer::drag_camera(PanelContext& context, const Area& scene) const {
  const ImGuiIO& io = ImGui::GetIO();
  const auto& [button, drag] = *camera_press_;
  if (drag == CameraDrag::Rotate) return rotate(context, button);
  if (!ImGui::IsMouseDragging(button, kClick_px)) return;
  if (drag == CameraDrag::Shift) {
    context.view.camera.pan(io.MouseDelta.x / scene.height, -io.MouseDelta.y / scene.height);
  } else {
    context.view.camera.zoom(std::pow(kCloser, -kWheel_px * io.MouseDelta.y));
  }
}

void Pointer::rotate(PanelContext& context, int button) const {
  const ImGuiIO& io = ImGui::GetIO();
  Camera& camera = context.view.camera;
  if (free_orbit) {
    if (ImGui::IsMouseDragging(button, kClick_px)) {
      camera.orbit(-kTurn_rad * io.MouseDelta.x, kTurn_rad * io.MouseDelta.y);
    }
    return;
  }
  constexpr float kDrag_px = 40.0f;  // shorter ones may be slips
  const ImVec2 start = io.MouseClickedPos[button];
  const ImVec2 drag(io.MousePos.x - start.x, io.MousePos.y - start.y);
  if (ImGui::IsMouseReleased(button) && std::hypot(drag.x, drag.y) > kDrag_px) {
    context.asks.standard_view = next_view(camera, context.specimen.side != "right", drag);
  }
}

void Pointer::look(PanelContext& context, const Area& scene) {
  const ImGuiIO& io = ImGui::GetIO();
  if (is_click(ImGuiMouseButton_Left)) select(context.view, hovered_);
  if (hovered_ && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) isolate(context.view, hovered_);
  if (io.MouseWheel != 0.0f) zoom_to_pointer(scene, context.view.camera);
}

/// No faster than a hand: on the way to a far place it is lifted towards the eye, so that it goes round the limb.
void Pointer::move_towards(PanelContext& context, const glm::dvec3& target_m) {
  constexpr double kNear_m = 0.02, kHighest_m = 0.06;
  const glm::dvec3 towards_eye = -glm::dvec3(context.view.camera.forward_world());
  const glm::dvec3 hand_m = to_dvec3(context.controls.hand_world_m);
  const glm::dvec3 way = target_m - hand_m;
  const glm::dvec3 aside = way - glm::dot(way, towards_eye) * towards_eye;
  const double lift_m = std::clamp(glm::length(aside) - kNear_m, 0.0, kHighest_m);
  const glm::dvec3 right(context.view.camera.right_world());
  const glm::dvec3 next = way_round(way, towards_eye, right).value_or(way + lift_m * towards_eye);
  const double farthest_m = kHandSpeed_m_s * std::min(static_cast<double>(ImGui::GetIO().DeltaTime), 0.1);
  const double share = std::min(1.0, farthest_m / std::max(glm::length(next), 1e-9));
  const glm::dvec3 now_m = hand_m + share * next;
  for (int k = 0; k < 3; ++k) context.controls.hand_world_m[static_cast<std::size_t>(k)] = now_m[k];
}

void Pointer::hold_above(PanelContext& context, const PickHit& hit, double height_m) {
  const double radius_m = context.frame.tools.empty() ? 0.0 : context.frame.tools.front().radius_m;
  const glm::dvec3 towards_eye = -glm::dvec3(context.view.camera.forward_world());
  move_towards(context, glm::dvec3(hit.point_world_m) + (radius_m + height_m) * towards_eye);
}

/// A button that is let go beside the limb, or over a panel, must not leave the tool in the tissue: it would press on,
/// unseen.
void Pointer::let_go(PanelContext& context) {
  if (!above_world_m_) return;
  pressed_s_ = 0.0;
  context.controls.hand_moves = true;
  move_towards(context, *above_world_m_);
  if (glm::distance(to_dvec3(context.controls.hand_world_m), *above_world_m_) < kArrived_m) above_world_m_.reset();
}

void Pointer::touch(PanelContext& context, const std::optional<PickHit>& hit) {
  const ImGuiIO& io = ImGui::GetIO();
  const bool pressed = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  depth_m_ = std::clamp(depth_m_ + kDepthStep_m * static_cast<double>(io.MouseWheel), kDepthStep_m, kDeepest_m);
  pressed_s_ = pressed ? pressed_s_ + static_cast<double>(io.DeltaTime) : 0.0;
  if (!hit) {
    if (!pressed) let_go(context);
    return;  // else the hand stays where it is
  }
  above_world_m_ = glm::dvec3(hit->point_world_m) - kClear_m * glm::dvec3(context.view.camera.forward_world());
  const double share = std::min(1.0, pressed_s_ / kPressTime_s);
  hold_above(context, *hit, kHover_m - share * (kHover_m + depth_m_));
}

void Pointer::pull(PanelContext& context, const Area& scene, const std::optional<PickHit>& hit) {
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    arrived_ = false;
    if (hit) above_world_m_.reset();
    hit ? hold_above(context, *hit, kHover_m) : let_go(context);
    if (ImGui::GetIO().MouseWheel != 0.0f) zoom_to_pointer(scene, context.view.camera);
    return;
  }
  if (arrived_) {
    context.controls.hand_buttons |= messages::kGrabButton;
    move_freely(scene, context.view.camera, true, context.controls);
    return;
  }
  if (!hit) return;
  constexpr double kGap_m = 0.001;
  const glm::dvec3 before_m = to_dvec3(context.controls.hand_world_m);
  hold_above(context, *hit, kGap_m);
  arrived_ = glm::distance(before_m, to_dvec3(context.controls.hand_world_m)) < 0.1 * kArrived_m;
}

void Pointer::draw_spring_out(PanelContext& context, const Area& scene) const {
  if (camera_press_) return;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return move_freely(scene, context.view.camera, true, context.controls);
  if (ImGui::GetIO().MouseWheel != 0.0f) zoom_to_pointer(scene, context.view.camera);
}

void Pointer::update(PanelContext& context, const Area& scene, const std::vector<bool>& superficial) {
  const ImGuiIO& io = ImGui::GetIO();
  hovered_ = {};
  context.controls.hand_moves = io.KeyCtrl || mode_ != PointerMode::Look;
  if (camera_press_) {  // to its release, wherever that is
    drag_camera(context, scene);
    if (!io.MouseDown[camera_press_->button]) camera_press_.reset();
  }
  if (io.WantCaptureMouse || scene.empty()) return let_go(context);
  begin_camera_drag();
  if (io.KeyCtrl) {
    if (camera_press_) return;
    above_world_m_.reset();  // the hand is where the person puts it
    move_freely(scene, context.view.camera, true, context.controls);
    return;
  }
  if (mode_ != PointerMode::Look && !context.frame.springs_world_m.empty()) return draw_spring_out(context, scene);
  const std::optional<PickHit> hit = look_through(context, scene, superficial);
  if (hit) hovered_ = hit->part;
  if (hovered_ && mode_ == PointerMode::Look) {
    ImGui::SetTooltip("%s", name_of(context.specimen, hovered_, context.view).c_str());
  }
  if (hovered_ && is_click(ImGuiMouseButton_Right)) context.asks.menu_of = hovered_;
  if (camera_press_ && mode_ != PointerMode::Look) return;  // the hand rests meanwhile
  switch (mode_) {
    case PointerMode::Look:
      let_go(context);
      return look(context, scene);
    case PointerMode::Touch:
      return touch(context, hit);
    case PointerMode::Pull:
      return pull(context, scene, hit);
  }
}

}  // namespace myotact::view
