#include "anatomy/name_search.h"

#include <gtest/gtest.h>

#include "core/data_folder.h"

namespace myotact::anatomy {
namespace {

class NameSearch : public ::testing::Test {
 protected:
  std::string first(const std::string& text) const {
    const auto found = find_parts(specimen_, facts_, text);
    if (found.empty()) return "";
    const auto index = static_cast<std::size_t>(found.front().index);
    return found.front().bone ? specimen_.bones[index].key : specimen_.muscles[index].key;
  }

  Specimen specimen_ = load_specimen(data_folder() / "meshes" / "canine_forelimb");
  FactsByKey facts_ = load_part_facts(data_folder() / "assets" / "canine" / "names.json");
};

TEST_F(NameSearch, FindsByAnyNameAndThroughSlips) {
  for (const char* text : {"biceps", "bicps", "Biceps brachii", "brachii biceps", "bicesp", "musculus biceps",
                           "biceps_brachii", "two-headed", "BICEP"}) {
    EXPECT_EQ(first(text), "biceps_brachii") << text;
  }
  EXPECT_EQ(first("shoulder blade"), "scapula");
  EXPECT_EQ(first("sholder blade"), "scapula");
  EXPECT_EQ(first("ulnaris lateralis"), "extensor_carpi_ulnaris");
  EXPECT_EQ(first("anconaeus"), "anconeus");
  EXPECT_EQ(first("paw"), "manus");
  EXPECT_EQ(first("supraspnatus"), "supraspinatus");
}

TEST_F(NameSearch, FindsNothingForWhatIsNotThere) {
  for (const char* text : {"", " ,;- ", "gluteus", "xyz", "qq"}) EXPECT_EQ(first(text), "") << text;
  EXPECT_EQ(first(std::string(100000, 'b')), "");
}

TEST_F(NameSearch, APartTypedWholeComesBeforeOneThatHoldsTheWord) {
  EXPECT_EQ(first("radius"), "radius");
  EXPECT_EQ(first("teres minor"), "teres_minor");
  const auto triceps = find_parts(specimen_, facts_, "triceps");
  ASSERT_GE(triceps.size(), 5u);  // its heads in this specimen; then what differs by two letters
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(specimen_.muscles[static_cast<std::size_t>(triceps[i].index)].key.starts_with("triceps")) << i;
  }
}

TEST_F(NameSearch, AllPartsOfTheLimbsHaveFacts) {
  for (const char* folder : {"canine_elbow", "canine_forelimb", "canine_hindlimb"}) {
    const Specimen specimen = load_specimen(data_folder() / "meshes" / folder);
    for (const Muscle& muscle : specimen.muscles)
      EXPECT_FALSE(facts_of(facts_, muscle.key).action.empty()) << muscle.key;
    for (const Bone& bone : specimen.bones) EXPECT_FALSE(facts_of(facts_, bone.key).region.empty()) << bone.key;
  }
}

TEST(TypingSlips, AreThoseOfOptimalStringAlignment) {
  // Worked by hand: one deletion, one swap, three of "kitten" to "sitting", three of "CA" to "ABC".
  EXPECT_EQ(typing_slips("bicps", "biceps"), 1);
  EXPECT_EQ(typing_slips("bicesp", "biceps"), 1);
  EXPECT_EQ(typing_slips("kitten", "sitting"), 3);
  EXPECT_EQ(typing_slips("ca", "abc"), 3);
  EXPECT_EQ(typing_slips("", "abc"), 3);
}

}  // namespace
}  // namespace myotact::anatomy
