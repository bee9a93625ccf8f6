// "myotact devices": the table, and the guided check with a simulated hand on a simulated device.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Devices, TheTableSaysWhatIsReady) {
  const Outcome outcome = run_program("devices --json");
  EXPECT_EQ(outcome.status, 0);
  const auto rows = nlohmann::json::parse(outcome.output);
  ASSERT_GE(rows.size(), 2u);
  EXPECT_EQ(rows[0]["name"], "simulated");
  EXPECT_EQ(rows[0]["available"], true);
}

TEST(Devices, ACheckPushesAfterAYesAndTellsWhatMoved) {
  const Outcome outcome = run_program("devices --test simulated", "printf '\\nyes\\n' |");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  for (const char* axis : {"right", "up", "towards you"})
    EXPECT_THAT(outcome.output, HasSubstr(std::string(axis) + ": pushed with 0.")) << outcome.output;
  EXPECT_THAT(outcome.output, Not(HasSubstr("NOT"))) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("3. Rate: period"));
}

TEST(Devices, NothingPushesWithoutAYes) {
  for (const char* answers : {"printf '\\nno\\n' |", "printf '\\n' |", "true |"}) {
    const Outcome outcome = run_program("devices --test simulated:falcon", answers);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("no force was sent"));
    EXPECT_THAT(outcome.output, Not(HasSubstr("pushed")));
  }
}

TEST(Devices, AnInterruptedCheckEndsAtOnce) {
  const Outcome outcome = run_program("devices --test simulated", "sleep 4 | timeout --signal=INT 1 env");
  EXPECT_EQ(outcome.status, 124) << "timeout says that it sent the signal";
  EXPECT_THAT(outcome.output, HasSubstr("no force was sent"));
}

TEST(Devices, WhatIsNotThereIsUnavailable) {
  const Outcome outcome = run_program("devices --test fulcon");
  EXPECT_EQ(outcome.status, 69);
  EXPECT_THAT(outcome.output, HasSubstr("fulcon"));
}

}  // namespace
}  // namespace myotact::testing
