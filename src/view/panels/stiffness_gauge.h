#pragma once

#include <deque>

#include "view/panels/panel.h"

namespace myotact::view {

/// Torques of a joint's muscles by where they turn it, both as they are signed: positive flexes.
struct OpposingTorques {
  double flexing_Nm = 0.0, extending_Nm = 0.0;
};
OpposingTorques opposing_torques(const messages::JointFrame& joint);

/// The end of a scale that is easy to read, 1, 2 or 5 with zeros, at or above `largest`; at least 1.
double scale_end(double largest);

/// A joint's stiffness as an instrument: a number to be read from the last row, where it came from in the last 20 s
/// with the band that the anatomy leaves open, and beneath it how muscles pull against each other and what is left
/// over.
class StiffnessGauge {
 public:
  /// Every picture, whether it is drawn or not.
  void note(double time_s, double K_Nm_rad);
  /// Nothing before the first note().
  void draw(const messages::JointFrame& joint, const JointReadings& readings);

  struct Sample {
    double time_s, K_Nm_rad;
  };
  /// Of the last 20 s, by simulated time.
  const std::deque<Sample>& history() const { return history_; }

 private:
  void draw_history(const JointReadings& readings);

  std::deque<Sample> history_;
};

}  // namespace myotact::view
