#pragma once

namespace myotact::simulation {

/// How a rate follows from the last values: dy/dt = rate y - now y_n + before y_(n-1). All zero: a static problem.
struct TimeRule {
  double rate_1_s = 0.0;    // of the new value
  double now_1_s = 0.0;     // of the last value y_n
  double before_1_s = 0.0;  // of the value before it, y_(n-1)

  bool operator==(const TimeRule&) const = default;

  /// now y_n - before y_(n-1): what is taken from rate y. Value: a number or vector.
  template <class Value>
  Value history(const Value& last, const Value& before_last) const {
    return now_1_s * last - before_1_s * before_last;
  }
};

/// First order; needs one past value.
inline TimeRule backward_euler(double dt_s) {
  return {1.0 / dt_s, 1.0 / dt_s, 0.0};
}
/// Second order (BDF2); the two past values must be dt_s apart.
inline TimeRule second_order(double dt_s) {
  return {1.5 / dt_s, 2.0 / dt_s, 0.5 / dt_s};
}

}  // namespace myotact::simulation
