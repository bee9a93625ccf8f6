#pragma once

#include <vector>

#include <Eigen/Core>

namespace myotact::simulation {

/// Where repeated steps lead that each approach a place only at a constant rate, or swing round it: the combination of
/// the last steps whose own step would be shortest (Anderson 1965, "Iterative procedures for nonlinear integral
/// equations"). Exact after n + 1 steps of a linear map that has n different factors. One caller.
class Extrapolation {
 public:
  /// `from`, `to`: where the last step began and ended, always of one size. Returns where to begin the next one:
  /// `to` itself for the first. Remembers six steps.
  Eigen::VectorXd next(const Eigen::VectorXd& from, const Eigen::VectorXd& to);
  /// Begins anew, after a jump.
  void forget();

 private:
  std::vector<Eigen::VectorXd> ends_, steps_;
};

}  // namespace myotact::simulation
