#include "measure/fit/measured_table.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"

namespace myotact::measure {

namespace {

constexpr std::size_t kMostTableColumns = 200;

std::string_view without_blanks(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string shown_field(std::string_view text) {
  std::string result(text.substr(0, 40));
  std::replace_if(
      result.begin(), result.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (fields.size() <= kMostTableColumns) {
    const std::size_t comma = line.find(',');
    fields.push_back(without_blanks(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  return fields;
}

/// Lines of a text that are not empty, with their numbers.
class TableLines {
 public:
  explicit TableLines(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }
  bool next() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      line = without_blanks(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++number;
      if (!line.empty()) return true;
    }
    return false;
  }

  std::string_view line;
  int number = 0;

 private:
  std::string_view rest_;
};

/// Where a quantity stands in the header.
struct FoundColumn {
  std::size_t place = 0;
  MeasuredColumn column;
};

FoundColumn find_column(const std::string& file, const std::vector<std::string_view>& header,
                        const MeasuredQuantity& quantity) {
  std::vector<FoundColumn> found;
  std::vector<std::string> names;
  for (const MeasuredColumn& column : quantity.columns) {
    names.push_back(column.name);
    for (std::size_t i = 0; i < header.size(); ++i) {
      if (header[i] == column.name) found.push_back({i, column});
    }
  }
  if (found.empty()) {
    std::string has;
    for (const std::string_view name : header) has += fmt::format("{}{}", has.empty() ? "" : ", ", shown_field(name));
    throw bad_data(file, "1",
                   fmt::format("has no column of the {}; name one of its columns {} (it has: {}){}", quantity.what,
                               join(names, " or "), has.substr(0, 200),
                               has.find(';') == std::string::npos ? "" : "; columns are parted by commas"));
  }
  if (found.size() > 1) {
    throw bad_data(file, "1",
                   fmt::format("has the {} twice, as {} and {}; leave one out", quantity.what, found[0].column.name,
                               found[1].column.name));
  }
  return found.front();
}

}  // namespace

std::vector<MeasuredValues> read_measured_table(const std::filesystem::path& path,
                                                std::span<const MeasuredQuantity> quantities) {
  const std::string text = read_file(path), file = path.string();
  TableLines lines(text);
  if (!lines.next()) throw bad_data(file, "", "is empty; must begin with a line of column names");
  const std::vector<std::string_view> header = fields_of(lines.line);
  if (header.size() > kMostTableColumns) {
    throw bad_data(file, "1", fmt::format("has more than {} columns", kMostTableColumns));
  }
  std::vector<FoundColumn> columns;
  std::vector<MeasuredValues> values;
  for (const MeasuredQuantity& quantity : quantities) {
    columns.push_back(find_column(file, header, quantity));
    values.push_back({columns.back().column.name, {}});
  }
  while (lines.next()) {
    const std::vector<std::string_view> fields = fields_of(lines.line);
    const std::string place = fmt::format("line {}", lines.number);
    if (values.front().si.size() == kMostMeasuredRows) {
      throw bad_data(file, place, fmt::format("is one row more than {}; leave every other one out", kMostMeasuredRows));
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].place >= fields.size()) {
        throw bad_data(file, place,
                       fmt::format("has {} fields and no {}; must have {} with commas between", fields.size(),
                                   columns[i].column.name, header.size()));
      }
      const std::string_view field = fields[columns[i].place];
      const auto number = parse_number(field);
      if (!number || !std::isfinite(*number)) {
        throw bad_data(file, place,
                       fmt::format("{} is \"{}\"; must be a finite number with \".\" as decimal point",
                                   columns[i].column.name, shown_field(field)));
      }
      values[i].si.push_back(*number * columns[i].column.to_si);
    }
  }
  if (values.front().si.empty()) throw bad_data(file, "", "has column names but no rows; add what was measured");
  return values;
}

}  // namespace myotact::measure
