#include "measure/validation/report.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myotact::measure {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<CaseResult> results() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {{"good",
           "A good one",
           "book",
           {compare({"period_s", Expectation::Value, 2.0, 0.5, "book"}, 2.25),
            compare({"coarse_s", Expectation::Reported, 0.0, 0.0, "to compare"}, 2.5)}},
          {"bad",
           "A <bad> one",
           "a & b",
           {compare({"order", Expectation::AtLeast, 2.0, 0.0, "a & b"}, 1.5),
            compare({"gain", Expectation::AtMost, 1e-12, 0.0, ""}, nan)}}};
}

TEST(ValidationReport, TableHasALineACheck) {
  const std::string table = validation_table(results());
  EXPECT_THAT(table, HasSubstr("good  period_s  2         2.25      0.25   0.5        pass      book\n"));
  EXPECT_THAT(table, HasSubstr("bad   order     >= 2      1.5       0.5    -          FAIL      a & b\n"));
  EXPECT_THAT(table, HasSubstr("bad   gain      <= 1e-12  nan"));
  EXPECT_THAT(table, HasSubstr("good  coarse_s  -         2.5       -      -          reported  to compare\n"));
  EXPECT_THAT(table, HasSubstr("3 checks in 2 cases, 2 failed; 1 reported only\n"));
}

TEST(ValidationReport, TheTableHasOnlyTheBeginningOfALongSource) {
  auto long_one = results();
  long_one[0].checks[0].check.source =
      "a paper whose title goes on and on, in a journal of long names, volume 1, page 2";
  EXPECT_THAT(validation_table(long_one),
              HasSubstr("  a paper whose title goes on and on, in a journal of long ...\n"));
}

TEST(ValidationReport, JsonHasNumbersAndNull) {
  const auto json = nlohmann::json::parse(validation_json(results()));
  EXPECT_EQ(json.at("schema"), 1);
  EXPECT_EQ(json.at("passed"), false);
  EXPECT_EQ(json.at("cases").at(0).at("passed"), true);
  const auto& good = json.at("cases").at(0).at("checks").at(0);
  EXPECT_EQ(good.at("value"), 2.0);
  EXPECT_EQ(good.at("obtained"), 2.25);
  EXPECT_EQ(good.at("source"), "book");
  EXPECT_EQ(good.at("passed"), true);
  const auto& reported = json.at("cases").at(0).at("checks").at(1);
  EXPECT_EQ(reported.at("reported"), true);
  EXPECT_EQ(reported.at("obtained"), 2.5);
  EXPECT_TRUE(reported.at("passed").is_null());
  EXPECT_FALSE(reported.contains("error"));
  const auto& bad = json.at("cases").at(1).at("checks");
  EXPECT_EQ(bad.at(0).at("at_least"), 2.0);
  EXPECT_TRUE(bad.at(1).at("obtained").is_null());
}

TEST(ValidationReport, PageNeedsNothingButItself) {
  const std::string page = validation_html(results());
  EXPECT_THAT(page, HasSubstr("1 of 2 cases pass. <span class=\"fail\">FAIL: bad</span>"));
  EXPECT_THAT(page, HasSubstr("A &lt;bad&gt; one"));
  EXPECT_THAT(page, HasSubstr("<p class=\"source\">a &amp; b</p>"));
  EXPECT_THAT(page, Not(HasSubstr("<td class=\"source\">a &amp; b</td>")));  // once is enough
  EXPECT_THAT(page, HasSubstr("<td class=\"source\">to compare</td>"));
  EXPECT_THAT(page, HasSubstr("<td>reported</td>"));
  EXPECT_THAT(page, HasSubstr("width=\"100.0\""));  // half of the tolerance used
  EXPECT_THAT(page, HasSubstr("width=\"300.0\""));  // a failed bound
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, Not(HasSubstr("href=")));
}

}  // namespace
}  // namespace myotact::measure
