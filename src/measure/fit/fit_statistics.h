#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "measure/fit/least_squares_fit.h"

namespace myotact::measure {

/// What the data leave open of one parameter.
struct FitInterval {
  bool known = false;            // false: at a bound, told apart from others by nothing, or without spare points
  double low = 0.0, high = 0.0;  // 95 % confidence
  double half_width = 0.0;       // of the parameter, or of its logarithm
};

/// Parameters that only a combination of is known: the curves stay as they are while these change together.
struct FitBlindDirection {
  std::vector<int> parameters;
  std::vector<double> change;  // of each: of the parameter, or of its logarithm
};

struct FitStatistics {
  int spare_points = 0;         // degrees of freedom
  double variance = 0.0;        // of the weighted residuals
  std::vector<FitInterval> of;  // each parameter
  Eigen::MatrixXd correlation;  // p x p; zero in rows of what is not known
  std::vector<FitBlindDirection> blind;
};

/// Intervals from the Jacobian at the end of a fit, with the variance of its own residuals and Student's t: linear
/// theory, of logarithms for positive parameters. A parameter at a bound is held there. Directions whose singular value
/// is below `blind_share` of the largest, with all columns scaled to length 1, are blind.
FitStatistics fit_statistics(const std::vector<BoundedParameter>& parameters, const LeastSquaresFit& fit,
                             double blind_share);

/// t with P(|T| < t) = 0.95 for Student's distribution of that many degrees of freedom, >= 1.
double student_t95(int degrees);

}  // namespace myotact::measure
