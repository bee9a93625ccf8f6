// The scenes without tissue through every program that takes a scene: it does its work, or says why it cannot.

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"

namespace myotact::testing {
namespace {

constexpr int kBadData = 65;

class SpringScene : public ::testing::TestWithParam<const char*> {};

TEST_P(SpringScene, RunsAndPlaysAgain) {
  const TemporaryFolder folder;
  const std::filesystem::path recording = folder.path() / "a.rec";
  const std::string out = " --log-level error --out " + folder.path().string();
  const Outcome run =
      run_program("run " + std::string(GetParam()) + " --seconds 2 --record " + recording.string() + out);
  EXPECT_EQ(run.status, 0) << run.output;
  const auto summary = nlohmann::json::parse(read_file(folder.path() / "summary.json"));
  EXPECT_GT(summary["largest_force_N"], 0.5);
  EXPECT_EQ(summary["faults"].size(), 0u);
  EXPECT_EQ(summary["notice"], "");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "scene.png"));
  const Outcome again = run_program("replay " + recording.string() + " --json --log-level error");
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_EQ(nlohmann::json::parse(again.output)["largest_force_difference_N"], 0.0);
}

TEST_P(SpringScene, WhatHasNoMeaningForItIsRefusedWithARemedy) {
  const TemporaryFolder folder;
  for (const char* program : {"stiffness ", "fidelity "}) {
    const Outcome outcome = run_program(program + std::string(GetParam()) + " --out " + folder.path().string());
    EXPECT_EQ(outcome.status, kBadData) << outcome.output;
    EXPECT_NE(outcome.output.find("such as elbow"), std::string::npos) << outcome.output;
  }
}

INSTANTIATE_TEST_SUITE_P(OldScenes, SpringScene, ::testing::Values("spring", "particle"));

}  // namespace
}  // namespace myotact::testing
