#pragma once

#include <string>
#include <vector>

namespace myotact::view {

/// One cell of a map. Each mark has a sign of its own.
struct MapCell {
  double value = 0.0;    // NaN: not known, drawn grey
  bool hatched = false;  // stripes
  bool crossed = false;  // a cross
  bool ringed = false;   // a ring
};

/// A value over two variables. `cells` row by row: cells[row * x.size() + column] belongs to x[column], y[row].
struct ValueMap {
  std::string title;
  std::string x_label, y_label, value_label;                     // with units
  std::string hatch_label, cross_label, ring_label, zero_label;  // what the marks and the line value = 0 mean
  std::vector<double> x, y;                                      // strictly rising, not empty
  std::vector<MapCell> cells;                                    // x.size() * y.size()
};

/// The map as an SVG document: cividis, a colour bar, the line along which the value is 0 (linear between the middles
/// of cells), a title in each cell for pointers that rest on it, no outside fonts.
std::string value_map_svg(const ValueMap& map);

}  // namespace myotact::view
