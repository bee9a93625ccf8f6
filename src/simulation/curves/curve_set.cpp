#include "simulation/curves/curve_set.h"

#include <algorithm>
#include <array>

#include "simulation/curves/blemker.h"
#include "simulation/curves/degroote_fregly.h"
#include "simulation/curves/fibre_curves.h"
#include "simulation/curves/millard.h"
#include "simulation/curves/thelen.h"

namespace myotact::simulation {
namespace {

constexpr VelocityCurve kDeGrooteVelocity = {[](double v, double) noexcept { return force_velocity(v); },
                                             [](double v, double) noexcept { return force_velocity_slope(v); },
                                             [](double force, double) noexcept { return velocity_at_force(force); }};

constexpr VelocityCurve kMillardVelocity = {
    [](double v, double) noexcept { return millard::force_velocity(v); },
    [](double v, double) noexcept { return millard::force_velocity_slope(v); },
    [](double force, double) noexcept { return millard::velocity_at_force(force); }};

constexpr Curve kDeGrooteTendon = {tendon_force, tendon_force_slope};

constexpr std::array<ForceCurves, 4> kSets = {{
    {{active_force_length, active_force_length_slope},
     {degroote_fregly::passive_force_length, degroote_fregly::passive_force_length_slope},
     kDeGrooteTendon,
     kDeGrooteVelocity},
    {{thelen::active_force_length, thelen::active_force_length_slope},
     {thelen::passive_force_length, thelen::passive_force_length_slope},
     {thelen::tendon_force, thelen::tendon_force_slope},
     {thelen::force_velocity, thelen::force_velocity_slope, thelen::velocity_at_force}},
    {{millard::active_force_length, millard::active_force_length_slope},
     {millard::passive_force_length, millard::passive_force_length_slope},
     {millard::tendon_force, millard::tendon_force_slope},
     kMillardVelocity},
    {{blemker::active_force_length, blemker::active_force_length_slope},
     {blemker::passive_force_length, blemker::passive_force_length_slope},
     kDeGrooteTendon,
     kDeGrooteVelocity},
}};

}  // namespace

const ForceCurves& force_curves(CurveSet set) noexcept {
  return kSets[static_cast<std::size_t>(set)];
}

const std::vector<std::string>& curve_set_names() {
  static const std::vector<std::string> names = {"degroote_fregly_2016", "thelen_2003", "millard_2012", "blemker_2005"};
  return names;
}

std::optional<CurveSet> find_curve_set(std::string_view name) {
  const auto& names = curve_set_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<CurveSet>(found - names.begin());
}

}  // namespace myotact::simulation
