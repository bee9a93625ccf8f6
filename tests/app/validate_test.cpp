// The command validate: its exit statuses, its filter and what it leaves.

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

class Validate : public ::testing::Test {
 protected:
  /// A data folder whose only cases are those put into it.
  Validate() {
    for (const char* part : {"shaders", "assets"}) std::filesystem::create_directory(folder_.path() / part);
  }
  void put(const std::string& name, const std::string& expected) {
    std::filesystem::create_directories(folder_.path() / "tests" / "validation");
    std::ofstream(folder_.path() / "tests" / "validation" / (name + ".json"))
        << R"({"schema": 1, "kind": "oscillator", "title": "t", "source": "s", "rule": "trapezoid", "frequency_hz": 5,
               "dt_s": 0.01, "checks": [{"quantity": "amplitude_kept_per_period", )"
        << expected << "}]}";
  }
  Outcome validate(const std::string& arguments) {
    return run_program("validate " + arguments, "MYOTACT_DATA_DIR=" + folder_.path().string());
  }

  TemporaryFolder folder_;
};

TEST_F(Validate, PassesAndFailsByExitStatus) {
  put("kept", R"("value": 1, "absolute": 1e-6)");
  EXPECT_EQ(validate("").status, 0);
  put("lost", R"("at_most": 0.5)");
  const Outcome outcome = validate("");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_THAT(outcome.output, HasSubstr("2 checks in 2 cases, 1 failed"));
  EXPECT_EQ(validate("--filter kept").status, 0);
}

TEST_F(Validate, UnmatchedFilterIsUsageAndNamesTheNearest) {
  put("kept", R"("at_least": 0)");
  const Outcome outcome = validate("--filter kopt");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output, HasSubstr("nearest: \"kept\""));
}

TEST_F(Validate, WithoutCasesThereIsNoInput) {
  const Outcome outcome = validate("");
  EXPECT_EQ(outcome.status, 66);
  EXPECT_THAT(outcome.output, HasSubstr("MYOTACT_DATA_DIR"));
}

TEST_F(Validate, BrokenCaseIsBadData) {
  put("broken", R"("value": 1)");
  const Outcome outcome = validate("");
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, HasSubstr("broken.json: /checks/0"));
}

TEST_F(Validate, LeavesAPageAndJson) {
  put("kept", R"("at_least": 0)");
  const auto page = folder_.path() / "page.html";
  const Outcome outcome = validate("--json --report " + page.string());
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.output, HasSubstr("\"passed\": true"));
  std::ostringstream text;
  text << std::ifstream(page).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("1 of 1 cases pass"));
  const Outcome refused = validate("--report " + (folder_.path() / "nowhere" / "page.html").string());
  EXPECT_EQ(refused.status, 74);
  EXPECT_THAT(refused.output, ::testing::Not(HasSubstr("checks in")));  // known before the cases run
}

}  // namespace
}  // namespace myotact::testing
