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

}  // namespace
}  // namespace myotact::view
