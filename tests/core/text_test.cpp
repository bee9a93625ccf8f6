#include "core/text.h"

#include <clocale>
#include <cmath>
#include <limits>
#include <locale>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/json_reader.h"

namespace myotact {
namespace {

TEST(Text, NumbersReadBackToTheSameBits) {
  for (const double value : {0.0, -0.0, 1.0 / 3.0, 0.1, 1e-308, 4.9e-324, std::numeric_limits<double>::max()}) {
    const auto back = parse_number(to_text(value));
    ASSERT_TRUE(back);
    EXPECT_EQ(*back, value);
    EXPECT_EQ(std::signbit(*back), std::signbit(value));
  }
  EXPECT_EQ(to_text(0.1), "0.1");
}

TEST(Text, OnlyAWholeNumberIsANumber) {
  EXPECT_EQ(parse_number("+2.5"), 2.5);
  for (const char* text : {"", " 1", "1 ", "1,5", "1.5x", "++1", "+-1", "0x10", "one"}) {
    EXPECT_FALSE(parse_number(text)) << text;
  }
}

/// As in Germany: comma before the decimals, points between thousands.
struct CommaDecimals : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(Text, TheLocaleDoesNotMatter) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaDecimals));
  std::setlocale(LC_ALL, "de_DE.UTF-8");  // no effect where that locale is not installed; the one above stays
  EXPECT_EQ(to_text(1234.5), "1234.5");
  EXPECT_EQ(parse_number("1234.5"), 1234.5);
  EXPECT_EQ(parse_json("[1234.5]", "f")[0].get<double>(), 1234.5);
  std::setlocale(LC_ALL, "C");
  std::locale::global(before);
}

TEST(Text, NearestWordForgivesTypingErrors) {
  const std::vector<std::string> keys = {"biceps_brachii", "brachialis", "anconeus"};
  EXPECT_EQ(nearest_word("bicep_brachi", keys), "biceps_brachii");
  EXPECT_EQ(nearest_word("brachalis", keys), "brachialis");
  EXPECT_EQ(nearest_word("bicep", keys), "biceps_brachii");
  EXPECT_EQ(nearest_word("x", {}), "");
  EXPECT_EQ(nearest_word(std::string(10'000'000, 'a'), keys).empty(), false);  // NOLINT(bugprone-string-constructor)
}

TEST(Text, LowerLeavesWhatIsNoCapitalOfAscii) {
  EXPECT_EQ(lower("ENDsolid [@Z] \xc3\x84"), "endsolid [@z] \xc3\x84");
}

TEST(Text, WordsAreSplitAtBlanks) {
  const auto words = words_of("  vertex\t1 2  3\r");
  ASSERT_EQ(words.size(), 4u);
  EXPECT_EQ(words[0], "vertex");
  EXPECT_EQ(words[3], "3");
  EXPECT_TRUE(words_of(" \t").empty());
  EXPECT_EQ(join(std::vector<std::string>{"a", "b"}), "a, b");
}

TEST(Text, MarkupIsEscaped) {
  EXPECT_EQ(escape_markup("a < b && \"c\" > d"), "a &lt; b &amp;&amp; &quot;c&quot; &gt; d");
}

}  // namespace
}  // namespace myotact
