#pragma once

#include <optional>

#include "view/panels/panel.h"
#include "view/panels/stiffness_gauge.h"

namespace myotact::view {

/// The co-contraction bench: the commands of the muscles, and how stiff the joint is for it, and why.
class DemonstratePanel {
 public:
  void draw(PanelContext& context);
  /// Every picture, drawn or not.
  void observe(const PanelContext& context);
  /// B where A is in force, else A. False, and nothing is done, where that one has not been kept.
  bool feel_other(SceneControls& scene);
  const KeptStates& kept() const { return stored_; }
  /// In place of those that are kept.
  void keep(const KeptStates& states) { stored_ = states; }

 private:
  StiffnessGauge gauge_;
  KeptStates stored_;
  std::optional<double> shove_began_s_;  // simulated time, while a shove test runs
};

}  // namespace myotact::view
