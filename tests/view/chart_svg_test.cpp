#include "view/chart_svg.h"

#include <cmath>
#include <limits>

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
