#include "simulation/limb/extrapolation.h"

#include "core/dense_matrix.h"

namespace myotact::simulation {
namespace {

/// Steps whose differences are combined. More gain nothing: contact's faces have changed by then.
constexpr std::size_t kRemembered = 6;

}  // namespace

Eigen::VectorXd Extrapolation::next(const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
  if (steps_.size() == kRemembered) {
    ends_.erase(ends_.begin());
    steps_.erase(steps_.begin());
  }
  ends_.push_back(to);
  steps_.push_back(to - from);
  const std::size_t count = steps_.size() - 1;
  if (count == 0) return to;
  Eigen::MatrixXd step_changes(to.size(), count), end_changes(to.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    step_changes.col(static_cast<Eigen::Index>(k)) = steps_[k + 1] - steps_[k];
    end_changes.col(static_cast<Eigen::Index>(k)) = ends_[k + 1] - ends_[k];
  }
  const Eigen::VectorXd shares = least_squares(step_changes, steps_.back());
  return shares.allFinite() ? Eigen::VectorXd(to - end_changes * shares) : to;
}

void Extrapolation::forget() {
  ends_.clear();
  steps_.clear();
}

}  // namespace myotact::simulation
