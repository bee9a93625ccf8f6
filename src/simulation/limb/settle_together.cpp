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

/// Muscles on their way to rest, round after round: a step of all of them, then the faces under them found anew.
class Settling {
 public:
  Settling(Limb& limb, double wanted_share, WorkerPool& workers)
      : limb_(limb),
        workers_(workers),
        wanted_share_(wanted_share),
        share_(largest_share(limb, workers)),
        best_(share_) {}

  bool run() {
    for (; round_ < kMostRounds && !(share_ < wanted_share_); ++round_) {
      start_m_ = node_places(limb_);
      const double start_share = share_, start_time_s = time_s_;
      const Relaxation step = relax(limb_, {share_, time_s_, kFarthest_m}, workers_);
      time_s_ = next_time_s(time_s_, step.sound ? step.part : 0.0);
      if (!step.sound && !take_back(start_m_, start_time_s, limb_)) return false;
      weigh(step);
      if (held_ == 0)
        watch(start_share, start_time_s);
      else if (--held_; rests())
        return true;
    }
    return share_ < wanted_share_;
  }

 private:
  /// The share where the step ended, or where the last ones lead.
  void weigh(const Relaxation& step) {
    share_ = share_here();
    waited_ = share_ < 0.5 * best_ ? 0 : waited_ + 1;
    best_ = std::min(best_, share_);
    if (step.sound && step.part == 1.0 && (held_ > 0 || swings() || share_ < kFacesChange))
      extrapolate();
    else
      extrapolation_.forget();
  }

  double share_here() {
    if (held_ == 0)
      find_touches(limb_, workers_);
    else
      see_neighbours(limb_);
    return largest_share(limb_, workers_);
  }

  bool swings() const { return waited_ >= kPatience; }
  /// What a rest on faces may leave when they are found anew.
  double faces_share() const { return round_ < kRoundsBeforeFlips ? kFacesShare : kFlipShare; }

  /// Goes on to where the last steps lead, unless that is worse than where the last one ended.
  void extrapolate() {
    const Eigen::VectorXd end_m = node_places(limb_);
    put_nodes(extrapolation_.next(start_m_, end_m), limb_);
    const double there = share_here();
    if (there < kTooLong * share_) {
      share_ = there;
      return;
    }
    extrapolation_.forget();
    put_nodes(end_m, limb_);
    share_ = share_here();
  }

  /// Shortens steps that were too long for the faces, and holds the faces once they alone keep the muscles from rest.
  void watch(double start_share, double start_time_s) {
    if (swings() && share_ > start_share) {  // half way back is nearer to what they swing round
      put_nodes(0.5 * (start_m_ + node_places(limb_)), limb_);
      share_ = share_here();
    }
    if (share_ > kTooLong * start_share) time_s_ = cautious_time_s(time_s_, start_time_s);
    if (!swings() || !(share_ < faces_share())) return;
    held_ = kHeldRounds;
    extrapolation_.forget();
  }

  /// On faces that were held. Where they leave too much once found anew, all begins again.
  bool rests() {
    const bool at_rest = share_ < wanted_share_;
    if (!at_rest && (held_ > 0 || round_ < kRoundsBeforeFlips)) return false;
    held_ = 0;
    share_ = share_here();
    if (share_ < (at_rest ? faces_share() : kFacesShare)) return true;
    waited_ = 0;
    best_ = share_;
    extrapolation_.forget();
    return false;
  }

  Limb& limb_;
  WorkerPool& workers_;
  const double wanted_share_;
  double share_, best_, time_s_ = kFirstRound_s;
  int round_ = 0;
  int waited_ = 0, held_ = 0;  // rounds: since the best share was halved; for which the faces stay yet
  Eigen::VectorXd start_m_;    // where the round began
  Extrapolation extrapolation_;
};

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
  return Settling(limb, wanted_share, workers).run();
}

}  // namespace myotact::simulation
