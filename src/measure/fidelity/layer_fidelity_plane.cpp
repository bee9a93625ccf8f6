#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "haptics/haptic_loop.h"
#include "measure/fidelity/layer_fidelity.h"
#include "measure/fidelity/point_tissue.h"
#include "scene/lockstep_haptics.h"

namespace myotact::measure {
namespace {

constexpr double kTick_s = 1e-3;
constexpr double kPress_N = 1.0;
constexpr double kSpeed_m_s = 0.05;  // of a finger that feels a surface
/// The force gate opens; the hand hovers and comes down; then it slides, rests, and slides the other way.
constexpr double kHover_s = 2.0, kDown_s = 0.5, kRest_s = 0.5, kSpeedUp_s = 0.3;
/// Tremor of a hand: 8-10 Hz, 0.2 mm (general knowledge).
constexpr double kTremor_m = 0.2e-3, kTremor_hz = 9.0;

struct SlideTest {
  double slide_s = 2.0;
  bool trembles = false;
};

/// A force method as it is compared: the spring alone, since A and B have neither friction nor damping, or as the scene
/// sets the tool.
struct Method {
  const char* name;
  haptics::ForceMethod method;
  bool as_set = false;
  bool is_published() const { return method != haptics::ForceMethod::Proxy; }
};
constexpr std::array kMethods{
    Method{"A penetration", haptics::ForceMethod::Penetration}, Method{"B plane", haptics::ForceMethod::Plane},
    Method{"proxy", haptics::ForceMethod::Proxy}, Method{"proxy as set", haptics::ForceMethod::Proxy, true}};
/// Both engines report a plane exactly, as far as the deepest contact goes; then B is the closed form itself, which
/// nothing can be below: as good is within this, by which the jitter differs because rounding takes the hand another
/// way.
constexpr double kAsGood = 1.01;
/// Less jitter than this counts as zero: rounding, up to a million times over.
constexpr double kNone_N = 1e-6, kNone_m = 1e-9;

double minimum_jerk(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

/// How far a slide has come: the speed rises over kSpeedUp_s and then is constant.
double slid_m(double t_s, double slide_s) {
  t_s = std::clamp(t_s, 0.0, slide_s);
  const double risen_s = std::min(t_s, kSpeedUp_s);
  return kSpeed_m_s * (0.5 * risen_s * risen_s / kSpeedUp_s + (t_s - risen_s));
}

/// Where the hand wants the stylus: down onto the plane, along x, along y.
struct Way {
  double radius_m, stiffness_N_m, hand_N_m;
  SlideTest test;

  double start_of(int axis) const { return kHover_s + kDown_s + kRest_s + axis * (test.slide_s + kRest_s); }
  double end_s() const { return start_of(1) + test.slide_s; }

  Vec3 at(double t_s) const {
    const double deep_m = kPress_N / stiffness_N_m + kPress_N / hand_N_m;
    const double above_m = 0.01 - (0.01 + deep_m) * minimum_jerk((t_s - kHover_s) / kDown_s);
    Vec3 target_m(-0.05 + slid_m(t_s - start_of(0), test.slide_s), -0.05 + slid_m(t_s - start_of(1), test.slide_s),
                  radius_m + above_m);
    if (test.trembles) {
      // The three ways a third of a turn apart: no direction is preferred.
      for (int k = 0; k < 3; ++k) {
        target_m[k] +=
            kTremor_m / std::numbers::sqrt3 * std::sin(2.0 * std::numbers::pi * (kTremor_hz * t_s + k / 3.0));
      }
    }
    return target_m;
  }
};

/// Of one slide, once the speed is constant.
struct SlideFigures {
  std::array<Jitter, 3> force_N, place_m;  // along the slide, across, along the plane's normal
  double largest_step_N = 0.0;
  double pressed_N = 0.0;
  int ticks = 0;

  void add(const LayerTick& tick, const Vec3& last_N, int axis) {
    const std::array<int, 3> order{axis, 1 - axis, 2};
    for (std::size_t k = 0; k < 3; ++k) {
      force_N[k].add(tick.force_N[order[k]]);
      place_m[k].add(tick.hand_m[order[k]] - tick.target_m[order[k]]);
    }
    largest_step_N = std::max(largest_step_N, (tick.force_N - last_N).norm());
    pressed_N += tick.force_N.z();
    ++ticks;
  }
  static double all(const std::array<Jitter, 3>& jitter) {
    return std::hypot(jitter[0].rms(), jitter[1].rms(), jitter[2].rms());
  }
};

struct PlaneRun {
  std::string engine;
  Method method;
  SlideTest test;
  std::array<SlideFigures, 2> ways;  // along x, along y
  double force_N() const { return std::max(SlideFigures::all(ways[0].force_N), SlideFigures::all(ways[1].force_N)); }
  double place_m() const { return std::max(SlideFigures::all(ways[0].place_m), SlideFigures::all(ways[1].place_m)); }
};

/// `result` states what to run, and takes its figures.
void slide(const scene::Scene& scene, PlaneRun& result, LayerFidelity::Trace& trace) {
  haptics::HapticSettings settings = scene::haptic_settings(scene.tools.front());
  settings.method = result.method.method;
  if (!result.method.as_set) {
    settings.contact.static_friction = settings.contact.dynamic_friction = settings.contact.damping_Ns_m = 0.0;
  }
  const SlideTest& test = result.test;
  const Way way{settings.contact.radius_m, settings.contact.stiffness_N_m, device::HandProfile{}.stiffness_N_m, test};
  LayerRun run(result.engine, scene, settings, way.at(0.0));
  Vec3 last_N = Vec3::Zero();
  const auto ticks = static_cast<int>(std::lround(way.end_s() / kTick_s));
  for (int i = 0; i < ticks; ++i) {
    const double t_s = i * kTick_s;
    const LayerTick& tick = run.tick(way.at(t_s), (way.at(t_s + kTick_s) - way.at(t_s)) / kTick_s, 0);
    for (int axis = 0; axis < 2; ++axis) {
      const double since_s = t_s - way.start_of(axis);
      if (since_s < 2.0 * kSpeedUp_s || since_s >= test.slide_s) continue;
      result.ways[static_cast<std::size_t>(axis)].add(tick, last_N, axis);
    }
    last_N = tick.force_N;
    if (t_s >= way.start_of(0)) trace.ticks.push_back(tick);
  }
}

void add_rows(const PlaneRun& run, LayerFidelity& fidelity) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const SlideFigures& way = run.ways[axis];
    fidelity.rows.push_back(
        {run.engine, run.method.name, run.test.trembles ? "trembles" : "steady", axis == 0 ? "x" : "y"});
    std::vector<double> values;
    for (const Jitter& jitter : way.force_N) values.push_back(1e3 * jitter.rms());
    for (const Jitter& jitter : way.place_m) values.push_back(1e6 * jitter.rms());
    values.push_back(1e3 * way.largest_step_N);
    values.push_back(way.pressed_N / way.ticks);
    fidelity.values.push_back(std::move(values));
  }
}

/// By how much the two ways differ, of the smaller one; `none`: less than this is no jitter at all.
double difference_percent(double a, double b, double none) {
  return std::max(a, b) < none ? 0.0 : 100.0 * (std::max(a, b) / std::min(a, b) - 1.0);
}

void compare(const PlaneRun& proxy, const PlaneRun& other, LayerFidelity& fidelity) {
  const std::string beside = fmt::format("{}, hand {}, proxy beside {}", proxy.engine,
                                         proxy.test.trembles ? "trembles" : "steady", other.method.name);
  fidelity.figures.push_back(
      {beside + ": force jitter", 1e3 * proxy.force_N(), "mN", 1e3 * (kAsGood * other.force_N() + kNone_N)});
  fidelity.figures.push_back(
      {beside + ": place jitter", 1e6 * proxy.place_m(), "um", 1e6 * (kAsGood * other.place_m() + kNone_m)});
}

void add_goals(const std::vector<PlaneRun>& runs, LayerFidelity& fidelity) {
  for (const PlaneRun& proxy : runs) {
    if (proxy.method.is_published()) continue;
    const std::string which =
        fmt::format("{}, hand {}, {}", proxy.engine, proxy.test.trembles ? "trembles" : "steady", proxy.method.name);
    const auto& [x, y] = proxy.ways;
    fidelity.figures.push_back({which + ": force jitter, x against y",
                                difference_percent(SlideFigures::all(x.force_N), SlideFigures::all(y.force_N), kNone_N),
                                "%", 10.0});
    fidelity.figures.push_back({which + ": place jitter, x against y",
                                difference_percent(SlideFigures::all(x.place_m), SlideFigures::all(y.place_m), kNone_m),
                                "%", 10.0});
    fidelity.figures.push_back({which + ": largest step of the force in a tick",
                                1e3 * std::max(x.largest_step_N, y.largest_step_N), "mN", 30.0});
    for (const PlaneRun& other : runs) {
      const bool beside = !proxy.method.as_set && other.method.is_published() && other.engine == proxy.engine &&
                          other.test.trembles == proxy.test.trembles;
      if (beside) compare(proxy, other, fidelity);
    }
  }
}

}  // namespace

LayerFidelity measure_plane(const scene::Scene& scene, Effort effort) {
  LayerFidelity fidelity;
  fidelity.title = fmt::format("{}: {} N on the plane, {} mm/s along x, then along y; engines at 60 Hz, hand at 1 kHz",
                               scene.name, kPress_N, 1e3 * kSpeed_m_s);
  fidelity.columns = {"engine",    "method",   "hand",      "way",       "along mN", "across mN",
                      "normal mN", "along um", "across um", "normal um", "step mN",  "press N"};
  std::vector<PlaneRun> runs;
  for (const std::string& engine : layer_engines()) {
    for (const bool trembles : {false, true}) {
      for (const Method& method : kMethods) {
        runs.push_back({engine, method, {.slide_s = effort == Effort::Full ? 2.0 : 1.2, .trembles = trembles}, {}});
        LayerFidelity::Trace trace{engine, method.name, {}};
        slide(scene, runs.back(), trace);
        add_rows(runs.back(), fidelity);
        if (trembles) fidelity.traces.push_back(std::move(trace));
      }
    }
  }
  add_goals(runs, fidelity);
  fidelity.notes = {
      "mN, um: jitter of the force on the hand, and of the place of the stylus less where the hand wants it: what is",
      "left above 20 Hz (first order), as root of its mean square, once the speed is constant; in a goal: all axes.",
      "step: largest change of the force from tick to tick; one count of the encoder is 20 mN.",
      "A trembling hand wants 0.2 mm at 9 Hz; what that leaves above 20 Hz is the same for all.",
      "A, B and proxy are the spring alone, the proxy as set has the scene's friction and damping.",
      "Both engines report the depth on a plane exactly, so B is the closed form: as good as A and B is within 1 %.",
      "A y-up world calls our y z."};
  return fidelity;
}

}  // namespace myotact::measure
