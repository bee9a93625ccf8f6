#include "prepare/volume/map_segments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "prepare/recipe/read_recipe.h"
#include "support/source_folder.h"

namespace myotact::prepare {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::filesystem::path kCanine = std::filesystem::path(source_folder()) / "assets" / "canine";

const std::vector<KnownPart>& hindlimb() {
  static const std::vector<KnownPart> kKnown =
      known_parts(read_recipe(kCanine / "hindlimb.json"), anatomy::load_part_facts(kCanine / "names.json"));
  return kKnown;
}

std::vector<Segment> segments_named(const std::vector<std::string>& names) {
  std::vector<Segment> segments;
  for (const std::string& name : names) segments.push_back({name, static_cast<int>(segments.size()) + 1, 0, {}});
  return segments;
}

SegmentChoice choice_of(const std::string& name, const std::vector<std::string>& hints = {}) {
  return map_segments({{name, 1, 0, hints}}, hindlimb(), {}).choices[0];
}

TEST(MapSegments, KnowsEveryPartByEachOfItsNames) {
  for (const KnownPart& part : hindlimb()) {
    for (const std::string& name : {part.key, part.name_la, part.name_en}) {
      const SegmentChoice choice = choice_of(name);
      EXPECT_EQ(choice.key, part.key) << name;
      EXPECT_EQ(choice.kind, part.kind) << name;
    }
  }
}

TEST(MapSegments, OverlooksSideCaseBlanksAndWordsForMuscle) {
  for (const char* name : {"M. rectus femoris", "RECTUS_FEMORIS", "rectus-femoris (left)", "RectusFemoris",
                           "musc. rectus femoris sin.", "Rectus Femoris Muscle L", "femoris rectus"}) {
    EXPECT_EQ(choice_of(name).key, "rectus_femoris") << name;
  }
  EXPECT_EQ(choice_of("thigh bone").key, "femur");
  EXPECT_EQ(choice_of("Femur bone, left").key, "femur");
  EXPECT_EQ(choice_of("flexor_digitorum_profundus").key, "hind.flexor_digitorum_profundus");
  EXPECT_EQ(choice_of("Segment_1", {"Tibia", "Bone"}).key, "tibia");
  EXPECT_THAT(choice_of("Segment_1", {"Tibia"}).why, HasSubstr("hint"));
}

TEST(MapSegments, ListsUnknownNamesWithTheNearest) {
  const SegmentMap map = map_segments(segments_named({"femur", "rectus femoriss", "kneecap"}), hindlimb(), {});
  EXPECT_THAT(map.unknown, ElementsAre(1));
  EXPECT_EQ(map.choices[1].nearest.front(), "rectus_femoris");
  EXPECT_THAT([&] { require_all_known(map, "v.nrrd"); },
              ThrowsMessage<Error>(AllOf(HasSubstr("v.nrrd: segments: 1 of 3"),
                                         HasSubstr("\"rectus femoriss\" (label 2)"), HasSubstr("rectus_femoris"))));
}

TEST(MapSegments, ATableOfGuessesDecidesOnceItIsEdited) {
  const std::vector<Segment> segments = segments_named({"femur", "rectus femoriss", "blob"});
  SegmentTable table = table_of(map_segments(segments, hindlimb(), {}));
  EXPECT_EQ(table.rows[1].part, "rectus_femoris");
  EXPECT_THAT(table.rows[1].note, HasSubstr("guess"));
  table.rows[2].kind = PartKind::Ignore;
  table = parse_segment_table(segment_table_text(table), "t.csv");
  const SegmentMap map = map_segments(segments, hindlimb(), {table, {}, "left"});
  EXPECT_TRUE(map.unknown.empty());
  EXPECT_EQ(map.choices[1].key, "rectus_femoris");
  EXPECT_EQ(map.choices[2].kind, PartKind::Ignore);
  EXPECT_EQ(map.choices[2].key, "");
}

TEST(MapSegments, TheTableMustNameWhatIsThere) {
  const std::vector<Segment> segments = segments_named({"femur", "blob"});
  const auto map_with = [&](const std::string& rows) {
    map_segments(segments, hindlimb(), {parse_segment_table("segment,label,part,kind\n" + rows, "t.csv"), {}, ""});
  };
  const auto says = [](const std::string& text) { return ThrowsMessage<Error>(HasSubstr(text)); };
  EXPECT_THAT([&] { map_with("blop,,tibia,\n"); },
              says("t.csv: line 2: no segment of the volume is \"blop\"; the nearest is \"blob\""));
  EXPECT_THAT([&] { map_with(",9,tibia,\n"); }, says("label 9"));
  EXPECT_THAT([&] { map_with("blob,,tibiaa,\n"); }, says("\"tibiaa\" is no part of the recipe; the nearest are tibia"));
  EXPECT_THAT([&] { map_with("blob,,tibia,\n,2,fibula,\n"); }, says("a second time, after line 2"));
  EXPECT_THAT([&] { map_with("blob,,femur,\n"); }, says("femur: is both \"femur\" (label 1) (by key) and \"blob\""));
}

TEST(MapSegments, KeepsTheLimbsOwnSideOfTwo) {
  const SegmentMap map =
      map_segments(segments_named({"femur right", "femur left", "tibia right"}), hindlimb(), {{}, {}, "left"});
  EXPECT_EQ(map.choices[0].kind, PartKind::Ignore);
  EXPECT_EQ(map.choices[1].key, "femur");
  EXPECT_EQ(map.choices[2].key, "tibia");  // the only one
  EXPECT_THAT(map.notes, ElementsAre(HasSubstr("of the other side")));
}

TEST(MapSegments, WithoutARecipeTellsBonesFromMusclesByWordsHintsAndBones) {
  std::vector<Segment> segments =
      segments_named({"Os coxae", "M. gluteus medius", "flexor carpi radialis", "skin", "part A", "part B", "C", "D"});
  segments[4].hints = {"Bone"};
  segments[5].hints = {"Muscle"};
  const SegmentMap map = map_segments(segments, {}, {{}, {"c"}, ""});
  std::vector<std::string> got;
  for (const SegmentChoice& choice : map.choices) got.push_back(text_of(choice.kind) + " " + choice.key);
  EXPECT_THAT(got, ElementsAre("bone os_coxae", "muscle gluteus_medius", "muscle flexor_carpi_radialis", "ignore ",
                               "bone part_a", "muscle part_b", "bone c", "muscle d"));
  EXPECT_FALSE(map.choices[7].kind_is_certain);
  EXPECT_THAT(map.notes, ElementsAre(HasSubstr("skin"), HasSubstr("\"D\" (label 8): nothing says bone or muscle")));
}

TEST(MapSegments, KeysThatItMakesDiffer) {
  const SegmentMap map =
      map_segments(segments_named({"blob", "Blob!", "\xd0\xba\xd0\xbe\xd1\x81\xd1\x82\xd1\x8c"}), {}, {});
  EXPECT_EQ(map.choices[0].key, "blob");
  EXPECT_EQ(map.choices[1].key, "blob_2");
  EXPECT_EQ(map.choices[2].key, "label_3");
}

TEST(MapSegments, BonesMustNameSegments) {
  EXPECT_THAT(
      [] {
        map_segments(segments_named({"blob"}), {}, {{}, {"blib"}, ""});
      },
      ThrowsMessage<Error>(HasSubstr("--bones: no segment is named \"blib\"; the nearest is \"blob\"")));
}

}  // namespace
}  // namespace myotact::prepare
