#include "simulation/limb/settle_together.h"

#include <algorithm>
#include <cmath>

#include "simulation/limb/extrapolation.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/step.h"

namespace myotact::simulation {
namespace {

constexpr double kTimeGrowth = 4.0, kTimeCut = 0.25;
constexpr int kMostRounds = 400;
/// They start here: neighbours have seen each other at rest, one by one.
constexpr double kFirstRound_s = 0.02;
/// A node goes no farther before the faces are found anew: half of how far ahead they are watched, because its
/// neighbour may come towards it.
constexpr double kFarthest_m = 1e-3;
/// Shares below this come from faces that change under the nodes, which costs a step its second order (it then gains a
/// constant factor, or swings to and fro): the steps are extrapolated. Above, they are once so many steps have not
/// halved the share, and a step that made it grow ends half way.
constexpr double kFacesChange = 1e-2;
constexpr int kPatience = 12;
/// A share that grows by more than this means that the step was too long for the faces.
constexpr double kTooLong = 2.0;
/// Muscles rest when the faces that they rest on leave no more than this once they are found anew. A share below it
/// that is not halved any more stays where it is: so do the faces, then, for as many steps as a rest on them takes.
constexpr double kFacesShare = 1e-3;
constexpr int kHeldRounds = 40;
/// A node that flips between two faces has no rest on either. After so many rounds what such flips leave will do: a
/// quarter of what a step in motion leaves. So will, of a slack muscle that creeps on faces that are held, what they
/// may leave anyway.
constexpr int kRoundsBeforeFlips = 150;
constexpr double kFlipShare = 5e-3;

/// Where all nodes are, muscle by muscle.
Eigen::VectorXd node_places(const Limb& limb) {
  std::vector<double> all_m;
  for (const LimbMuscle& muscle : limb.muscles) {
    const Eigen::VectorXd& position_m = muscle.state.now.position_m;
    if (!muscle.rigid) all_m.insert(all_m.end(), position_m.begin(), position_m.end());
  }
  return Eigen::Map<const Eigen::VectorXd>(all_m.data(), static_cast<Eigen::Index>(all_m.size()));
}

void put_nodes(const Eigen::VectorXd& all_m, Limb& limb) {
  Eigen::Index row = 0;
  for (LimbMuscle& muscle : limb.muscles) {
    if (muscle.rigid) continue;
    Eigen::VectorXd& position_m = muscle.state.now.position_m;
    position_m = all_m.segment(row, position_m.size());
    row += position_m.size();
  }
}

/// Largest out-of-balance share of a muscle as they lie now.
double largest_share(Limb& limb, WorkerPool& workers) {
  const TissueLoad load = static_load(limb.gravity_m_s2);
  workers.run(static_cast<int>(limb.muscles.size()), [&](int m) {
    LimbMuscle& muscle = limb.muscles[static_cast<std::size_t>(m)];
    if (!muscle.rigid) compute_forces(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  });
  double share = 0.0;
  for (const LimbMuscle& muscle : limb.muscles) {
    if (!muscle.rigid) share = std::max(share, rest_share(muscle));
  }
  return share;
}

/// The faces under the nodes at a place: as they were, or found anew.
enum class Faces { Held, Found };

double share_on(Faces faces, Limb& limb, WorkerPool& workers) {
  if (faces == Faces::Found)
    find_touches(limb, workers);
  else
    see_neighbours(limb);
  return largest_share(limb, workers);
}

/// Goes on to where the last steps lead, unless that is worse than where the last one ended. Returns the share there.
double extrapolate(Limb& limb, Faces faces, const Eigen::VectorXd& start_m, double share, Extrapolation& extrapolation,
                   WorkerPool& workers) {
  const Eigen::VectorXd end_m = node_places(limb);
  put_nodes(extrapolation.next(start_m, end_m), limb);
  const double there = share_on(faces, limb, workers);
  if (there < kTooLong * share) return there;
  extrapolation.forget();
  put_nodes(end_m, limb);
  return share_on(faces, limb, workers);
}

/// Half way back to where the last step began: where steps swing round a place, that is nearer to it. Returns the share
/// there.
double go_half_back(const Eigen::VectorXd& start_m, Limb& limb, WorkerPool& workers) {
  put_nodes(0.5 * (start_m + node_places(limb)), limb);
  return share_on(Faces::Found, limb, workers);
}

/// For the step after one that was too long for the faces.
double cautious_time_s(double time_s, double last_time_s) {
  return std::max(kShortestTime_s, std::min(time_s, 0.5 * last_time_s));
}

/// Back to where a step that cannot be used began. False when it was as short as can be.
bool take_back(const Eigen::VectorXd& start_m, double time_s, Limb& limb) {
  if (time_s <= kShortestTime_s) return false;
  put_nodes(start_m, limb);
  return true;
}

}  // namespace

double next_time_s(double time_s, double part) {
  const double change = part >= 1.0 ? kTimeGrowth : part < 0.3 ? kTimeCut : 1.0;
  return std::clamp(time_s * change, kShortestTime_s, kLongestTime_s);
}

TissueLoad static_load(const Vec3& gravity_m_s2) {
  TissueLoad load;
  load.gravity_m_s2 = gravity_m_s2;
  return load;
}

double rest_share(const LimbMuscle& muscle) {
  return muscle.system.residual_N.norm() / (muscle.system.force_scale_N + 1e-6);
}

bool settle_together(Limb& limb, double wanted_share, WorkerPool& workers) {
  Extrapolation extrapolation;
  double share = largest_share(limb, workers), best = share, time_s = kFirstRound_s;
  int waited = 0, held = 0;  // rounds: since the best share was halved; for which the faces stay yet
  for (int round = 0; round < kMostRounds && !(share < wanted_share); ++round) {
    const double faces_share = round < kRoundsBeforeFlips ? kFacesShare : kFlipShare;
    const Eigen::VectorXd start_m = node_places(limb);
    const double start_share = share, start_time_s = time_s;
    const Relaxation step = relax(limb, {share, time_s, kFarthest_m}, workers);
    time_s = next_time_s(time_s, step.sound ? step.part : 0.0);
    if (!step.sound && !take_back(start_m, start_time_s, limb)) return false;
    const Faces faces = held > 0 ? Faces::Held : Faces::Found;
    share = share_on(faces, limb, workers);
    waited = share < 0.5 * best ? 0 : waited + 1;
    best = std::min(best, share);
    const bool swings = waited >= kPatience;
    if (step.sound && step.part == 1.0 && (held > 0 || swings || share < kFacesChange))
      share = extrapolate(limb, faces, start_m, share, extrapolation, workers);
    else
      extrapolation.forget();
    if (held > 0) {
      --held;
      const bool rests = share < wanted_share;
      if (!rests && (held > 0 || round < kRoundsBeforeFlips)) continue;
      share = share_on(Faces::Found, limb, workers);
      if (share < (rests ? faces_share : kFacesShare)) return true;
      held = waited = 0;
      best = share;
      extrapolation.forget();
      continue;
    }
    if (swings && share > start_share) share = go_half_back(start_m, limb, workers);
    if (share > kTooLong * start_share) time_s = cautious_time_s(time_s, start_time_s);
    if (swings && share < faces_share) {
      held = kHeldRounds;
      extrapolation.forget();
    }
  }
  return share < wanted_share;
}

}  // namespace myotact::simulation
