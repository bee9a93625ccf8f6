// `myotact fidelity` from outside: its files, what it finds of planted faults, recordings whole and cut short, bad
// input.

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"

namespace myotact::testing {
namespace {

constexpr int kUsage = 2, kBadData = 65, kNoInput = 66;

TEST(Fidelity, ATouchOfTheElbowLeavesItsFilesAndFindsPlantedFaults) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      "fidelity elbow --seconds 1.3 --plant delay_ms=5,scale=0.9,rotate_deg=5,noise_mN=20 --log-level error "
      "--out " +
      folder.path().string());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const auto json = nlohmann::json::parse(read_file(folder.path() / "fidelity.json"));
  EXPECT_TRUE(json["planted"]["all_found"]);
  EXPECT_EQ(json["truth"], "steps");
  EXPECT_NEAR(json["compared"]["force"]["gain"].get<double>(), 1.0, 0.05);
  const std::string page = read_file(folder.path() / "fidelity.html");
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_EQ(page.find("http-equiv"), std::string::npos);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  const std::string csv = read_file(folder.path() / "fidelity.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1301);
}

TEST(Fidelity, ARecordingIsFeltAgainAndOneCutShortIsUsedToItsLastWholeChunk) {
  const TemporaryFolder folder;
  const std::filesystem::path whole = folder.path() / "whole.rec", cut = folder.path() / "cut.rec";
  const std::string out = " --log-level error --json --out " + folder.path().string();
  ASSERT_EQ(run_program("run elbow --seconds 1.2 --levels none --record " + whole.string() + out).status, 0);
  const Outcome felt = run_program("fidelity --recording " + whole.string() + out);
  ASSERT_LE(felt.status, 1) << felt.output;  // 1: felt, and judged poor: the gate opens while the hand touches
  const std::string bytes = read_file(whole);
  write_file(cut, bytes.substr(0, bytes.size() * 9 / 10));
  const Outcome shorter = run_program("fidelity --recording " + cut.string() + out);
  ASSERT_LE(shorter.status, 1) << shorter.output;
  EXPECT_NE(shorter.output.find("cut short"), std::string::npos) << shorter.output;
  std::string other = bytes;
  other[7] = '2';
  write_file(cut, other);
  const Outcome refused = run_program("fidelity --recording " + cut.string() + out);
  EXPECT_EQ(refused.status, kBadData);
  EXPECT_NE(refused.output.find("another version"), std::string::npos) << refused.output;
}

TEST(Fidelity, AMapOfALimbLeavesItsTableItsPageAndAPictureFromEachSide) {
  const TemporaryFolder folder;
  const Outcome outcome = run_program(
      "fidelity elbow --map --places 1 --set tissue.default=rigid --log-level error --out " + folder.path().string());
  EXPECT_LE(outcome.status, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("of 7 places"), std::string::npos) << outcome.output;
  const auto json = nlohmann::json::parse(read_file(folder.path() / "touch_map.json"));
  EXPECT_EQ(json["places"].size(), 7u);
  EXPECT_EQ(outcome.status, json["poor"].get<int>() > 0 ? 1 : 0);
  const std::string csv = read_file(folder.path() / "touch_map.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 8);
  const std::string page = read_file(folder.path() / "touch_map.html");
  EXPECT_NE(page.find("data:image/png;base64,iVBOR"), std::string::npos) << "a PNG file begins so";
  EXPECT_EQ(page.find("<script"), std::string::npos);
  for (const char* side : {"lateral", "medial", "cranial", "caudal"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / ("touch_map_" + std::string(side) + ".png")));
}

TEST(Fidelity, WhatIsWrongOnTheCommandLineIsNamed) {
  EXPECT_EQ(run_program("fidelity elbw").status, kNoInput);
  EXPECT_EQ(run_program("fidelity --device stilus").status, kNoInput);
  EXPECT_EQ(run_program("fidelity --recording /nowhere").status, kNoInput);
  EXPECT_EQ(run_program("fidelity --plant wind=3").status, kUsage);
  EXPECT_EQ(run_program("fidelity --truth guess").status, kUsage);
  EXPECT_EQ(run_program("fidelity --device simulated,stylus").status, kUsage);
  EXPECT_EQ(run_program("fidelity --map --device simulated,stylus").status, kUsage);
  EXPECT_EQ(run_program("fidelity --map --seconds 2").status, kUsage);
  EXPECT_EQ(run_program("fidelity --map --goal 8").status, kUsage);
  EXPECT_EQ(run_program("fidelity --places 2").status, kUsage);
  EXPECT_EQ(run_program("fidelity --map --places 0").status, kUsage);
  EXPECT_EQ(run_program("fidelity plane --map").status, kBadData);
}

}  // namespace
}  // namespace myotact::testing
