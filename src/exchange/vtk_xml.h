#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/vector.h"

namespace myotact::exchange {

/// Values with a name, `components` numbers a tuple; of points, of cells or of the whole.
struct VtkArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::string>> values;
};

/// Numbers that VTK gives to its cells.
inline constexpr std::uint8_t kVtkTetra = 10, kVtkQuadraticTetra = 24;

/// A grid of cells with `types`, or a surface of polygons without.
struct VtkPiece {
  bool surface = false;
  std::vector<Vec3> points_m;
  std::vector<std::int64_t> connectivity;  // points of all cells, one cell after the other
  std::vector<std::int64_t> offsets;       // of each cell: where its points end
  std::vector<std::uint8_t> types;         // of each cell
  std::vector<VtkArray> point_data, cell_data;
  std::vector<VtkArray> field_data;  // of the whole: times, names
};

/// The piece as an XML file of VTK (.vtu or .vtp, version 1.0): numbers are doubles or integers, appended raw, so that
/// they are read to the last bit; names are text. The same bytes each time.
std::string vtk_xml(const VtkPiece& piece);

/// A file of a series (.pvd): one of the parts of one instant.
struct VtkSeriesEntry {
  double time_s = 0.0;
  int part = 0;
  std::filesystem::path file;  // relative to the series
};
std::string vtk_series(const std::vector<VtkSeriesEntry>& entries);

}  // namespace myotact::exchange
