#pragma once

#include <optional>
#include <vector>

#include "view/input/mouse_preset.h"
#include "view/look/picking.h"
#include "view/panels/panel.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// The mouse over the scene. Always: the wheel comes nearer, a right click opens a part's menu, Ctrl and the mouse are
/// the hand, freely; the drags of the preset move the camera.
///
///   Look   a click selects, a double click isolates
///   Touch  the tool follows over the limb; the left button presses it in, the wheel how deep; a drag slides
///   Pull   the left button takes the muscle line under the tool, a drag pulls it
///
/// In a scene of springs, where nothing can be touched, a drag moves the tool in both.
///
/// Call between ImGui's NewFrame and Render, after the panels.
class Pointer {
 public:
  void update(PanelContext& context, const Area& scene, const std::vector<bool>& superficial);

  /// Instead of update(), while the scene that is shown cannot be touched: a tool in the tissue leaves it.
  void rest(PanelContext& context) { let_go(context); }

  PointerMode mode() const { return mode_; }
  void set_mode(PointerMode mode) { mode_ = mode; }
  const Part& hovered() const { return hovered_; }
  double depth_m() const { return depth_m_; }  // that a press aims at, below the surface
  MousePreset preset = MousePreset::ThreeButton;
  bool free_orbit = false;  // a drag rotates the limb any way; else from one standard view to the next

 private:
  std::optional<PickHit> look_through(const PanelContext& context, const Area& scene,
                                      const std::vector<bool>& superficial) const;
  void look(PanelContext& context, const Area& scene);
  void touch(PanelContext& context, const std::optional<PickHit>& hit);
  void pull(PanelContext& context, const Area& scene, const std::optional<PickHit>& hit);
  void draw_spring_out(PanelContext& context, const Area& scene) const;
  /// A drag that moves the camera, from its press to its release.
  struct CameraPress {
    int button = 0;
    CameraDrag drag = CameraDrag::Rotate;
  };
  void begin_camera_drag();
  void drag_camera(PanelContext& context, const Area& scene) const;
  void rotate(PanelContext& context, int button) const;
  void let_go(PanelContext& context);
  void hold_above(PanelContext& context, const PickHit& hit, double height_m);
  void move_towards(PanelContext& context, const glm::dvec3& target_m);

  PointerMode mode_ = PointerMode::Look;
  std::optional<CameraPress> camera_press_;
  Part hovered_;
  double depth_m_ = 0.002;
  double pressed_s_ = 0.0;                   // how long the left button has been down
  bool arrived_ = false;                     // Pull: the hand is at the line
  std::optional<glm::dvec3> above_world_m_;  // Touch: where the hand goes when it is let go elsewhere
};

}  // namespace myotact::view
