#include "measure/fidelity/network_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <variant>

#include "core/error.h"
#include "haptics/faults.h"
#include "measure/fidelity/point_tissue.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;
constexpr double kGateOpens_s = 1.2;  // 1 s of ramp and some
/// After that long the first meeting of tool and tissue, which is a step by itself, is over.
constexpr int kTouchedFirm_ticks = 50;
constexpr double kTremor_m = 5e-5;  // physiological tremor: 8-12 Hz, tens of um
constexpr double kTremor_Hz = 10.0;

scene::TouchMuscle first_touch(const scene::Scene& scene) {
  for (const scene::ScriptAction& action : scene.script) {
    if (const auto* touch = std::get_if<scene::TouchMuscle>(&action.deed)) return *touch;
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
    action.deed = deed();
    conductor.begin(action);
    next_s_ = action.end_s() + between(0.0, 0.4);
    part_ = (part_ + 1) % 4;
  }

 private:
  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }

  scene::Deed deed() {
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

/// Keeps what a tick gave.
class Book {
 public:
  explicit Book(NetworkRun& run) : run_(run) {}

  void add(const remote::DelayedSession& session) {
    const messages::ToolState& tool = session.loop().tool_state();
    const Vec3 force_N = to_vec3(tool.force_world_N);
    const Vec3 device_m = session.device().position_world_m();
    const bool open = session.loop().gate_state() == haptics::GateState::On;
    in_touch_J_ += knows_device_ ? last_N_.dot(device_m - device_m_) : 0.0;
    // Springs into which the hand moved while the gate was shut come back with what they hold as it opens: put aside.
    aside_ = aside_ || !open;
    if (!aside_) run_.most_in_touch_J = std::max(run_.most_in_touch_J, in_touch_J_);
    if (open) run_.largest_age_s = std::max(run_.largest_age_s, session.loop().felt_tool().model_age_s);
    if ((tool.faults & haptics::bit(haptics::Fault::Buzz)) != 0) ++run_.buzzes;
    if (!open) ++run_.faded_ticks;
    const bool touches = tool.contact.surface >= 0;
    touching_ticks_ = touches ? touching_ticks_ + 1 : 0;
    if (touching_ticks_ > kTouchedFirm_ticks)
      run_.largest_rise_N = std::max(run_.largest_rise_N, force_N.norm() - last_N_.norm());
    if (touches) {
      ++run_.touched_ticks;
      for (std::size_t k = 0; k < 3; ++k) jitter_[k].add(force_N[static_cast<Eigen::Index>(k)]);
    } else if (force_N.isZero()) {
      in_touch_J_ = 0.0;
      aside_ = false;
    }
    last_N_ = force_N;
    device_m_ = device_m;
    knows_device_ = true;
    run_.force_N.push_back(force_N);
    run_.jitter_N = std::hypot(jitter_[0].rms(), jitter_[1].rms(), jitter_[2].rms());
  }

 private:
  NetworkRun& run_;
  std::array<Jitter, 3> jitter_;
  Vec3 last_N_ = Vec3::Zero(), device_m_ = Vec3::Zero();
  double in_touch_J_ = 0.0;
  int touching_ticks_ = 0;
  bool knows_device_ = false;
  bool aside_ = false;
};

}  // namespace

NetworkRun run_over_network(const scene::Scene& scene, const NetworkRunRequest& request) {
  const scene::Scene rests = resting(scene);
  simulation::Simulation simulation(rests.specimen, rests.settings);
  const NetworkCase& link = request.link;
  remote::DelayedSession session(
      rests, simulation, remote::symmetric_link(link.round_trip_s, link.jitter_s, link.stalls_per_s, request.seed));
  RestlessHand hand(first_touch(scene), request.seed);
  NetworkRun run;
  Book book(run);
  const auto ticks = static_cast<std::size_t>(std::llround(request.seconds / kTick_s));
  for (std::size_t i = 0; i < ticks && !request.stopped(); ++i) {
    const double time_s = session.time_s();
    Vec3 target_m;
    if (request.path_m != nullptr && i < request.path_m->size()) {
      target_m = (*request.path_m)[i];
    } else {
      hand.begin_due(time_s, session.conductor());
      target_m = session.conductor().hand(0, time_s).position_world_m + tremor_m(time_s);
    }
    run.hand_m.push_back(target_m);
    session.tick({to_array(target_m), {}, 0});
    book.add(session);
  }
  return run;
}

}  // namespace myotact::measure
