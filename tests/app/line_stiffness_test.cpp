// Line models through the program: table, JSON, files, statuses.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kElbow = source_folder() + "/assets/cases/line_elbow.json";

class LineStiffness : public ::testing::Test {
 protected:
  Outcome stiffness(const std::string& arguments) const {
    return run_program("stiffness " + arguments + " --out " + (folder_.path() / "out").string());
  }
  std::string file(const json& model) const {
    const auto path = folder_.path() / "scene.json";  // a name that says nothing
    write_file(path, model.dump());
    return path.string();
  }

  TemporaryFolder folder_;
};

TEST_F(LineStiffness, TheShippedElbowGivesThePublishedTable) {
  const Outcome outcome = stiffness(kElbow);
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, StartsWith("joint,q,u,aF,aE,tau,r2k,geo,K,B,f,modal_f,damping_ratio,K_srs,paw_flexing,"
                                         "paw_extending,tau_net,K_perturbed,held\nelbow,0,0,"));
  EXPECT_EQ(read_file(folder_.path() / "out" / "line_stiffness.csv"), outcome.output);
  EXPECT_THAT(read_file(folder_.path() / "out" / "line_stiffness.svg"), HasSubstr("<svg"));
}

TEST_F(LineStiffness, JsonHoldsTheSameWithUnitsAndMuscles) {
  const Outcome outcome = stiffness(kElbow + " --json");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const json answer = json::parse(outcome.output);
  EXPECT_EQ(answer["units"]["K"], "N m/rad");
  const json& full = answer["rows"][4];
  EXPECT_EQ(full["u"], 1);
  EXPECT_NEAR(full["K"].get<double>(), 3.9716, 1e-4 * 3.9716);
  EXPECT_NEAR(full["aE"].get<double>(), 0.24562, 1e-4 * 0.24562);
  EXPECT_NEAR(full["modal_f"].get<double>(), 4.53, 0.005);
  EXPECT_EQ(full["held"], true);
  EXPECT_EQ(full["muscles"][0]["key"], "biceps_brachii");
  EXPECT_NEAR(full["muscles"][0]["r"].get<double>(), 0.01135, 1e-5);
}

TEST_F(LineStiffness, WhatIsNotAskedForIsLeftOut) {
  json model = json::parse(read_file(kElbow), nullptr, true, true);
  model.erase("short_range_stiffness");
  model["joint"].erase("paw_lever_m");
  const Outcome outcome = stiffness(file(model));
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, StartsWith("joint,q,u,aF,aE,tau,r2k,geo,K,B,f,modal_f,damping_ratio,tau_net,"));
}

TEST_F(LineStiffness, WrongModelsAreBadData) {
  json model = json::parse(read_file(kElbow), nullptr, true, true);
  model["muscles"][0]["optimal_fibre_m"] = 0;
  const Outcome outcome = stiffness(file(model));
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("/muscles/0/optimal_fibre_m"), HasSubstr("is 0")));
  EXPECT_EQ(stiffness(kElbow + " --set tissue=fem").status, 2);
  EXPECT_EQ(stiffness(kElbow + " --levels 0,1").status, 2);
}

}  // namespace
}  // namespace myotact::testing
