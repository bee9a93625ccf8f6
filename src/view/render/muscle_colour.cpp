#include "view/render/muscle_colour.h"

#include <algorithm>
#include <cmath>

#include "view/charts/colour_map.h"

namespace myotact::view {

namespace {

// Okabe and Ito's blue and vermillion, lightened as far as muscle needs to show its shape.
constexpr glm::vec3 kFlexor{0.25f, 0.53f, 0.78f}, kExtensor{0.89f, 0.50f, 0.22f};
constexpr float kFlexorStripe_m = 0.010f;
/// Of a tint that says what a muscle is or has: enough that its colour is the legend's.
constexpr float kTintShare = 0.85f;
/// Below this share of its range a muscle counts as idle: noise of excitation, no person's doing.
constexpr double kIdleShare = 0.01;
/// Stripes at full level; half the level has half as many. Five steps, or they would swim as the level moves.
constexpr float kDensestStripe_m = 0.005f;
constexpr int kStripeSteps = 5;
constexpr double kStretchRange = 0.4;      // about the optimal length: where a fibre loses half of its force
constexpr double kVolumeRange = 0.05;      // of volume: five times what the solver is held to
constexpr std::size_t kScaleColours = 16;  // of a legend

float stripe_of(double level) {
  const double step = std::round(std::clamp(level, 0.0, 1.0) * kStripeSteps);
  return step < 1.0 ? 0.0f : kDensestStripe_m * static_cast<float>(kStripeSteps / step);
}

MuscleTint tint_of_level(double level) {
  if (level < kIdleShare) return {kIdleMuscle, 0.0f};
  // The first few percent come out of the muscle's own look, so that nothing flickers at the border.
  const auto share = static_cast<float>(std::min((level - kIdleShare) / 0.04, 1.0));
  return {red_yellow(level), stripe_of(level), kTintShare * share};
}

/// `level`: -1 .. 1. Stripes mark the positive side.
MuscleTint tint_of_signed_level(double level) {
  return {blue_orange(level), level > 0.0 ? stripe_of(level) : 0.0f, kTintShare};
}

double value_at(const std::vector<double>& values, std::size_t i, double otherwise) {
  return i < values.size() ? values[i] : otherwise;
}

/// Round above the largest peak force, so that the scale is the specimen's and stays.
double tension_range_N(const anatomy::Specimen& specimen) {
  double largest_N = 1.0;
  for (const auto& muscle : specimen.muscles) largest_N = std::max(largest_N, muscle.peak_force_N);
  const double decade = std::pow(10.0, std::floor(std::log10(largest_N)));
  return decade * std::ceil(2.0 * largest_N / decade) / 2.0;
}

bool holds(const std::vector<int>& muscles, std::size_t m) {
  return std::find(muscles.begin(), muscles.end(), static_cast<int>(m)) != muscles.end();
}

/// Of the watched joint if it has a group, else of the first that names the muscle.
MuscleTint tint_of_kind(const anatomy::Specimen& specimen, std::size_t m, int joint) {
  std::vector<const anatomy::MuscleGroup*> groups;
  for (const auto& group : specimen.groups) groups.push_back(&group);
  std::stable_partition(groups.begin(), groups.end(), [&](const auto* group) { return group->joint == joint; });
  for (const auto* group : groups) {
    if (holds(group->flexors, m)) return {kFlexor, kFlexorStripe_m, kTintShare};
    if (holds(group->extensors, m)) return {kExtensor, 0.0f, kTintShare};
  }
  return {kIdleMuscle, 0.0f};
}

/// Signed part of what all muscles together add or take away.
double stiffness_share(const messages::SceneFrame& frame, std::size_t m, int joint) {
  const auto j = static_cast<std::size_t>(joint);
  if (joint < 0 || j >= frame.joints.size() || m >= frame.joints[j].muscles.size()) return 0.0;
  double sum = 0.0;
  for (const auto& muscle : frame.joints[j].muscles) sum += std::abs(muscle.stiffness_Nm_rad);
  return sum > 0.0 ? frame.joints[j].muscles[m].stiffness_Nm_rad / sum : 0.0;
}

}  // namespace

std::vector<MuscleTint> tint_muscles(const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                                     MuscleColour colour, int joint) {
  const auto tint = [&](std::size_t m) -> MuscleTint {
    switch (colour) {
      case MuscleColour::Kind:
        return tint_of_kind(specimen, m, joint);
      case MuscleColour::Activation:
        return tint_of_level(value_at(frame.activations, m, 0.0));
      case MuscleColour::Tension:
        return tint_of_level(value_at(frame.tensions_N, m, 0.0) / tension_range_N(specimen));
      case MuscleColour::Stretch:
        if (m >= frame.stretches.size()) break;  // not known: no colour of the scale
        return tint_of_signed_level((frame.stretches[m] - 1.0) / kStretchRange);
      case MuscleColour::VolumeError:
        return tint_of_signed_level((value_at(frame.volume_ratios, m, 1.0) - 1.0) / kVolumeRange);
      case MuscleColour::StiffnessShare:
        return tint_of_signed_level(stiffness_share(frame, m, joint));
      case MuscleColour::Pressure:
        break;
    }
    return {kIdleMuscle, 0.0f};
  };
  std::vector<MuscleTint> tints;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) tints.push_back(tint(m));
  return tints;
}

namespace {

Legend legend_of_colour(const anatomy::Specimen& specimen, MuscleColour colour) {
  const auto levels = [](const char* title, const char* unit, double highest) {
    Legend legend{title, unit, 0.0, highest, {}, {{"see.idle", {kIdleMuscle, 0.0f}}}};
    for (std::size_t i = 0; i < kScaleColours; ++i) legend.scale.push_back(red_yellow(double(i) / (kScaleColours - 1)));
    return legend;
  };
  const auto signed_levels = [](const char* title, const char* unit, double lowest, double highest) {
    Legend legend{title, unit, lowest, highest, {}, {}};
    for (std::size_t i = 0; i < kScaleColours; ++i) {
      legend.scale.push_back(blue_orange(2.0 * double(i) / (kScaleColours - 1) - 1.0));
    }
    return legend;
  };
  switch (colour) {
    case MuscleColour::Kind:
      return {"see.kind",
              "",
              0.0,
              0.0,
              {},
              {{"see.flexor", {kFlexor, kFlexorStripe_m}},
               {"see.extensor", {kExtensor, 0.0f}},
               {"see.other", {kIdleMuscle, 0.0f}}}};
    case MuscleColour::Activation:
      return levels("see.activation", "see.percent", 100.0);
    case MuscleColour::Tension:
      return levels("see.tension", "see.newton", tension_range_N(specimen));
    case MuscleColour::Stretch:
      return signed_levels("see.stretch", "", 1.0 - kStretchRange, 1.0 + kStretchRange);
    case MuscleColour::VolumeError:
      return signed_levels("see.volume_error", "see.percent", -100.0 * kVolumeRange, 100.0 * kVolumeRange);
    case MuscleColour::StiffnessShare:
      return signed_levels("see.stiffness_share", "see.percent", -100.0, 100.0);
    case MuscleColour::Pressure:
      return levels("see.pressure", "see.kilopascal", 1e-3 * double(kPressureRange_Pa));
  }
  return {};
}

}  // namespace

Legend legend_of(const anatomy::Specimen& specimen, const ViewState& view) {
  Legend legend = legend_of_colour(specimen, view.colour);
  if (view.attachments) {
    legend.entries.push_back({"see.origin", {kOriginColour, 0.0f}});
    legend.entries.push_back({"see.insertion", {kInsertionColour, 0.0f}});
  }
  return legend;
}

}  // namespace myotact::view
