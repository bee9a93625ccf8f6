#include <algorithm>
#include <cmath>

#include "scene/conductor.h"

// Going on from a moment of the past.

namespace myotact::scene {

/// What was in force is in force at once, without a glide: the step begins with the activations that it led to. The
/// posture is held from the step after on, when its joint stands there.
void Conductor::obey(const messages::GoOn& go, const When& when) {
  const messages::Moment& from = go.from;
  const bool fits = from.joints == scene_->specimen.joints.size() && from.muscles == scene_->specimen.muscles.size() &&
                    from.joints <= from.angles_rad.size() && from.muscles <= from.activations.size();
  if (!fits || !std::all_of(from.angles_rad.begin(), from.angles_rad.begin() + from.joints,
                            [](double q) { return std::isfinite(q); })) {
    return;  // of another scene
  }
  const When now{when.by, when.start_s, when.start_s};
  const messages::ControlState& control = from.control;
  if (control.drive == messages::Drive::Script) obey(messages::FollowScript{}, now);
  if (control.drive == messages::Drive::Levels && scene_->co_contraction) {
    balance_by({control.common, control.difference}, now);  // which a person finds again as it was left
    obey(messages::SetLevels{control.flexors, control.extensors}, now);
  }
  if (control.drive == messages::Drive::Balance && scene_->co_contraction) {
    drive_ = messages::Drive::Balance;
    driver_ = when.by;
    balance_by({control.common, control.difference}, now);
  }
  obey(messages::SetGravity{control.gravity}, now);
  obey(messages::HoldPosture{false}, now);
  holds_from_there_ = control.hold_posture;
  shoves_.clear();
  shove_test_ = ShoveTest(scene_->settings.dt_s);
  from_.emplace();
  from_->angles_rad.assign(from.angles_rad.begin(), from.angles_rad.begin() + from.joints);
  from_->activations.assign(from.activations.begin(), from.activations.begin() + from.muscles);
}

}  // namespace myotact::scene
