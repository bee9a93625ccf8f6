#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "fit_texture/recorded_signal.h"

namespace myotact::fit_texture {

namespace {

/// A row may come this much too early or late, in its spacing: written times have few digits.
constexpr double kUneven = 0.1;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t start = 0; start <= line.size();) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    std::string_view cell = line.substr(start, end - start);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t' || cell.back() == '\r')) cell.remove_suffix(1);
    cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

struct Columns {
  int time = -1, force = -1, acceleration = -1, normal_force = -1, speed = -1;
};

class CsvFile {
 public:
  CsvFile(const std::filesystem::path& path, std::string_view text) : file_(path.string()), rest_(text) {}

  RecordedSignal read(double mass_kg) {
    read_names();
    if (columns_.force < 0 && !(mass_kg > 0.0)) {
      throw Error(ExitStatus::Usage,
                  file_ + ": holds acceleration_m_s2; give the mass of what vibrates with --mass (kg)");
    }
    RecordedSignal recording;
    std::vector<double> times_s;
    for (std::string_view line; next(line);) {
      if (line.empty() || line == "\r") continue;
      const std::vector<std::string_view> cells = cells_of(line);
      times_s.push_back(number(cells, columns_.time, "t_s"));
      recording.signal_N.push_back(columns_.force >= 0
                                       ? number(cells, columns_.force, "force_N")
                                       : mass_kg * number(cells, columns_.acceleration, "acceleration_m_s2"));
      if (columns_.normal_force >= 0)
        recording.normal_force_N.push_back(number(cells, columns_.normal_force, "normal_force_N"));
      if (columns_.speed >= 0) recording.speed_m_s.push_back(std::abs(number(cells, columns_.speed, "speed_m_s")));
    }
    recording.rate_Hz = rate_of(times_s);
    return recording;
  }

 private:
  Error error(const std::string& problem) const { return bad_data(file_, fmt::format("line {}", line_), problem); }

  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return true;
  }

  void read_names() {
    std::string_view line;
    if (!next(line)) throw error("the file is empty; the first line must name the columns: t_s,force_N,...");
    const std::vector<std::string_view> names = cells_of(line);
    const auto place = [&](std::string_view name) {
      const auto found = std::find(names.begin(), names.end(), name);
      return found == names.end() ? -1 : static_cast<int>(found - names.begin());
    };
    columns_ = {place("t_s"), place("force_N"), place("acceleration_m_s2"), place("normal_force_N"),
                place("speed_m_s")};
    if (columns_.time < 0 || (columns_.force < 0 && columns_.acceleration < 0)) {
      throw error(
          "must name the columns t_s and force_N or acceleration_m_s2 (and may name normal_force_N, speed_m_s)");
    }
  }

  double number(const std::vector<std::string_view>& cells, int column, std::string_view name) const {
    const auto place = static_cast<std::size_t>(column);
    if (place >= cells.size())
      throw error(fmt::format("has {} cells; {} is missing: the file is truncated or damaged", cells.size(), name));
    const auto value = parse_number(cells[place]);
    if (!value || !std::isfinite(*value)) {
      throw error(fmt::format("{} is \"{}\"; must be a number: cut the row out, and split the recording there", name,
                              cells[place].substr(0, 40)));
    }
    return *value;
  }

  double rate_of(const std::vector<double>& times_s) const {
    if (times_s.size() < 2)
      throw bad_data(file_, "", fmt::format("holds {} samples; a texture needs some thousand", times_s.size()));
    const double step_s = (times_s.back() - times_s.front()) / static_cast<double>(times_s.size() - 1);
    for (std::size_t i = 0; i < times_s.size(); ++i) {
      const double late_s = times_s[i] - times_s.front() - step_s * static_cast<double>(i);
      if (step_s > 0.0 && std::abs(late_s) <= kUneven * step_s) continue;
      throw bad_data(file_, fmt::format("sample {}", i),
                     fmt::format("t_s is {}; must be evenly spaced and rising: resample "
                                 "the recording",
                                 to_text(times_s[i])));
    }
    return 1.0 / step_s;
  }

  std::string file_;
  std::string_view rest_;
  Columns columns_;
  int line_ = 0;
};

}  // namespace

RecordedSignal read_csv(const std::filesystem::path& path, double mass_kg) {
  const std::string text = read_file(path);
  return CsvFile(path, text).read(mass_kg);
}

}  // namespace myotact::fit_texture
