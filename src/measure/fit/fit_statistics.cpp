#include "measure/fit/fit_statistics.h"

#include <cmath>

#include <boost/math/distributions/students_t.hpp>

#include "core/at.h"
#include "core/dense_matrix.h"

namespace myotact::measure {

namespace {

/// A part of a blind direction below this is rounding.
constexpr double kPartOfDirection = 0.05;

/// The free parameters' normal matrix with all columns of the Jacobian scaled to length 1.
struct ScaledNormal {
  std::vector<int> free;
  Eigen::VectorXd length;  // of the columns
  SymmetricEigen eigen;
};

ScaledNormal scaled_normal(const LeastSquaresFit& fit) {
  ScaledNormal normal;
  for (std::size_t j = 0; j < fit.bound.size(); ++j) {
    if (fit.bound[j] == 0) normal.free.push_back(static_cast<int>(j));
  }
  const auto count = static_cast<Eigen::Index>(normal.free.size());
  if (count == 0) return normal;
  Eigen::MatrixXd columns(fit.jacobian.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) columns.col(k) = fit.jacobian.col(normal.free[static_cast<std::size_t>(k)]);
  normal.length = columns.colwise().norm();
  for (Eigen::Index k = 0; k < count; ++k) {
    if (normal.length[k] > 0.0) columns.col(k) /= normal.length[k];
  }
  normal.eigen = symmetric_eigen(columns.transpose() * columns);
  return normal;
}

FitBlindDirection blind_direction(const ScaledNormal& normal, Eigen::Index place) {
  FitBlindDirection direction;
  for (Eigen::Index k = 0; k < normal.length.size(); ++k) {
    const double part = normal.eigen.vectors(k, place);
    if (std::abs(part) < kPartOfDirection) continue;
    direction.parameters.push_back(normal.free[static_cast<std::size_t>(k)]);
    direction.change.push_back(normal.length[k] > 0.0 ? part / normal.length[k] : 1.0);
  }
  double largest = 0.0;
  for (const double change : direction.change) largest = std::max(largest, std::abs(change));
  const double sign = direction.change.front() < 0.0 ? -1.0 : 1.0;
  for (double& change : direction.change) change *= sign / largest;
  return direction;
}

}  // namespace

double student_t95(int degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), 0.975);
}

FitStatistics fit_statistics(const std::vector<BoundedParameter>& parameters, const LeastSquaresFit& fit,
                             double blind_share) {
  const auto count = static_cast<Eigen::Index>(parameters.size());
  FitStatistics statistics;
  statistics.of.resize(parameters.size());
  statistics.correlation = Eigen::MatrixXd::Zero(count, count);
  const ScaledNormal normal = scaled_normal(fit);
  const auto free = static_cast<Eigen::Index>(normal.free.size());
  statistics.spare_points = static_cast<int>(fit.residuals.size() - free);
  if (statistics.spare_points > 0) statistics.variance = fit.residuals.squaredNorm() / statistics.spare_points;
  if (free == 0) return statistics;
  std::vector<char> is_blind(parameters.size(), 0);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(free, free);
  const double largest = normal.eigen.values[free - 1];
  for (Eigen::Index i = 0; i < free; ++i) {
    const double value = normal.eigen.values[i];  // of the normal matrix: the singular value squared
    if (!(value > blind_share * blind_share * largest)) {
      statistics.blind.push_back(blind_direction(normal, i));
      for (const int j : statistics.blind.back().parameters) is_blind[at(j)] = 1;
    } else {
      inverse += normal.eigen.vectors.col(i) * normal.eigen.vectors.col(i).transpose() / value;
    }
  }
  const double t = statistics.spare_points > 0 ? student_t95(statistics.spare_points) : 0.0;
  for (Eigen::Index k = 0; k < free; ++k) {
    const auto j = at(normal.free[static_cast<std::size_t>(k)]);
    FitInterval& interval = statistics.of[j];
    for (Eigen::Index l = 0; l < free; ++l) {
      const auto i = at(normal.free[static_cast<std::size_t>(l)]);
      if (is_blind[i] || is_blind[j]) continue;
      statistics.correlation(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) =
          inverse(k, l) / std::sqrt(inverse(k, k) * inverse(l, l));
    }
    interval.known = statistics.spare_points > 0 && !is_blind[j];
    if (!interval.known) continue;
    interval.half_width = t * std::sqrt(statistics.variance * inverse(k, k)) / normal.length[k];
    const double value = fit.values[j];
    const bool by_factor = parameters[j].logarithmic();
    interval.low = by_factor ? value * std::exp(-interval.half_width) : value - interval.half_width;
    interval.high = by_factor ? value * std::exp(interval.half_width) : value + interval.half_width;
  }
  return statistics;
}

}  // namespace myotact::measure
