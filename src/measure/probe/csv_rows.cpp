#include "measure/probe/csv_rows.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// As it may be shown in one line of a message: short, and without bytes that a terminal would obey.
std::string shown(std::string_view text) {
  std::string result(text.substr(0, 40));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

}  // namespace

CsvRows::CsvRows(std::string_view text, std::string file, std::span<const std::string_view> columns)
    : rest_(text), file_(std::move(file)), column_count_(columns.size()) {
  std::copy(columns.begin(), columns.end(), columns_.begin());
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  std::string names;
  for (const std::string_view column : columns) names += fmt::format("{}{}", names.empty() ? "" : ", ", column);
  std::string_view line;
  if (!next_line(line)) throw bad_data(file_, "", fmt::format("is empty; must begin with a line \"{}\"", names));
  const bool right = split(line) == column_count_ && std::equal(columns.begin(), columns.end(), fields_.begin());
  if (!right) {
    throw bad_data(file_, fmt::format("{}", line_),
                   fmt::format("begins with \"{}\"; must be the column names \"{}\"", shown(line), names));
  }
}

bool CsvRows::next_line(std::string_view& line) {
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    if (!line.empty()) return true;
  }
  return false;
}

/// Fields of a line; counts those beyond the last column too.
std::size_t CsvRows::split(std::string_view line) {
  std::size_t count = 0;
  while (true) {
    const std::size_t comma = line.find(',');
    if (count < kMostColumns) fields_[count] = trimmed(line.substr(0, comma));
    ++count;
    if (comma == std::string_view::npos) return count;
    line.remove_prefix(comma + 1);
  }
}

bool CsvRows::next() {
  std::string_view line;
  if (!next_line(line)) return false;
  const std::size_t count = split(line);
  if (count != column_count_) {
    throw Error(ExitStatus::BadData,
                fmt::format("{}: has {} fields; must have {}, with commas between", place(), count, column_count_));
  }
  return true;
}

double CsvRows::number(std::size_t column) const {
  const std::optional<double> value = parse_number(field(column));
  if (value && std::isfinite(*value)) return *value;
  throw Error(ExitStatus::BadData, fmt::format("{}: {} is \"{}\"; must be a finite number with \".\" as decimal point",
                                               place(), columns_[column], shown(field(column))));
}

std::string CsvRows::place() const {
  return fmt::format("{}: line {}", file_, line_);
}

}  // namespace myotact::measure
