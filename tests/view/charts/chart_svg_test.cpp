#include "view/charts/chart_svg.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myotact::view {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ChartSvg, TicksAreRoundAndCoverTheRange) {
  EXPECT_EQ(round_ticks(0.0, 1.0, 5), (std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
  const auto ticks = round_ticks(-0.7, 6.1, 6);
  EXPECT_LE(ticks.front(), -0.7);
  EXPECT_GE(ticks.back(), 6.1);
}

TEST(ChartSvg, EscapesTextAndLeavesOutWhatIsNotANumber) {
  const Chart chart{"a < b & c", "x [m]", "y [N]", {{"one", {0.0, 1.0, 2.0}, {1.0, std::nan(""), 3.0}}}};
  const std::string svg = line_chart_svg(chart);
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

/// Of any range, from that of a picometre to that of a planet.
TEST(ChartSvg, TicksOfAnyRangeAreFewRoundAndOutsideOfIt) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> power(-11.0, 7.0), share(-1.0, 1.0);
  for (int round = 0; round < 2000; ++round) {
    const double size = std::pow(10.0, power(random)), lowest = size * share(random);
    const double highest = lowest + size * (0.05 + std::abs(share(random)));
    const auto ticks = round_ticks(lowest, highest, 6);
    ASSERT_GE(ticks.size(), 2u);
    ASSERT_LE(ticks.size(), 8u) << lowest << " " << highest;  // six steps, and a part of one at either end
    const double step = ticks[1] - ticks[0];
    ASSERT_LE(ticks.front(), lowest + 1e-6 * step);
    ASSERT_GE(ticks.back(), highest - 1e-6 * step);
    ASSERT_GT(ticks[1], lowest) << "a step for nothing";
    const double digits = step / std::pow(10.0, std::floor(std::log10(step * (1.0 + 1e-9))));
    const bool is_round =
        std::abs(digits - 1.0) < 1e-6 || std::abs(digits - 2.0) < 1e-6 || std::abs(digits - 5.0) < 1e-6;
    ASSERT_TRUE(is_round) << step;
    for (std::size_t i = 1; i < ticks.size(); ++i) ASSERT_NEAR(ticks[i] - ticks[i - 1], step, 1e-6 * step);
  }
}

/// Where the markers of a chart are, in pixels.
std::vector<std::pair<double, double>> markers_in(const std::string& svg) {
  const std::regex circle("<circle cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\" r=\"3\"");
  std::vector<std::pair<double, double>> places;
  for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it) {
    places.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  }
  return places;
}

TEST(ChartSvg, OnePointAConstantAndWhatHasNoNumbersAreStillCharts) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<double>> values = {
      {7.25},         {-3.0, -3.0, -3.0},         {0.0, 0.0}, {1e-9, 2e-9}, {-1e9, 1e9}, {std::nan(""), 4.0},
      {kInfinity, 1}, {-kInfinity, std::nan("")}, {}};
  for (const auto& y : values) {
    std::vector<double> x(y.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 10.0 + static_cast<double>(i);
    const std::string svg = line_chart_svg({"t", "x", "y", {{"", x, y}}});
    EXPECT_THAT(svg, Not(HasSubstr("nan")));
    EXPECT_THAT(svg, Not(HasSubstr("inf")));
    const auto places = markers_in(svg);
    const auto known = std::count_if(y.begin(), y.end(), [](double value) { return std::isfinite(value); });
    EXPECT_EQ(places.size(), static_cast<std::size_t>(known));
    for (const auto& [px, py] : places) {
      EXPECT_TRUE(px >= 0.0 && px <= 960.0 && py >= 0.0 && py <= 460.0) << px << " " << py;  // of the document
    }
  }
}

TEST(ChartSvg, PointsLieInProportion) {
  const auto places = markers_in(line_chart_svg({"t", "x", "y", {{"", {0.0, 2.0, 8.0}, {0.0, -1.0, 3.0}}}}));
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NEAR(places[2].first - places[0].first, 4.0 * (places[1].first - places[0].first), 0.5);
  EXPECT_NEAR(places[0].second - places[2].second, 3.0 * (places[1].second - places[0].second), 0.5);
  EXPECT_GT(places[1].second, places[0].second) << "less is further down";
}

TEST(ChartSvg, EmptyChartIsStillADocument) {
  EXPECT_THAT(line_chart_svg({"", "", "", {}}), HasSubstr("</svg>"));
}

TEST(ChartSvg, DrawsBandsStrokesAndALegendOfNamedSeriesOnly) {
  ChartSeries banded{"named", {0.0, 1.0}, {1.0, 2.0}};
  banded.low = {0.5, -4.0};
  banded.high = {1.5, std::nan("")};
  const ChartSeries rings{"", {0.0, 1.0}, {1.0, 2.0}, Stroke::Rings};
  const ChartSeries dashed{"", {0.0, 1.0}, {1.0, 2.0}, Stroke::Dashed};
  const std::string svg = line_chart_svg({"t", "x", "y", {banded, rings, dashed}});
  EXPECT_THAT(svg, HasSubstr("<polygon"));
  EXPECT_THAT(svg, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(svg, HasSubstr(">named</text>"));
  EXPECT_THAT(svg, HasSubstr(">-4</text>"));  // the axis reaches to the end of the band
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("></text>")));
}

}  // namespace
}  // namespace myotact::view
