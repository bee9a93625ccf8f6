#include "view/pointer.h"

#include <cmath>
#include <cstddef>

#include <imgui.h>

namespace myotact::view {

namespace {

constexpr float kDepthStep_m = 0.005f;  // of the hand, a click of the wheel
constexpr float kTurn_rad = 0.008f;     // of the camera, a pixel
constexpr float kCloser = 0.9f;         // of the camera's distance, a click of the wheel

void move_hand(const Area& scene, const Camera& camera, ViewControls& controls) {
  const ImGuiIO& io = ImGui::GetIO();
  const float metres_a_pixel = 2.0f * camera.distance_m * std::tan(0.5f * Camera::kFieldOfView_rad) / scene.height;
  const glm::vec3 step =
      metres_a_pixel * (io.MouseDelta.x * camera.right_world() - io.MouseDelta.y * camera.up_world()) +
      kDepthStep_m * io.MouseWheel * camera.forward_world();
  for (int k = 0; k < 3; ++k) controls.hand_world_m[static_cast<std::size_t>(k)] += static_cast<double>(step[k]);
}

}  // namespace

void move_by_pointer(const Area& scene, ViewState& view, ViewControls& controls) {
  const ImGuiIO& io = ImGui::GetIO();
  controls.hand_moves = io.KeyCtrl;
  if (io.WantCaptureMouse || scene.empty()) return;
  if (io.KeyCtrl) {
    move_hand(scene, view.camera, controls);
    return;
  }
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f)) {
    view.camera.orbit(-kTurn_rad * io.MouseDelta.x, kTurn_rad * io.MouseDelta.y);
  }
  if (ImGui::IsMouseDragging(ImGuiMouseButton_Right, 0.0f)) {
    view.camera.pan(io.MouseDelta.x / scene.height, -io.MouseDelta.y / scene.height);
  }
  if (io.MouseWheel != 0.0f) view.camera.zoom(std::pow(kCloser, io.MouseWheel));
}

}  // namespace myotact::view
