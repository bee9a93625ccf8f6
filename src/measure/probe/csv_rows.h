#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace myotact::measure {

/// Goes through the rows of a table in CSV: a line of column names, which must be the expected ones, then rows of as
/// many fields. Blanks round fields, empty lines, CR LF and a byte-order mark are read over. Each error is BadData and
/// names file, line and column.
class CsvRows {
 public:
  static constexpr std::size_t kMostColumns = 8;

  /// `text` must outlive the reader. Throws Error when the first line does not hold these names in this order.
  CsvRows(std::string_view text, std::string file, std::span<const std::string_view> columns);

  /// Goes to the next row; false after the last. Throws Error for too few or too many fields.
  bool next();
  std::string_view field(std::size_t column) const { return fields_[column]; }
  /// The field as a finite number. Throws Error.
  double number(std::size_t column) const;

  /// "FILE:LINE" of the row, for errors.
  std::string place() const;

 private:
  bool next_line(std::string_view& line);
  std::size_t split(std::string_view line);

  std::string_view rest_;
  std::string file_;
  std::array<std::string_view, kMostColumns> columns_{};
  std::size_t column_count_ = 0;
  std::array<std::string_view, kMostColumns> fields_{};
  int line_ = 0;
};

}  // namespace myotact::measure
