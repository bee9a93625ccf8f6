#include "simulation/line/line_tissue.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::simulation {
namespace {

/// A shorter tendon is left out [m]: the fibres reach from bone to bone.
constexpr double kShortestTendon_m = 1e-4;

}  // namespace

LineTissue make_line_tissue(const anatomy::Muscle& muscle, const anatomy::MuscleLine& line, const Skeleton& skeleton,
                            Tendon tendon) {
  LineTissue tissue;
  tissue.line = line;
  tissue.hill = {muscle.peak_force_N, muscle.optimal_fibre_m, muscle.pennation_rad, 0.0, tendon};
  LineGeometry geometry;
  measure_line(line, skeleton, geometry);
  tissue.length_m = geometry.length_m;
  tissue.hill.tendon_slack_m = tendon_slack_for_m(tissue.hill, geometry.length_m, muscle.rest_stretch);
  if (!(tissue.hill.tendon_slack_m > -kShortestTendon_m)) {
    throw bad_data(
        "specimen", "muscle " + muscle.key,
        fmt::format("fibres of rest_stretch {} x optimal_fibre_m {} at a pennation of {} rad leave {} m of "
                    "its line ({} m) for the tendon; must be at least 0: shorten the fibres or lower the pennation",
                    to_text(muscle.rest_stretch), to_text(muscle.optimal_fibre_m), to_text(muscle.pennation_rad),
                    to_text(tissue.hill.tendon_slack_m), to_text(geometry.length_m)));
  }
  if (tissue.hill.tendon_slack_m < kShortestTendon_m) {
    tissue.hill.tendon_slack_m = std::max(0.0, tissue.hill.tendon_slack_m);
    tissue.hill.tendon = Tendon::Rigid;
  }
  bring_to_rest(0.0, tissue);
  return tissue;
}

LineLoad evaluate_line_tissue(const Skeleton& skeleton, const TimeRule& rule, double activation, LineTissue& tissue) {
  LineGeometry geometry;
  measure_line(tissue.line, skeleton, geometry);
  tissue.length_m = geometry.length_m;
  tissue.force =
      hill_step(tissue.hill, {geometry.length_m, activation, rule, tissue.fibre_last_m, tissue.fibre_before_m});
  tissue.fibre_now_m = tissue.force.fibre_m;
  return {tissue.force.force_N * geometry.slope_m_rad,
          tissue.force.stiffness_N_m * geometry.slope_m_rad * geometry.slope_m_rad.transpose() +
              tissue.force.force_N * geometry.curvature_m_rad2};
}

LineForce resting_force(const LineTissue& tissue, double activation) {
  const HillForce force = hill_equilibrium(tissue.hill, tissue.length_m, activation);
  return {force.fibre_m / tissue.hill.optimal_fibre_m, force.force_N, force.stiffness_N_m, force.fibre_damping_Ns_m};
}

void push_history(LineTissue& tissue) {
  tissue.fibre_before_m = tissue.fibre_last_m;
  tissue.fibre_last_m = tissue.fibre_now_m;
}

void restore_last(LineTissue& tissue) {
  tissue.fibre_now_m = tissue.fibre_last_m;
}

void bring_to_rest(double activation, LineTissue& tissue) {
  tissue.force = hill_equilibrium(tissue.hill, tissue.length_m, activation);
  tissue.fibre_now_m = tissue.fibre_last_m = tissue.fibre_before_m = tissue.force.fibre_m;
}

}  // namespace myotact::simulation
