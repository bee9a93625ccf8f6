#include "measure/fidelity/touch_map.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "core/error.h"
#include "measure/fidelity/felt_masks.h"
#include "measure/fidelity/true_force.h"
#include "simulation/worker_pool.h"

namespace myotact::measure {

namespace {

constexpr double kOutside_m = 25e-3, kDepth_m = 4e-3, kStroke_m = 5e-3;
constexpr double kPressed_s = 0.6, kHeld_s = 1.6, kAlong_s = 2.2, kAcross_s = 2.8, kEnd_s = 3.2;
/// The swing of a held hand is looked at once the tissue has come to rest under it.
constexpr std::size_t kStillFrom_ticks = 900, kStillTo_ticks = 1600;

double minimum_jerk(double s) {
  const double part = std::clamp(s, 0.0, 1.0);
  return part * part * part * (10.0 + part * (6.0 * part - 15.0));
}

/// Where the hand is on its way to, over and from a place.
Vec3 hand_m(const TouchPlace& place, double time_s) {
  const double pressed = minimum_jerk(time_s / kPressed_s);
  const double lifted = minimum_jerk((time_s - kAcross_s) / (kEnd_s - kAcross_s));
  const double height_m = kOutside_m - (kOutside_m + kDepth_m) * (pressed - lifted);
  const double along_m = kStroke_m * minimum_jerk((time_s - kHeld_s) / (kAlong_s - kHeld_s));
  const double across_m = kStroke_m * minimum_jerk((time_s - kAlong_s) / (kAcross_s - kAlong_s));
  return place.position_m + height_m * place.normal + along_m * place.along +
         across_m * place.normal.cross(place.along);
}

/// A scene that stands at its start again before each place.
class TouchedLimb {
 public:
  explicit TouchedLimb(const scene::Scene& scene)
      : scene_(scene), simulation_(scene.specimen, scene.settings), conductor_(scene, simulation_) {
    restart();
  }

  std::vector<TouchPlace> places(const TouchMapRequest& request) const {
    return touch_places(scene_.specimen, simulation_, scene_.tools.front().radius_m, request.places, request.seed);
  }
  void write_frame(messages::SceneFrame& frame) const { simulation_.write_frame(frame); }

  TouchedPlace touch(const TouchPlace& place, const device::DeviceProfile& profile) {
    restart();
    const auto hand = [&](std::size_t tool, double time_s) {
      return scene::HandTarget{tool == 0 ? hand_m(place, time_s) : scene::start_of_hand(scene_, tool), 0};
    };
    const DeviceRun run = run_along({scene_, simulation_, conductor_}, profile, {hand, kEnd_s}, {});
    const std::vector<Vec3> true_N = true_force_by_steps(run);
    const ForceSeries force = felt_series(run, true_N, compared_ticks(scene_, run, profile, true_N).compared);
    const ForceComparison found = compare_forces(force);
    TouchedPlace touched{place, 0.0, found.error_rms_share, found.gain};
    const std::span<const Vec3> felt_N = force.commanded_N;
    if (felt_N.size() >= kStillTo_ticks)
      touched.held_swing_N = swing_N(felt_N.subspan(kStillFrom_ticks, kStillTo_ticks - kStillFrom_ticks));
    for (std::size_t i = 0; i < felt_N.size(); ++i) {
      touched.felt_peak_N = std::max(touched.felt_peak_N, felt_N[i].norm());
      if (i > 0) touched.largest_step_N = std::max(touched.largest_step_N, (felt_N[i] - felt_N[i - 1]).norm());
    }
    return touched;
  }

 private:
  void restart() {
    simulation_.restart();
    conductor_.apply({messages::Reset{}, messages::Commander::Script});
  }

  const scene::Scene& scene_;
  simulation::Simulation simulation_;
  scene::Conductor conductor_;
};

/// The scene with one worker a simulation and without what is not touch.
scene::Scene touch_alone(const scene::Scene& whole) {
  scene::Scene scene = without_effects(whole);
  scene.script.clear();
  scene.settings.workers = 1;
  return scene;
}

/// Threads, and what the caller wants to hear of their work.
struct Crew {
  int workers = 1;
  const RunWatch& watch;
};

/// In the order of `places`, without those that were not reached before the caller stopped it.
std::vector<TouchedPlace> touch_all(const scene::Scene& scene, std::unique_ptr<TouchedLimb> first,
                                    const std::vector<TouchPlace>& places, const device::DeviceProfile& profile,
                                    const Crew& crew) {
  std::vector<std::optional<TouchedPlace>> touched(places.size());
  std::size_t next = 0, done = 0;
  std::mutex mutex;  // of both and the watch
  const auto take = [&] {
    const std::lock_guard lock(mutex);
    return crew.watch.stopped && crew.watch.stopped() ? places.size() : next++;
  };
  const auto report = [&] {
    const std::lock_guard lock(mutex);
    ++done;
    if (crew.watch.progress) crew.watch.progress(static_cast<int>(done), static_cast<int>(places.size()));
  };
  simulation::WorkerPool pool(std::clamp(crew.workers, 1, static_cast<int>(places.size())));
  pool.run(pool.workers(), [&](int worker) {
    const std::unique_ptr<TouchedLimb> limb = worker == 0 ? std::move(first) : std::make_unique<TouchedLimb>(scene);
    for (std::size_t i = take(); i < places.size(); i = take()) {
      touched[i] = limb->touch(places[i], profile);
      report();
    }
  });
  std::vector<TouchedPlace> reached;
  for (const std::optional<TouchedPlace>& one : touched) {
    if (one) reached.push_back(*one);
  }
  return reached;
}

}  // namespace

TouchMap map_touch(const scene::Scene& whole, const TouchMapRequest& request, const RunWatch& watch) {
  const scene::Scene scene = touch_alone(whole);
  TouchMap map{scene.name, scene.title, request.device, {}, request.places, {}, false, {}};
  for (const anatomy::Muscle& muscle : scene.specimen.muscles) map.muscles.push_back(muscle.name_en);
  auto first = std::make_unique<TouchedLimb>(scene);
  const std::vector<TouchPlace> places = first->places(request);
  if (places.empty()) throw bad_data(scene.name, "/specimen", "has no muscle that a hand can touch; name a limb");
  first->write_frame(map.frame);
  map.places = touch_all(scene, std::move(first), places, request.profile, {whole.settings.workers, watch});
  map.complete = map.places.size() == places.size();
  return map;
}

std::vector<GradedFigure> grade(const TouchedPlace& place) {
  if (!std::isfinite(place.error_share)) return {};
  return {{"difference", "% RMS", 100.0 * place.error_share, 5.0, 15.0,
           "5 %: the goal of felt stiffness; 15 %: below what a hand notices (Jones and Hunter 1990: 23 %)"},
          {"swing while held, over 20 Hz", "mN RMS", 1e3 * place.held_swing_N, 20.0, 50.0,
           "20 mN: what moves no device; 50 mN: where a coupling counts as unstable"}};
}

int places_of(const TouchMap& map, Grade wanted, int muscle) {
  return static_cast<int>(std::count_if(map.places.begin(), map.places.end(), [&](const TouchedPlace& touched) {
    return (muscle < 0 || touched.place.muscle == muscle) && worst_grade(grade(touched)) == wanted;
  }));
}

}  // namespace myotact::measure
