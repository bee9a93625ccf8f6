#include "simulation/muscle/fibre_field.h"

#include <algorithm>

#include "simulation/curves/fibre_curves.h"

namespace myotact::simulation {
namespace {

double point_weight_Nm(const TissueElement& element) {
  return element.point_volume_m3() * element.peak_Pa;
}

/// Least slope of the line that stands for the force-velocity curve in a step, over the slope at no speed, about the
/// curve's steepest. The curve is flat where fibres move fast, and a line from there hardly damps: slack or jolted
/// fibres then swung to and fro for ever, two steps a swing, and kept whole muscles from the rest that they have. With
/// s the line's slope and F' the curve's, what a speed is off shrinks by |1 - F'/s| from step to step or faster, so
/// that more than half of the steepest F' is enough. Sudden starts are felt one step late; steady speeds are the
/// curve's.
constexpr double kLeastSlope = 0.6;

/// Force-velocity factor at a point and its slope against the stretch: a line through the curve at the last step's
/// speed, taken at the new speed, so that the damping of the fibres is implicit and one Newton step is enough.
struct SpeedFactor {
  double value = 1.0;
  double slope = 0.0;
};

SpeedFactor speed_factor(const FibreInputs& in, std::size_t point, double stretch) {
  if (!in.load.force_velocity || in.load.rule.rate_1_s == 0.0) return {};
  const double to_speed = in.tissue.fibre_map.gain / kLargestShortening_lo_s;
  const double history = in.load.rule.history(in.state.last.stretch[point], in.state.before.stretch[point]);
  const double speed = to_speed * (in.load.rule.rate_1_s * stretch - history);
  // The line is laid within the range in which the curve was measured.
  const double known = std::clamp(to_speed * in.state.stretch_rate_1_s[point], -1.0, 1.0);
  const double slope = std::max(force_velocity_slope(known), kLeastSlope * force_velocity_slope(0.0));
  const double value = force_velocity(known) + slope * (speed - known);
  if (value <= 0.0) return {0.0, 0.0};  // a fibre never pushes
  return {value, slope * to_speed * in.load.rule.rate_1_s};
}

}  // namespace

double fibre_weight_Nm(const MuscleTissue& tissue) {
  double weight = 0.0;
  for (const TissueElement& element : tissue.elements)
    weight += static_cast<double>(element.points()) * point_weight_Nm(element);
  return weight;
}

double mean_fibre_length(const MuscleTissue& tissue, const std::vector<double>& stretches) {
  double sum = 0.0, weight = 0.0;
  std::size_t point = 0;
  for (const TissueElement& element : tissue.elements) {
    const double w = point_weight_Nm(element);
    for (std::size_t p = 0; p < element.points(); ++p) sum += w * tissue.fibre_map.length(stretches[point++]);
    weight += static_cast<double>(element.points()) * w;
  }
  return weight > 0.0 ? sum / weight : tissue.fibre_map.rest_stretch;
}

FibreStress fibre_stress(const FibreInputs& in, std::size_t t, std::size_t p) {
  const TissueElement& element = in.tissue.elements[t];
  if (element.peak_Pa == 0.0) return {};
  const FibreMap& map = in.tissue.fibre_map;
  const double a = in.state.activation, peak = map.scale * element.peak_Pa;
  const std::size_t point = t * element.points() + p;
  const double stretch = in.state.now.stretch[point];
  const double n = map.length(stretch), passive_n = map.passive_length(stretch);
  const SpeedFactor speed = speed_factor(in, point, stretch);
  const double active = in.shared_force + kEvenness * (n - in.mean_length) + in.damped_force * (speed.value - 1.0);
  return {
      peak * (a * active + passive_force_length(passive_n)),
      peak * ((a * kEvenness + passive_force_length_slope(passive_n)) * map.gain + a * in.damped_force * speed.slope)};
}

FibreInputs fibre_inputs(const MuscleTissue& tissue, const TissueState& state, const TissueLoad& load) {
  const double mean_length = mean_fibre_length(tissue, state.now.stretch);
  const double last_mean_length = mean_fibre_length(tissue, state.last.stretch);
  const FibreMap& map = tissue.fibre_map;
  return {tissue,
          state,
          load,
          mean_length,
          active_force_length(map.on_curve(mean_length)),
          active_force_length(map.on_curve(last_mean_length))};
}

double mean_tangent_Nm(const FibreInputs& in) {
  const FibreMap& map = in.tissue.fibre_map;
  const double slope =
      active_force_length_slope(map.on_curve(in.mean_length)) * map.on_curve_slope(in.mean_length) - kEvenness;
  return in.state.activation * map.scale * fibre_weight_Nm(in.tissue) / map.gain * slope;
}

}  // namespace myotact::simulation
