// `myotact stiffness` as its users run it: files left, parts joined, bad input refused, interruption.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> kFiles = {"stiffness.csv", "stiffness.json", "stiffness.svg", "stiffness_map.svg"};
/// A preview is some four times faster, and what is tested here does not depend on the tissue's model.
const std::string kFast = " --set 'tissue={\"default\": \"mass_spring\"}' --log-level info";

std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class Stiffness : public ::testing::Test {
 protected:
  std::string out(const std::string& name = "out") const { return fmt::format(" --out {}", file(name)); }
  std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
  std::vector<std::string> files_in(const std::string& name) const {
    std::vector<std::string> bytes;
    for (const std::string& left : kFiles) bytes.push_back(content(folder_.path() / name / left));
    return bytes;
  }
  TemporaryFolder folder_;
};

TEST_F(Stiffness, LeavesTheSameFilesWithAnyNumberOfThreadsAndInParts) {
  const std::string sweep = "stiffness elbow --angles -5:5:5 --levels 0:0.5:1" + kFast;
  ASSERT_EQ(run_program(sweep + out("one") + " --workers 1").status, 0);
  ASSERT_EQ(run_program(sweep + out("three") + " --workers 3", "LC_ALL=de_DE.UTF-8").status, 0);
  for (const char* part : {"1/4", "2/4", "3/4", "4/4"}) {
    ASSERT_EQ(run_program(sweep + out("parts") + " --shard " + part).status, 0) << part;
  }
  std::string merge = "stiffness --merge";
  for (const char* part : {"3", "1", "4", "2"})
    merge += fmt::format(" {}{}_of_4.json", file("parts/stiffness_part_"), part);
  const Outcome merged = run_program(merge + out("merged"));
  ASSERT_EQ(merged.status, 0) << merged.output;
  const auto single = files_in("one");
  EXPECT_EQ(files_in("three"), single);
  EXPECT_EQ(files_in("merged"), single);
  EXPECT_THAT(merged.output, HasSubstr(single[0]));  // the table is on standard output too
  EXPECT_EQ(std::count(single[0].begin(), single[0].end(), '\n'), 1 + 9);
  EXPECT_THAT(single[0], HasSubstr("\nelbow,-0.08726646259971647,0.5,0,"));
  EXPECT_THAT(single[2], AllOf(HasSubstr("q = -5 deg"), HasSubstr("<polygon"), HasSubstr("</svg>")));
  EXPECT_THAT(single[3], AllOf(HasSubstr("joint stiffness K [N m/rad]"), HasSubstr("<title>0.5, -5: ")));
  const auto rows = nlohmann::json::parse(single[1]);
  ASSERT_EQ(rows.size(), 9u);
  EXPECT_EQ(rows[0].at("band").size(), 4u);
  EXPECT_EQ(rows[0].at("muscles").size(), 7u);
  EXPECT_THAT(rows[0].at("why").get<std::string>(), HasSubstr("N m/rad"));
}

TEST_F(Stiffness, SaysWhyOnceAnAngleAndKeepsQuietWhenAsked) {
  const std::string sweep = "stiffness elbow --angles 0,5 --levels 0,1 --set 'tissue={\"default\": \"mass_spring\"}'";
  const Outcome told = run_program(sweep + out());
  EXPECT_THAT(told.output,
              AllOf(HasSubstr("elbow at 0 deg, co-contraction 1: K = "),
                    HasSubstr("elbow at 5 deg, co-contraction 1: K = "), Not(HasSubstr("co-contraction 0: K"))));
  const Outcome quiet = run_program(sweep + out() + " --json --log-level off");
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(nlohmann::json::parse(quiet.output).size(), 4u);  // standard error is empty
}

TEST_F(Stiffness, AnotherJointIsDrivenByItsGroups) {
  const std::string rigid = " --set 'tissue={\"default\": \"rigid\"}'";
  const Outcome outcome =
      run_program("stiffness elbow --set specimen=canine_hindlimb --set co_contraction=null" + out());
  EXPECT_EQ(outcome.status, 65) << outcome.output;
  const std::string hind = file("hind.json");
  std::ofstream(hind) << R"({"schema": 1, "name": "hind", "specimen": "canine_hindlimb"})";
  const std::string sweep = fmt::format("stiffness {}{}{} --levels 0 ", hind, rigid, out());
  EXPECT_EQ(run_program(sweep).status, 65);
  const Outcome tarsus = run_program(sweep + "--joint tarsus --angles 10");
  EXPECT_EQ(tarsus.status, 0) << tarsus.output;
  EXPECT_THAT(tarsus.output, HasSubstr("\ntarsus,0.17453292519943295,0,"));
  EXPECT_THAT(run_program(sweep + "--joint hip").output, HasSubstr("joints of"));
  EXPECT_EQ(run_program(sweep + "--joint knee").status, 2);
}

TEST_F(Stiffness, LeavesOutAnglesThatTheJointCannotTake) {
  const Outcome some = run_program("stiffness elbow --angles -30:30:30 --levels 0 --set tissue.default=line" + out());
  EXPECT_EQ(some.status, 0);
  EXPECT_THAT(some.output,
              HasSubstr("-30 is outside the range of the joint elbow, -12.03 .. 100.27 degrees; left out"));
  EXPECT_THAT(content(folder_.path() / "out" / "stiffness.csv"), HasSubstr("elbow,0.5235987755982988,"));
}

TEST_F(Stiffness, RefusesWhatCannotBeMeasuredByName) {
  const auto refused = [&](const std::string& more) {
    const Outcome outcome = run_program(fmt::format("stiffness elbow {}{}", more, out()));
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    return outcome.output;
  };
  EXPECT_THAT(refused("--angles -30:10:-20"),
              HasSubstr("--angles: -30, -20 is outside the range of the joint elbow, -12.03 .. 100.27 degrees"));
  EXPECT_THAT(refused("--angles 200"), HasSubstr("--angles: 200 is outside"));
  EXPECT_THAT(refused("--angles 10:5:0"), HasSubstr("descends"));
  EXPECT_THAT(refused("--angles ten"), HasSubstr("\"ten\" is not a number"));
  EXPECT_THAT(refused("--levels 0:0.5:1.5"), HasSubstr("1.5 is no level"));
  EXPECT_THAT(refused("--levels -0.1"), HasSubstr("must be in 0 .. 1"));
  EXPECT_THAT(refused("--joint elbo"), HasSubstr("nearest: elbow"));
  for (const char* shard : {"0/4", "5/4", "1", "1/", "/4", "a/b", "1.5/4", "1/0", "1/100000", "-1/4"}) {
    EXPECT_THAT(refused(std::string("--shard ") + shard), HasSubstr("--shard")) << shard;
  }
  EXPECT_THAT(refused("--shard 1/2 --merge x.json"), HasSubstr("give one of them"));
  EXPECT_EQ(run_program("run elbow --levels 2" + out()).status, 2);
  EXPECT_EQ(run_program(fmt::format("stiffness --merge {}{}", file("nothing.json"), out())).status, 66);
}

TEST_F(Stiffness, ArrayScriptMeasuresItsPart) {
  const std::string environment = "SLURM_ARRAY_TASK_COUNT=2 MYOTACT=" MYOTACT_PROGRAM " SLURM_ARRAY_TASK_ID=";
  const std::string script =
      " sh " + source_folder() + "/tools/stiffness_array.slurm elbow --levels 0,1" + kFast + out();
  ASSERT_EQ(std::system((environment + "1" + script + " >/dev/null 2>&1").c_str()), 0);
  ASSERT_EQ(std::system((environment + "2" + script + " >/dev/null 2>&1").c_str()), 0);
  const std::string parts = fmt::format("{0}1_of_2.json {0}2_of_2.json", file("out/stiffness_part_"));
  const Outcome merged = run_program(fmt::format("stiffness --merge {}{}", parts, out()));
  EXPECT_EQ(merged.status, 0) << merged.output;
  EXPECT_THAT(merged.output, HasSubstr("\nelbow,0,1,0,"));
  EXPECT_NE(std::system(("env -u SLURM_ARRAY_TASK_ID" + script + " >/dev/null 2>&1").c_str()), 0);
}

TEST_F(Stiffness, InterruptedSweepEndsWith130AndLeavesNothing) {
  const std::string sweep = "stiffness elbow --angles -10:1:10 --levels 0:0.01:1" + out();
  // In the background of a shell, so that its own exit status is seen; SIGINT must not be ignored there.
  const std::string script = folder_.path().string() + "/interrupt.sh";
  std::ofstream(script) << "set -m\n" MYOTACT_PROGRAM " " << sweep
                        << " >/dev/null 2>&1 &\nsleep 3\nkill -INT $!\nwait $!\n";
  const int status = std::system(("bash " + script + " 2>/dev/null").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "out"));
}

}  // namespace
}  // namespace myotact::testing
