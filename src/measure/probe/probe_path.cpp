#include "measure/probe/probe_path.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "measure/probe/csv_rows.h"

namespace myotact::measure {

namespace {

Error refuse(const CsvRows& rows, const std::string& problem) {
  return {ExitStatus::BadData, rows.place() + ": " + problem};
}

void add_point(const CsvRows& rows, ProbePath& path) {
  constexpr std::array<std::string_view, 3> names = {"x_m", "y_m", "z_m"};
  const double t_s = rows.number(0);
  Vec3 position_m;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x_m = position_m[static_cast<Eigen::Index>(i)] = rows.number(i + 1);
    if (std::abs(x_m) <= kFarthest_m) continue;
    throw refuse(rows, fmt::format("{} is {}; must be in -{} .. {} m; a path in millimetres must be divided by 1000",
                                   names[i], to_text(x_m), kFarthest_m, kFarthest_m));
  }
  if (!path.t_s.empty()) {
    const double dt_s = t_s - path.t_s.back();
    if (!(dt_s > 0.0)) {
      throw refuse(rows, fmt::format("t_s is {} after {}; must rise from row to row; sort the rows by time",
                                     to_text(t_s), to_text(path.t_s.back())));
    }
    const double way_m = (position_m - path.position_m.back()).norm();
    if (way_m > kFastestPath_m_s * dt_s) {
      throw refuse(rows,
                   fmt::format("jumps by {} m in {} s; must move at 0 .. {} m/s; put points between or correct it",
                               to_text(way_m), to_text(dt_s), kFastestPath_m_s));
    }
  }
  path.t_s.push_back(t_s);
  path.position_m.push_back(position_m);
}

}  // namespace

ProbePath load_path(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  constexpr std::array<std::string_view, 4> columns = {"t_s", "x_m", "y_m", "z_m"};
  CsvRows rows(text, file.string(), columns);
  ProbePath path;
  while (rows.next()) add_point(rows, path);
  if (path.t_s.empty())
    throw bad_data(file.string(), "", "holds no points; must have at least one row t_s, x_m, y_m, z_m");
  return path;
}

Vec3 ProbePath::at(double time_s) const {
  const auto after = std::upper_bound(t_s.begin(), t_s.end(), time_s);
  if (after == t_s.begin()) return position_m.front();
  if (after == t_s.end()) return position_m.back();
  const auto i = static_cast<std::size_t>(after - t_s.begin());
  const double share = (time_s - t_s[i - 1]) / (t_s[i] - t_s[i - 1]);
  return (1.0 - share) * position_m[i - 1] + share * position_m[i];
}

}  // namespace myotact::measure
