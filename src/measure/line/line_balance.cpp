#include <cmath>
#include <utility>

#include "measure/line/line_joint.h"

namespace myotact::measure {
namespace {

/// Both sides at one angle, distinguished by strength instead of direction.
class Antagonists {
 public:
  Antagonists(const LineJoint& joint, double q_rad) : joint_(joint), q_rad_(q_rad) {
    const LineJointState full = line_joint_state(joint, q_rad, {1.0, 1.0});
    flexors_weaker_ = full.flexors.torque_Nm < -full.extensors.torque_Nm;
  }

  SideLevels levels(double weaker, double stronger) const {
    return flexors_weaker_ ? SideLevels{weaker, stronger} : SideLevels{stronger, weaker};
  }
  /// By how much the stronger side wins.
  double lead_Nm(double weaker, double stronger) const {
    const double flexing_Nm = line_joint_state(joint_, q_rad_, levels(weaker, stronger)).all().torque_Nm;
    return flexors_weaker_ ? -flexing_Nm : flexing_Nm;
  }

 private:
  const LineJoint& joint_;
  double q_rad_;
  bool flexors_weaker_ = true;
};

/// Where a function that is negative at `low` and not at `high` changes its sign: of two neighbours, or places closer
/// than any activation matters, the one where it is smaller.
template <class Function>
double zero_between(double low, double high, const Function& f) {
  constexpr double kClosest = 1e-18;  // of 10 kN on a moment arm of 0.1 m: 1e-15 N m
  double f_low = f(low), f_high = f(high);
  while (high - low > kClosest) {
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) break;
    const double f_middle = f(middle);
    (f_middle < 0.0 ? low : high) = middle;
    (f_middle < 0.0 ? f_low : f_high) = f_middle;
  }
  return std::abs(f_low) < std::abs(f_high) ? low : high;
}

}  // namespace

LineBalance balance_sides(const LineJoint& joint, double q_rad, double level) {
  const Antagonists pair(joint, q_rad);
  if (pair.lead_Nm(level, 0.0) > 0.0) {  // its passive pull alone is too much
    if (pair.lead_Nm(1.0, 0.0) > 0.0) return {pair.levels(1.0, 0.0), false};
    const double raised = zero_between(level, 1.0, [&](double weaker) { return -pair.lead_Nm(weaker, 0.0); });
    return {pair.levels(raised, 0.0), true};
  }
  if (pair.lead_Nm(level, 1.0) < 0.0) return {pair.levels(level, 1.0), false};
  const double met = zero_between(0.0, 1.0, [&](double stronger) { return pair.lead_Nm(level, stronger); });
  return {pair.levels(level, met), true};
}

}  // namespace myotact::measure
