#include "learn/lesson_list.h"

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "learn/elbow.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::learn {
namespace {

using ::testing::HasSubstr;

class OwnLessons : public ::testing::Test {
 protected:
  OwnLessons() {
    setenv("XDG_DATA_HOME", folder_.path().c_str(), 1);
    std::filesystem::create_directories(own_lessons_folder());
  }
  ~OwnLessons() override { unsetenv("XDG_DATA_HOME"); }

  testing::TemporaryFolder folder_;
};

TEST_F(OwnLessons, AreListedAfterTheShippedOnesBrokenOnesWithTheirSentence) {
  const std::size_t shipped = list_lessons().size();
  EXPECT_GE(shipped, 5u);
  write_file(own_lessons_folder() / "a_quiz.json", testing::lesson_text(R"("points": 0)"));
  write_file(own_lessons_folder() / "b_cut.json", R"({"schema": 1, "key)");
  write_file(own_lessons_folder() / "notes.txt", "x");
  const auto lessons = list_lessons();
  ASSERT_EQ(lessons.size(), shipped + 2);
  EXPECT_EQ(lessons[shipped].head.key, "l");
  EXPECT_EQ(lessons[shipped].complaint, "");
  EXPECT_THAT(lessons[shipped + 1].complaint, HasSubstr("b_cut.json: 1:"));
}

TEST_F(OwnLessons, AreFoundByKeyFileNameAndPath) {
  const auto path = own_lessons_folder() / "a_quiz.json";
  write_file(path, testing::lesson_text(R"("points": 0)"));
  EXPECT_EQ(find_lesson("l"), path);
  EXPECT_EQ(find_lesson("a_quiz"), path);
  EXPECT_EQ(find_lesson(path.string()), path);
  const std::string complaint = testing::complaint(ExitStatus::NoInput, [] { find_lesson("2_pull_a_lin"); });
  EXPECT_THAT(complaint, HasSubstr("2_pull_a_lin: no such lesson"));
  EXPECT_THAT(complaint, HasSubstr("nearest: 2_pull_a_line"));
}

TEST_F(OwnLessons, TheShippedOnesComeInTheOrderOfTheirNumbers) {
  int last = 0;
  for (const ListedLesson& lesson : list_lessons()) {
    const int number = std::stoi(lesson.path.filename().string());
    EXPECT_EQ(number, last + 1);
    last = number;
  }
  EXPECT_GE(last, 12);
}

TEST(OwnLessonsFolder, IgnoresAPathThatIsNotAbsolute) {
  setenv("XDG_DATA_HOME", "here", 1);
  EXPECT_NE(own_lessons_folder(), std::filesystem::path("here/myotact/lessons"));
  unsetenv("XDG_DATA_HOME");
}

}  // namespace
}  // namespace myotact::learn
