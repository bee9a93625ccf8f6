#include "view/charts/map_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myotact::view {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ValueMap map_of(std::vector<double> x, std::vector<double> y, double (*value)(double x, double y)) {
  ValueMap map;
  map.title = "a < b";
  map.x_label = "x [m]";
  map.y_label = "y [s]";
  map.value_label = "K [N m/rad]";
  map.hatch_label = "negative";
  map.cross_label = "lost";
  map.ring_label = "loose";
  map.zero_label = "K = 0";
  for (const double row : y) {
    for (const double column : x) map.cells.push_back({value(column, row), value(column, row) < 0.0});
  }
  map.x = std::move(x);
  map.y = std::move(y);
  return map;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// The places that the line value = 0 goes through, in pixels.
std::vector<std::pair<double, double>> zero_points(const std::string& svg) {
  std::smatch match;
  std::vector<std::pair<double, double>> points;
  if (!std::regex_search(svg, match, std::regex("class=\"zero\" d=\"([^\"]*)\""))) return points;
  const std::string path = match[1];
  const std::regex point("[ML]([0-9.]+) ([0-9.]+)");
  for (std::sregex_iterator it(path.begin(), path.end(), point), end; it != end; ++it) {
    points.emplace_back(std::strtod((*it)[1].str().c_str(), nullptr), std::strtod((*it)[2].str().c_str(), nullptr));
  }
  return points;
}

TEST(MapSvg, DrawsEveryCellWithItsValueAndMarks) {
  ValueMap map = map_of({0.0, 0.5, 1.0}, {-10.0, 0.0}, [](double x, double y) { return 2.0 * x + 0.1 * y; });
  map.cells[4].crossed = true;
  map.cells[5].value = std::nan("");
  const std::string svg = value_map_svg(map);
  EXPECT_THAT(svg, HasSubstr("<title>0.5, -10: 0</title>"));
  EXPECT_THAT(svg, HasSubstr("<title>1, 0: not known</title>"));
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  for (const char* label : {"x [m]", "y [s]", "K [N m/rad]", "negative", "lost", "loose", "K = 0", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(label));
  }
  EXPECT_EQ(count(svg, "url(#hatch)"), 1 + 1);  // the cell at (0, -10) and the legend
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, HasSubstr("#00204d"));  // ends of cividis: lowest and highest value
  EXPECT_THAT(svg, HasSubstr("#ffea46"));
}

TEST(MapSvg, TheLineOfZeroIsExactForAPlane) {
  // 4 x - y - 1 = 0 cuts the grid; between middles a plane is linear, so that every point lies on it.
  const ValueMap map = map_of({0.0, 0.5, 1.0}, {0.0, 1.0, 2.0}, [](double x, double y) { return 4.0 * x - y - 1.0; });
  const auto points = zero_points(value_map_svg(map));
  ASSERT_GE(points.size(), 4u);
  // From pixels back to the plane, through the places of two known points: (0.25, 0) and (0.75, 2) are on the line.
  const auto [low, high] = std::minmax_element(points.begin(), points.end());
  for (const auto& [px, py] : points) {
    const double along = (px - low->first) / (high->first - low->first);
    EXPECT_NEAR(py, low->second + along * (high->second - low->second), 0.3);  // texts have a tenth of a pixel
  }
  EXPECT_GT(low->second, high->second);  // y rises upwards
}

TEST(MapSvg, NoLineWhereTheSignStays) {
  const auto positive = [](double x, double y) { return 1.0 + x + y; };
  EXPECT_THAT(value_map_svg(map_of({0.0, 1.0}, {0.0, 1.0}, positive)), Not(HasSubstr("class=\"zero\"")));
}

TEST(MapSvg, OneCellOneRowOneValueOrNoneAreStillMaps) {
  const auto one = [](double, double) { return 3.0; };
  const auto none = [](double, double) { return std::nan(""); };
  for (const auto& map : {map_of({0.5}, {0.0}, one), map_of({0.0, 1.0}, {7.0}, one), map_of({0.0}, {0.0}, none)}) {
    const std::string svg = value_map_svg(map);
    EXPECT_THAT(svg, HasSubstr("</svg>"));
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
  }
}

}  // namespace
}  // namespace myotact::view
