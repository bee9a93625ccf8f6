// The program myotact-prepare from outside: exit statuses, what it writes and what it leaves behind.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/exit_status.h"
#include "core/file.h"
#include "support/source_folder.h"

namespace myotact::prepare {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class Program : public ::testing::Test {
 protected:
  Program() {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "scan" / "bones");
    fs::create_directories(folder_ / "scan" / "muscles");
  }
  ~Program() override { fs::remove_all(folder_); }

  /// Exit status; standard error goes to error_.
  int run(const std::string& arguments) {
    const fs::path log = folder_ / "stderr";
    const std::string command =
        std::string(MYOTACT_PREPARE) + " " + arguments + " >" + (folder_ / "stdout").string() + " 2>" + log.string();
    const int status = std::system(command.c_str());
    error_ = read_file(log);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  std::string scan() const { return (folder_ / "scan").string(); }
  std::string specimen() const { return (folder_ / "specimen").string(); }
  void put(const std::string& file, const std::string& bytes) const {
    std::ofstream(folder_ / "scan" / file, std::ios::binary) << bytes;
  }

  /// Nothing but the scan and the logs.
  bool nothing_left_behind() const {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name != "scan" && name != "stdout" && name != "stderr") return false;
    }
    return true;
  }

  fs::path folder_ = fs::path(::testing::TempDir()) /
                     (std::string("prepare_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  std::string error_;
};

int status(ExitStatus value) {
  return static_cast<int>(value);
}

TEST_F(Program, RefusesAnUnknownOptionAsUsage) {
  EXPECT_EQ(run("--frobnicate"), status(ExitStatus::Usage));
  EXPECT_EQ(run(""), status(ExitStatus::Usage));
}

TEST_F(Program, SaysItsVersion) {
  EXPECT_EQ(run("--version"), status(ExitStatus::Done));
  EXPECT_THAT(read_file(folder_ / "stdout"), MatchesRegex("[0-9]+[.][0-9]+[.][0-9]+\n"));
}

TEST_F(Program, SaysThatTheScanIsNotThere) {
  EXPECT_EQ(run(scan() + "/nowhere -o " + specimen()), status(ExitStatus::NoInput));
  EXPECT_THAT(error_, HasSubstr("nowhere"));
  EXPECT_TRUE(nothing_left_behind());
}

TEST_F(Program, SaysThatAnEmptyFolderHoldsNoSurface) {
  EXPECT_EQ(run(scan() + " -o " + specimen()), status(ExitStatus::NoInput));
  EXPECT_THAT(error_, HasSubstr("humerus"));
  EXPECT_TRUE(nothing_left_behind());
}

TEST_F(Program, RefusesAFileThatIsNoMesh) {
  put("bones/humerus.stl",
      "this is a letter and not a bone, whatever its name may say; it is long enough to hold a header "
      "of an STL file and then some more text");
  put("muscles/brachialis.stl", "");
  EXPECT_EQ(run(scan() + " -o " + specimen()), status(ExitStatus::BadData));
  EXPECT_THAT(error_, HasSubstr("humerus.stl"));
  EXPECT_TRUE(nothing_left_behind());
}

TEST_F(Program, RefusesAScanOfBonesAlone) {
  std::string octahedron = "v 0.02 0 0\nv 0 0.02 0\nv -0.02 0 0\nv 0 -0.02 0\nv 0 0 0.02\nv 0 0 -0.02\n";
  octahedron += "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 1 6\nf 3 2 6\nf 4 3 6\nf 1 4 6\n";
  put("one.obj", octahedron);
  EXPECT_EQ(run(scan() + "/one.obj --bones one --units m -o " + specimen()), status(ExitStatus::BadData)) << error_;
  EXPECT_THAT(error_, HasSubstr("no muscle"));
  EXPECT_THAT(error_, HasSubstr("--bones"));
  EXPECT_TRUE(nothing_left_behind());
}

TEST_F(Program, StopsAfterAStageWithAScanThatCanBePreparedFurther) {
  const std::string recipe = source_folder() + "/assets/canine/hindlimb.json";
  const fs::path read = folder_ / "read", repaired = folder_ / "repaired";
  ASSERT_EQ(run("loft " + recipe + " --until read -o " + read.string()), status(ExitStatus::Done)) << error_;
  ASSERT_EQ(run(read.string() + " --until repair -o " + repaired.string()), status(ExitStatus::Done)) << error_;
  for (const char* file : {"bones/femur.ply", "muscles/gracilis.ply", "stage.jsonl"}) {
    EXPECT_TRUE(fs::exists(repaired / file)) << file;
  }
  EXPECT_FALSE(fs::exists(repaired / "specimen.json"));
  EXPECT_EQ(read_file(repaired / "bones/femur.ply"), read_file(read / "bones/femur.ply"));  // was clean
  EXPECT_EQ(run(read.string() + " --until nowhere -o " + scan()), status(ExitStatus::Usage));
  EXPECT_THAT(error_, HasSubstr("tetrahedralise"));
}

TEST_F(Program, SaysThatItCannotWrite) {
  put("blocker", "a file where a folder is wanted");
  const std::string assets = source_folder() + "/assets/canine";
  EXPECT_EQ(run("loft " + assets + " -o " + scan() + "/blocker/specimen"), status(ExitStatus::InputOutput));
  EXPECT_THAT(error_, HasSubstr("blocker"));
  EXPECT_TRUE(nothing_left_behind());
}

}  // namespace
}  // namespace myotact::prepare
