#include "measure/probe/probe.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/text.h"
#include "measure/probe/surface_side.h"
#include "measure/probe/surface_touch.h"

namespace myotact::measure {

namespace {

/// The virtual clock starts here, so that a frame may begin before the path does.
constexpr std::uint64_t kStart_ns = 1'000'000'000'000'000'000;

/// Shows frame after frame to the touch and to the check of sides.
class FilmPlayer {
 public:
  FilmPlayer(const ProbeInput& input, SurfaceTouch& touch, SurfaceSide& side)
      : input_(input), touch_(touch), side_(side), first_s_(input.path.t_s.front()) {}

  std::uint64_t clock_ns(double time_s) const {
    // Frames long before the path are as good as at the clock's start: the surface has moved on from them.
    const double since_s = std::clamp(time_s - first_s_, -1e8, 1e9);
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(kStart_ns) + std::llround(1e9 * since_s));
  }

  /// Puts the frames round this time in place.
  void show(double time_s) {
    if (input_.frames == nullptr) return;
    const ProbeFrames& frames = *input_.frames;
    std::size_t frame = shown_ ? frame_ : 0;
    while (frame + 1 < frames.count() && frames.t_s(frame + 1) <= time_s) ++frame;
    if (shown_ && frame_ == frame) return;
    const bool is_next = shown_ && frame_ + 1 == frame && !next_m_.empty();
    std::vector<Vec3> from_m = is_next ? next_m_ : frames.positions_m(frame, *input_.surface);
    const std::size_t after = std::min(frame + 1, frames.count() - 1);
    next_m_ = after == frame ? from_m : frames.positions_m(after, *input_.surface);
    const std::uint64_t begin_ns = clock_ns(frames.t_s(frame));
    side_.fit(from_m, next_m_);
    touch_.play(std::move(from_m), next_m_, begin_ns, clock_ns(frames.t_s(after)) - begin_ns);
    shown_ = true;
    frame_ = frame;
  }

 private:
  const ProbeInput& input_;
  SurfaceTouch& touch_;
  SurfaceSide& side_;
  double first_s_;
  bool shown_ = false;
  std::size_t frame_ = 0;
  std::vector<Vec3> next_m_;  // of the frame after the shown one
};

void append(std::string& csv, const Vec3& v) {
  for (int i = 0; i < 3; ++i) {
    csv += ',';
    csv += to_text(v[i]);
  }
}

std::size_t tick_count(const ProbeInput& input) {
  const double ticks = std::floor(input.path.duration_s() * input.rate_hz * (1.0 + 1e-12) + 1e-9) + 1.0;
  if (ticks <= static_cast<double>(kMostTicks)) return static_cast<std::size_t>(ticks);
  throw Error(ExitStatus::BadData,
              fmt::format("the path takes {} s, which is {:.4g} ticks at {} Hz; must be at most {}; probe it in parts, "
                          "at a lower --rate, or correct t_s",
                          to_text(input.path.duration_s()), ticks, to_text(input.rate_hz), kMostTicks));
}

/// Cut to the largest force, keeping its direction. Zero for what is not a number, which never came up.
Vec3 limited(const Vec3& force_N, ProbeSummary& summary) {
  if (!force_N.allFinite()) return Vec3::Zero();
  const double size_N = force_N.norm();
  summary.largest_force_N = std::max(summary.largest_force_N, std::min(size_N, kLargestProbeForce_N));
  if (size_N <= kLargestProbeForce_N) return force_N;
  ++summary.limited;
  return force_N * (kLargestProbeForce_N / size_N);
}

}  // namespace

ProbeAnswer run_probe(const ProbeInput& input, const std::function<bool()>& go_on) {
  const std::size_t ticks = tick_count(input);
  const auto touch = std::make_unique<SurfaceTouch>(*input.surface, input.contact);
  SurfaceSide side(*input.surface);
  FilmPlayer film(input, *touch, side);
  realtime::PeriodHistogram durations;
  ProbeAnswer answer;
  ProbeSummary& summary = answer.summary;
  answer.csv = "t_s,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N,contacts,rescues,inside,tick_us\n";
  haptics::ProxyGoal goal;
  std::uint64_t rescues = 0;
  for (std::size_t i = 0; i < ticks && go_on(); ++i) {
    const double time_s = input.path.t_s.front() + static_cast<double>(i) / input.rate_hz;
    const Vec3 before_m = goal.position_m;
    goal.position_m = input.path.at(time_s);
    goal.velocity_m_s = i == 0 ? Vec3::Zero() : Vec3((goal.position_m - before_m) * input.rate_hz);
    film.show(time_s);
    touch->tick(goal, film.clock_ns(time_s));
    const haptics::Proxy& proxy = touch->proxy();
    const Vec3 force_N = limited(touch->force_N(goal), summary);
    const bool inside = side.inside(proxy.position_m(), touch->positions_m());
    const std::uint64_t rescued = proxy.counters().rescues - rescues;
    rescues = proxy.counters().rescues;
    durations.add(touch->tick_duration_ns());
    ++summary.rows;
    summary.in_contact += proxy.contact().active ? 1 : 0;
    summary.inside += inside ? 1 : 0;
    answer.csv += to_text(time_s);
    append(answer.csv, proxy.position_m());
    append(answer.csv, force_N);
    answer.csv += fmt::format(",{},{},{},{}\n", proxy.contact().bearing, rescued, inside ? 1 : 0,
                              to_text(1e-3 * static_cast<double>(touch->tick_duration_ns())));
  }
  summary.rescues = rescues;
  summary.tick = durations.summary();
  return answer;
}

std::string probe_text(const ProbeSummary& summary) {
  return fmt::format(
      "rows {}, in contact {}, rescues {}, inside {}\nlargest force {:.4g} N\ntick p50 {:.1f} us, p99 {:.1f} us, "
      "max {:.1f} us\n",
      summary.rows, summary.in_contact, summary.rescues, summary.inside, summary.largest_force_N,
      1e-3 * static_cast<double>(summary.tick.p50_ns), 1e-3 * static_cast<double>(summary.tick.p99_ns),
      1e-3 * static_cast<double>(summary.tick.max_ns));
}

std::string probe_json(const ProbeSummary& summary) {
  const nlohmann::ordered_json json = {{"rows", summary.rows},
                                       {"in_contact", summary.in_contact},
                                       {"rescues", summary.rescues},
                                       {"inside", summary.inside},
                                       {"limited", summary.limited},
                                       {"largest_force_N", summary.largest_force_N},
                                       {"tick_p50_us", 1e-3 * static_cast<double>(summary.tick.p50_ns)},
                                       {"tick_p99_us", 1e-3 * static_cast<double>(summary.tick.p99_ns)},
                                       {"tick_max_us", 1e-3 * static_cast<double>(summary.tick.max_ns)}};
  return json.dump(2) + "\n";
}

}  // namespace myotact::measure
