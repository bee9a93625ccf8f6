#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace myotact::measure {

/// A name that a column may have, and what makes its numbers SI.
struct MeasuredColumn {
  std::string name;
  double to_si = 1.0;
};

/// A measured quantity and the columns that may hold it, of which a file has exactly one.
struct MeasuredQuantity {
  std::string what;
  std::vector<MeasuredColumn> columns;
};

/// The column that a file has of a quantity.
struct MeasuredValues {
  std::string column;
  std::vector<double> si;  // one a row
};

/// Longest table: a curve sampled at 1 kHz for a hundred seconds.
inline constexpr std::size_t kMostMeasuredRows = 100'000;

/// Reads the quantities out of a table in CSV whose first line names its columns; other columns may be there. Throws
/// Error: NoInput, or BadData naming file, line and column for a quantity that is missing or there twice, a row that is
/// too short, what is no finite number, and a table without rows.
std::vector<MeasuredValues> read_measured_table(const std::filesystem::path& path,
                                                std::span<const MeasuredQuantity> quantities);

}  // namespace myotact::measure
