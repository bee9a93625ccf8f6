#pragma once

namespace myotact::haptics {

/// Keeps the mean square of the force within what the device's motors withstand continuously. Heat follows the square
/// of the current with one time constant; the limit falls smoothly before the rating is reached:
///
///   heat = mean of (|F| / continuous)^2, forgetting over 20 s
///
///   limit  peak ----------.
///                          '--.__              at heat 1 it is the continuous force: heat can never pass 1
///          continuous            '---
///                 0      0.7     1  heat
///
/// Real-time safe; one thread.
class MotorHeat {
 public:
  /// `continuous_N` > 0. The limit is never above `most_N`.
  MotorHeat(double continuous_N, double most_N);

  /// `force_N` >= 0 acted for `elapsed_s` >= 0.
  void book(double force_N, double elapsed_s) noexcept;
  double heat() const noexcept { return heat_; }  // 1: as hot as the continuous force makes it
  double limit_N() const noexcept;
  bool cuts() const noexcept { return limit_N() < most_N_; }

 private:
  double continuous_N_;
  double most_N_;
  double heat_ = 0.0;
};

}  // namespace myotact::haptics
