#pragma once

#include <vector>

#include "view/panels/panel.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// The first minute of somebody who has never been here: one sentence over the limb and one glowing place at a time;
/// the next comes when it is done. He presses on a muscle, contracts opposing muscles together, and presses again.
class FirstSteps {
 public:
  /// `scene`: where the limb is drawn; `superficial`: as for seen_parts(). True when all is done, or he wants no more.
  bool draw(PanelContext& context, const Area& scene, const std::vector<bool>& superficial);
  /// In another scene nothing is contracted yet, and the mouse looks.
  void enter_another_scene();

 private:
  enum class Step { Press, Contract, PressAgain, Learn };

  void go_on(const PanelContext& context);
  bool stands_stiffer(const PanelContext& context) const;
  void glow_on_muscle(const PanelContext& context, const Area& scene, const std::vector<bool>& superficial);

  Step step_ = Step::Press;
  bool began_ = false;
  bool settles_ = false;       // it is contracted, and not yet what the sentence says
  double angle_rad_ = 0.0;     // of the joint, before it was contracted
  double K_Nm_rad_ = 0.0;      // and its stiffness
  bool was_let_go_ = false;    // since the step began
  double looked_s_ = -1.0;     // when the place below was found, by ImGui's clock
  float x_ = 0.5f, y_ = 0.5f;  // of the muscle that is seen most, as shares of the scene's area
};

}  // namespace myotact::view
