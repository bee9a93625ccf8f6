#include "measure/fidelity/network_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <variant>

#include "core/error.h"
#include "haptics/faults.h"
#include "measure/fidelity/point_tissue.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr double kGateOpens_s = 1.2;  // 1 s of ramp and some
constexpr double kTremor_m = 5e-5;    // physiological tremor: 8-12 Hz, tens of um
constexpr double kTremor_Hz = 10.0;

scene::TouchMuscle first_touch(const scene::Scene& scene) {
  for (const scene::ScriptAction& action : scene.script) {
    if (const auto* touch = std::get_if<scene::TouchMuscle>(&action.what)) return *touch;
  }
  if (scene.specimen.muscles.empty())
    throw Error(ExitStatus::BadData, scene.name + ": the scene has no muscle to touch; take one that has");
  scene::TouchMuscle touch;
  touch.muscle = 0;
  touch.from = Vec3::UnitZ();
  return touch;
}

/// The scene at rest: what it does to the limb is left out, so that all work on the hand is the hand's own.
scene::Scene resting(scene::Scene scene) {
  scene.script.clear();
  scene.activations.assign(scene.activations.size(), 0.0);
  if (scene.co_contraction) {
    scene.co_contraction->common = scene.co_contraction->difference = 0.0;
    scene.co_contraction->hold_posture = false;
  }
  scene.tools.resize(1);
  return scene;
}

/// Begins one action of the hand after the other.
class RestlessHand {
 public:
  RestlessHand(const scene::TouchMuscle& touch, std::uint64_t seed) : touch_(touch), random_(seed) {}

  void begin_due(double time_s, scene::Conductor& conductor) {
    if (time_s < next_s_) return;
    scene::ScriptAction action;
    action.start_s = time_s;
    action.duration_s = between(0.4, 1.0);
    action.what = next();
    conductor.begin(action);
    next_s_ = action.end_s() + between(0.0, 0.4);
    part_ = (part_ + 1) % 4;
  }

 private:
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

  scene::Action next() {
    constexpr double kRange = 0.08;  // of the line's length, to both sides
    if (part_ == 3) return scene::ReleaseHand{};
    const double depth_m = between(1e-3, 4e-3);
    if (part_ == 0) {
      scene::TouchMuscle touch = touch_;
      touch.at = at_ = std::clamp(touch_.at + between(-kRange, kRange), 0.0, 1.0);
      touch.depth_m = depth_m;
      return touch;
    }
    if (part_ == 1) at_ = std::clamp(touch_.at + between(-kRange, kRange), 0.0, 1.0);
    return scene::SlideOnMuscle{at_, depth_m};  // part 2: on the spot, deeper or less deep
  }

  scene::TouchMuscle touch_;
  std::mt19937_64 random_;
  double next_s_ = kGateOpens_s;
  double at_ = 0.5;
  int part_ = 0;
};

Vec3 tremor_m(double time_s) {
  const double phase = 2.0 * std::numbers::pi * kTremor_Hz * time_s;
  return kTremor_m * Vec3(std::sin(phase), std::sin(1.13 * phase + 1.0), std::sin(0.87 * phase + 2.0));
}

/// Along a line that rotates, through the anchor twice a swing: a gate that a stall shut opens only there.
Vec3 swing_m(double time_s) {
  constexpr double kReach_m = 0.03, kSwings_Hz = 0.7, kRotation_Hz = 0.11;
  const double since_s = std::max(0.0, time_s - kGateOpens_s);
  const double angle_rad = 2.0 * std::numbers::pi * kRotation_Hz * since_s;
  const Vec3 way = Vec3(std::cos(angle_rad), std::sin(angle_rad), 0.5 * std::sin(1.7 * angle_rad)).normalized();
  return kReach_m * std::sin(2.0 * std::numbers::pi * kSwings_Hz * since_s) * way;
}

/// Energy in the springs of such a scene at rest, while they pull the hand.
double held_J(const simulation::TetherSettings& tether, const Vec3& force_N) {
  double compliance_m_N = 1.0 / tether.stiffness_N_m;
  if (tether.particle) compliance_m_N += 1.0 / tether.particle->cube_stiffness_N_m;
  return 0.5 * compliance_m_N * force_N.squaredNorm();
}

/// Keeps what a tick gave.
class Book {
 public:
  /// `tether`: null in a scene of touch; outlives it.
  Book(NetworkRun& run, const simulation::TetherSettings* tether) : run_(run), tether_(tether) {}

  void add(const remote::DelayedSession& session) {
    const messages::ToolState& tool = session.loop().tool_state();
    const Vec3 force_N = to_vec3(tool.force_world_N);
    const Vec3 device_m = session.device().position_world_m();
    const bool open = session.loop().gate_state() == haptics::GateState::On;
    const bool touches = tool.contact.surface >= 0;
    const double work_J = run_.force_N.empty() ? 0.0 : last_N_.dot(device_m - device_m_);
    add_work(work_J, force_N, open, touches);
    const double age_s = session.loop().felt_tool().model_age_s;
    add_rise(force_N.norm() - last_N_.norm(), open, age_s);
    if (open) run_.largest_age_s = std::max(run_.largest_age_s, age_s);
    if ((tool.faults & haptics::bit(haptics::Fault::Buzz)) != 0) ++run_.buzzes;
    if (!open) ++run_.faded_ticks;
    if (touches || tether_ != nullptr) {
      ++run_.touched_ticks;
      for (std::size_t k = 0; k < 3; ++k) jitter_[k].add(force_N[static_cast<Eigen::Index>(k)]);
    }
    last_N_ = force_N;
    device_m_ = device_m;
    run_.force_N.push_back(force_N);
    run_.jitter_N = std::hypot(jitter_[0].rms(), jitter_[1].rms(), jitter_[2].rms());
  }

 private:
  /// Springs into which the hand moved while the gate was shut come back with what they hold as it opens. Of a touch
  /// that is not known: it is put aside. Of a spring it is.
  void add_work(double work_J, const Vec3& force_N, bool open, bool touches) {
    net_J_ += work_J;
    if (tether_ != nullptr) {
      if (!was_open_) net_J_ = -held_J(*tether_, force_N);
    } else {
      aside_ = aside_ || !open;
      if (!touches && force_N.isZero()) {
        net_J_ = 0.0;
        aside_ = false;
      }
    }
    was_open_ = open;
    if (open && !aside_) run_.most_net_J = std::max(run_.most_net_J, net_J_);
  }

  void add_rise(double rise_N, bool open, double age_s) {
    constexpr int kLooked = 200;       // ticks
    constexpr double kBreak_s = 0.05;  // by which a model is suddenly younger
    const bool comes_back = (open && !was_on_) || age_s < last_age_s_ - kBreak_s;
    if (comes_back && has_been_on_) looked_ = kLooked;
    if (looked_-- > 0) run_.largest_rise_after_break_N = std::max(run_.largest_rise_after_break_N, rise_N);
    has_been_on_ = has_been_on_ || open;
    was_on_ = open;
    last_age_s_ = age_s;
  }

  NetworkRun& run_;
  const simulation::TetherSettings* tether_;
  std::array<Jitter, 3> jitter_;
  Vec3 last_N_ = Vec3::Zero(), device_m_ = Vec3::Zero();
  double net_J_ = 0.0, last_age_s_ = 0.0;
  int looked_ = 0;
  bool aside_ = false, was_open_ = false, was_on_ = false, has_been_on_ = false;
};

}  // namespace

NetworkRun run_over_network(const scene::Scene& scene, const NetworkRunRequest& request) {
  const scene::Scene rests = resting(scene);
  simulation::Simulation simulation(rests.specimen, rests.settings);
  const NetworkCase& link = request.link;
  remote::DelayedSession session(
      rests, simulation, remote::symmetric_link(link.round_trip_s, link.jitter_s, link.stalls_per_s, request.seed));
  const auto& tether = rests.settings.tether;
  std::optional<RestlessHand> hand;
  if (!tether) hand.emplace(first_touch(scene), request.seed);
  NetworkRun run;
  Book book(run, tether ? &*tether : nullptr);
  const auto ticks = static_cast<std::size_t>(std::llround(request.seconds / kTick_s));
  for (std::size_t i = 0; i < ticks && !request.stopped(); ++i) {
    const double time_s = session.time_s();
    Vec3 target_m;
    if (request.path_m != nullptr && i < request.path_m->size()) {
      target_m = (*request.path_m)[i];
    } else if (tether) {
      target_m = swing_m(time_s) + tremor_m(time_s);
    } else {
      hand->begin_due(time_s, session.conductor());
      target_m = session.conductor().hand(0, time_s).position_world_m + tremor_m(time_s);
    }
    run.hand_m.push_back(target_m);
    session.tick({to_array(target_m), {}, 0});
    book.add(session);
  }
  return run;
}

}  // namespace myotact::measure
