#include "core/number_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string complaint(const std::string& text) {
  try {
    parse_number_list("--levels", text);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Usage);
    return error.what();
  }
  return "";
}

TEST(NumberList, TakesCommasAndRangesWithBothEnds) {
  EXPECT_THAT(parse_number_list("--angles", "-10,0,+5.5,1e1"), ElementsAre(-10.0, 0.0, 5.5, 10.0));
  EXPECT_THAT(parse_number_list("--angles", "-30:10:10"), ElementsAre(-30.0, -20.0, -10.0, 0.0, 10.0));
  EXPECT_THAT(parse_number_list("--angles", "0:0.5:1,7"), ElementsAre(0.0, 0.5, 1.0, 7.0));
  EXPECT_THAT(parse_number_list("--angles", "3:1:3"), ElementsAre(3.0));
}

TEST(NumberList, DecimalsOfARangeAreTheOnesThatReadersType) {
  const auto levels = parse_number_list("--levels", "0:0.1:1");
  ASSERT_EQ(levels.size(), 11u);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::string typed = i == 10 ? "1" : "0." + std::to_string(i);
    EXPECT_EQ(levels[i], parse_number(typed)) << typed;  // 3 * 0.1 would not be
  }
  const auto fine = parse_number_list("--levels", "-0.003:0.001:0.003");
  EXPECT_EQ(fine.front(), -0.003);
  EXPECT_EQ(fine[3], 0.0);
  EXPECT_EQ(fine.back(), 0.003);
}

TEST(NumberList, SaysWhatIsWrong) {
  EXPECT_THAT(complaint("1:0.1:0"), HasSubstr("--levels 1:0.1:0: \"1:0.1:0\" descends; write 0:0.1:1"));
  EXPECT_THAT(complaint("0:0:1"), HasSubstr("step"));
  EXPECT_THAT(complaint("0:-0.1:1"), HasSubstr("must be above 0"));
  EXPECT_THAT(complaint("0:0.3:1"), HasSubstr("miss its last value"));
  EXPECT_THAT(complaint("0:1"), HasSubstr("first:step:last"));
  EXPECT_THAT(complaint("0:1:2:3"), HasSubstr("first:step:last"));
  EXPECT_THAT(complaint("0:1e-1:1"), HasSubstr("decimal number"));
  EXPECT_THAT(complaint("0:0.00000000000001:1"), HasSubstr("digits"));
  EXPECT_THAT(complaint("0:0.000001:1"), HasSubstr("more than 10000 values"));
  for (const char* text : {"", ",", "0,,1", "a", "nan", "inf", "0:1:", "::", "0 1", "1.2.3", "--1", ".:1:2"}) {
    EXPECT_NE(complaint(text), "") << text;
  }
}

}  // namespace
}  // namespace myotact
