#include "prepare/volume/segment_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace myotact::prepare {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

SegmentTable parse(const std::string& text) {
  return parse_segment_table(text, "t.csv");
}

TEST(SegmentTable, ReadsWhatSpreadsheetsSave) {
  for (const char separator : {',', ';', '\t'}) {
    std::string text =
        "\xef\xbb\xbfsegment,part,Kind\r\n\"odd, \"\"name\"\"\r\nin two lines\",femur,BONE\r\n\r\nfat,,ignore\r\n";
    std::replace(text.begin(), text.end(), ',', separator);
    const SegmentTable table = parse(text);
    ASSERT_EQ(table.rows.size(), 2U);
    EXPECT_EQ(table.rows[0].segment, std::string("odd") + separator + " \"name\"\r\nin two lines");
    EXPECT_EQ(table.rows[0].part, "femur");
    EXPECT_EQ(table.rows[0].kind, PartKind::Bone);
    EXPECT_EQ(table.rows[1].kind, PartKind::Ignore);
    EXPECT_EQ(table.rows[1].line, 5);
  }
}

TEST(SegmentTable, ComesBackAsItWasWritten) {
  SegmentTable table;
  table.rows.push_back({"a \"b\", c\nd", 3, 1, "biceps_brachii", PartKind::Muscle, "by; hand", 0});
  table.rows.push_back({"", 4, {}, "", PartKind::Ignore, "", 0});
  const SegmentTable read = parse(segment_table_text(table));
  ASSERT_EQ(read.rows.size(), 2U);
  EXPECT_EQ(read.rows[0].segment, table.rows[0].segment);
  EXPECT_EQ(read.rows[0].label, 3);
  EXPECT_EQ(read.rows[0].layer, 1);
  EXPECT_EQ(read.rows[0].note, "by; hand");
  EXPECT_EQ(read.rows[1].label, 4);
  EXPECT_EQ(read.rows[1].layer, std::nullopt);
}

TEST(SegmentTable, NamesLineColumnAndWhatIsAllowed) {
  const auto says = [](const std::string& text) { return ThrowsMessage<Error>(HasSubstr(text)); };
  EXPECT_THAT([] { parse(""); }, says("t.csv: is empty"));
  EXPECT_THAT([] { parse("segment,prt\n"); }, says("line 1: the column \"prt\" is not known; the columns are segment"));
  EXPECT_THAT([] { parse("part,kind\n"); }, says("segment or label"));
  EXPECT_THAT([] { parse("segment,part,part\n"); }, says("there twice"));
  EXPECT_THAT([] { parse("segment,part\na,\n"); }, says("line 2, column part: is empty"));
  EXPECT_THAT([] { parse("segment,part\n,femur\n"); }, says("line 2, column segment"));
  EXPECT_THAT([] { parse("label,part\n70000,femur\n"); }, says("\"70000\" must be 1 .. 65535"));
  EXPECT_THAT([] { parse("label,part,kind\n7,femur,bones\n"); }, says("must be bone, muscle or ignore"));
  EXPECT_THAT([] { parse("segment,part\nx,y\n\"never closed,z\n"); }, says("line 3: a quote is not closed"));
}

}  // namespace
}  // namespace myotact::prepare
