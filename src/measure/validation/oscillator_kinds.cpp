#include "measure/validation/oscillator_kinds.h"

#include <cmath>
#include <complex>
#include <numbers>

#include "measure/validation/step_count.h"
#include "simulation/time_rule.h"

namespace myotact::measure {
namespace {

/// Position and velocity over angular frequency in one number: y = x - i v / omega obeys dy/dt = i omega y, and a
/// linear rule does to y what it does to both parts.
using Phasor = std::complex<double>;

class Oscillator {
 public:
  Oscillator(std::string rule, double omega_rad_s, double dt_s)
      : rule_(std::move(rule)), i_omega_(0.0, omega_rad_s), dt_s_(dt_s) {}

  /// The second-order rule starts with one step of backward Euler, as the simulation does.
  void step() {
    const Phasor last = now_;
    if (rule_ == "trapezoid") {  // the simulation has no such rule; it is here as the measure of the others
      now_ = last * (1.0 + 0.5 * dt_s_ * i_omega_) / (1.0 - 0.5 * dt_s_ * i_omega_);
    } else {
      const bool second = rule_ == "second_order" && steps_ > 0;
      const simulation::TimeRule rule = second ? simulation::second_order(dt_s_) : simulation::backward_euler(dt_s_);
      now_ = rule.history(last, before_) / (rule.rate_1_s - i_omega_);
    }
    before_ = last;
    ++steps_;
  }
  Phasor now() const { return now_; }

 private:
  std::string rule_;
  Phasor i_omega_;
  double dt_s_;
  Phasor now_{1.0, 0.0}, before_{1.0, 0.0};
  int steps_ = 0;
};

std::string read_rule(JsonObject& inputs) {
  return inputs.at("rule").one_of({"backward_euler", "second_order", "trapezoid"});
}

double read_omega_rad_s(JsonObject& inputs) {
  return 2.0 * std::numbers::pi * inputs.at("frequency_hz").number_between(1e-3, 1e3);
}

double error_at(int steps, Oscillator oscillator, double angle_rad) {
  for (int i = 0; i < steps; ++i) oscillator.step();
  return std::abs(oscillator.now() - std::polar(1.0, angle_rad));
}

}  // namespace

Quantities oscillator(JsonObject& inputs) {
  constexpr int kSettling = 100;  // steps until the second-order rule's other root, a third a step, has died
  constexpr int kMeasured = 100;
  const std::string rule = read_rule(inputs);
  const double omega_rad_s = read_omega_rad_s(inputs);
  const double dt_s = inputs.at("dt_s").number_between(1e-6, 1.0 / omega_rad_s);
  Oscillator oscillator(rule, omega_rad_s, dt_s);
  for (int i = 0; i < kSettling; ++i) oscillator.step();
  const double before = std::abs(oscillator.now());
  double turned_rad = 0.0;
  for (int i = 0; i < kMeasured; ++i) {
    const Phasor last = oscillator.now();
    oscillator.step();
    turned_rad += std::arg(oscillator.now() / last);
  }
  const double steps_per_period = 2.0 * std::numbers::pi / (omega_rad_s * dt_s);
  return {{"amplitude_kept_per_period", std::pow(std::abs(oscillator.now()) / before, steps_per_period / kMeasured)},
          {"frequency_ratio", turned_rad / (kMeasured * omega_rad_s * dt_s)}};
}

Quantities oscillator_order(JsonObject& inputs) {
  const std::string rule = read_rule(inputs);
  const double omega_rad_s = read_omega_rad_s(inputs);
  const double dt_s = inputs.at("dt_s").number_between(1e-6, 1.0 / omega_rad_s);
  const JsonValue end = inputs.at("end_s");
  const int steps = step_count(end, dt_s);
  const int halvings = inputs.at("halvings").integer_between(1, 6);
  const int parts = 1 << halvings;
  const double angle_rad = omega_rad_s * end.number();
  const double first = error_at(steps, {rule, omega_rad_s, dt_s}, angle_rad);
  const double last = error_at(steps * parts, {rule, omega_rad_s, dt_s / parts}, angle_rad);
  return {{"order", std::log2(first / last) / halvings}, {"error", last}};
}

}  // namespace myotact::measure
