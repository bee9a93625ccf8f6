#include <gtest/gtest.h>

#include "learn/elbow.h"
#include "learn/lesson_run.h"

namespace myotact::learn {
namespace {

bool names(const std::string& text, const char* key, const std::vector<std::string>& accept = {}) {
  return names_part(text, {anatomy::find_muscle(testing::elbow(), key), -1},
                    {testing::elbow(), testing::facts(), accept});
}

bool names_bone(const std::string& text) {
  return names_part(text, {-1, 3}, {testing::elbow(), testing::facts(), {}});
}

TEST(NamesPart, TakesLatinEnglishKeysAndTheShortFormsOfBooks) {
  EXPECT_TRUE(names("Biceps brachii", "biceps_brachii"));
  EXPECT_TRUE(names("  m. BICEPS   brachii ", "biceps_brachii"));
  EXPECT_TRUE(names("musculus biceps brachii", "biceps_brachii"));
  EXPECT_TRUE(names("biceps_brachii", "biceps_brachii"));
  EXPECT_TRUE(names("Triceps brachii, caput longum", "triceps_brachii_long"));
  EXPECT_TRUE(names("long head of triceps", "triceps_brachii_long", {"long head of triceps"}));
  EXPECT_TRUE(names_bone("Ulna"));
  EXPECT_TRUE(names_bone("Elbow bone"));
}

TEST(NamesPart, ForgivesASlipInALongWordOnly) {
  EXPECT_TRUE(names("bicepts brachii", "biceps_brachii"));
  EXPECT_TRUE(names("biceps brachi", "biceps_brachii"));
  EXPECT_TRUE(names("bicesp brachii", "biceps_brachii")) << "two swapped";
  EXPECT_FALSE(names("bbeps brachii", "biceps_brachii")) << "two letters of one word";
  EXPECT_TRUE(names("brachalis", "brachialis"));
  EXPECT_FALSE(names("bicep", "biceps_brachii"));
  EXPECT_FALSE(names_bone("una"));
}

TEST(NamesPart, OtherMusclesAndNothingAreWrong) {
  EXPECT_FALSE(names("", "brachialis"));
  EXPECT_FALSE(names(" . ", "brachialis"));
  EXPECT_FALSE(names("brachialis", "biceps_brachii"));
  EXPECT_FALSE(names("triceps brachii", "biceps_brachii"));
  EXPECT_FALSE(names("triceps brachii, lateral head", "triceps_brachii_medial"));
  EXPECT_FALSE(names(std::string(1'000'000, 'b'), "biceps_brachii"));
}

}  // namespace
}  // namespace myotact::learn
