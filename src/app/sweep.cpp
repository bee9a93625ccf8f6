#include "app/sweep.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "app/interruption.h"
#include "app/progress.h"
#include "app/shard.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "measure/sweep/sweep_point.h"

namespace myotact::app {

namespace {

constexpr int kMostSweepShards = 100'000;

struct PointRange {
  int first = 0, end = 0;
};

/// The points of a shard, one after the other.
PointRange points_of(const Shard& shard, int points) {
  const auto end_of = [&](int shares) {
    return static_cast<int>(static_cast<std::int64_t>(shares) * points / shard.parts);
  };
  return {end_of(shard.part - 1), end_of(shard.part)};
}

/// Joins the points' files; says which are missing.
int join_points(const Options& options, const measure::SweepPlan& plan, bool all_wanted) {
  std::vector<measure::SweepResult> results;
  int missing = 0, failed = 0, first_missing = -1;
  for (int point = 0; point < plan.points(); ++point) {
    auto result = measure::read_point(plan, point, options.out);
    if (!result) {
      if (missing++ == 0) first_missing = point;
      continue;
    }
    failed += result->error.empty() ? 0 : 1;
    results.push_back(std::move(*result));
  }
  if (missing > 0) {
    const std::string text = fmt::format("{} of {} points are not there yet, the first is {}", missing, plan.points(),
                                         (options.out / measure::point_file_name(first_missing)).string());
    if (all_wanted) throw Error(ExitStatus::BadData, "--merge: " + text + "; run the sweep again, it does these alone");
    spdlog::info("{}; --merge joins them when all shards have ended", text);
    return static_cast<int>(ExitStatus::Done);
  }
  const std::string csv = measure::sweep_csv(plan, results);
  write_file(options.out / "sweep.csv", csv);
  std::cout << csv << std::flush;
  if (failed > 0) spdlog::warn("{} of {} points could not be computed: see the column error", failed, plan.points());
  return static_cast<int>(failed > 0 ? ExitStatus::CheckFailed : ExitStatus::Done);
}

/// In the unit that suits it.
std::string time_text(double time_s) {
  constexpr double kMinute_s = 60.0, kHour_s = 3600.0;
  if (time_s < kMinute_s) return fmt::format("{:.1f} s", time_s);
  return time_s < kHour_s ? fmt::format("{:.1f} min", time_s / kMinute_s) : fmt::format("{:.1f} h", time_s / kHour_s);
}

/// Counts, and measures three points here.
int print_plan(const Options& options, const measure::SweepPlan& plan) {
  const auto points = measure::sweep_points(plan);
  double sum_s = 0.0;
  int measured = 0;
  for (const std::size_t point : {std::size_t{0}, points.size() / 2, points.size() - 1}) {
    if (interruption() != 0) return interruption();
    const auto start = std::chrono::steady_clock::now();
    measure::measure_point(plan, points[point], options.workers);
    sum_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++measured;
  }
  const double point_s = sum_s / measured;
  std::cout << fmt::format("{} points, {:.2f} s a point here ({} points measured, {} workers each)\n", points.size(),
                           point_s, measured, options.workers);
  for (const int jobs : {1, 8, 64, 256}) {
    std::cout << fmt::format("{:>4} jobs at once: {}\n", jobs,
                             time_text(point_s * std::ceil(static_cast<double>(points.size()) / jobs)));
  }
  return static_cast<int>(ExitStatus::Done);
}

}  // namespace

int sweep(const Options& options, const SweepWish& wish) {
  if (wish.merge && !wish.shard.empty()) throw Error(ExitStatus::Usage, "--merge and --shard: give one of them");
  watch_for_interruption();
  const measure::SweepPlan plan = measure::load_sweep(options.file, MYOTACT_VERSION);
  if (wish.plan) return print_plan(options, plan);
  make_writable_folder(options.out);
  if (wish.merge) return join_points(options, plan, true);
  const PointRange range = points_of(shard_of(wish.shard, kMostSweepShards), plan.points());
  const auto points = measure::sweep_points(plan);
  {
    Progress progress;
    for (int point = range.first; point < range.end; ++point) {
      if (interruption() != 0) return interruption();
      if (!measure::read_point(plan, point, options.out)) {
        const auto result = measure::measure_point(plan, points[static_cast<std::size_t>(point)], options.workers);
        write_file(options.out / measure::point_file_name(point), measure::point_json(plan, point, result));
      }
      progress.show(point + 1 - range.first, range.end - range.first);
    }
  }
  return join_points(options, plan, false);
}

}  // namespace myotact::app
