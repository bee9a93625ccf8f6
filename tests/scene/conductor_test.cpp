#include "scene/conductor.h"

#include <gtest/gtest.h>

// What a person, the script and the network ask for, and what is in force for it.

namespace myotact::scene {
namespace {

using messages::Commander;
using messages::Drive;

/// The elbow, its muscles as lines, without a script.
class Commands : public ::testing::Test {
 protected:
  static Scene elbow() {
    Scene scene = load_scene("elbow", {{"tissue", R"({"default": "line"})"}});
    scene.script.clear();
    return scene;
  }
  void run_until(double time_s) {
    StepRecord input;
    while (simulation_.time_s() < time_s - 0.5 * scene_.settings.dt_s) {
      conductor_.prepare_step(simulation_.time_s(), input);
      scene::apply(input, simulation_);
      simulation_.step({});
    }
  }
  /// As the script would.
  void begin(const Action& what, double duration_s) { conductor_.begin({simulation_.time_s(), duration_s, what, 0}); }

  Scene scene_ = elbow();
  simulation::Simulation simulation_{scene_.specimen, scene_.settings};
  Conductor conductor_{scene_, simulation_};
};

TEST_F(Commands, ABalanceGlidesThereOnceHoweverOftenItIsAskedFor) {
  for (int i = 1; i <= 45; ++i) {
    conductor_.apply({messages::CoContract{0.4, 0.0}});
    run_until(0.01 * i);
  }
  EXPECT_EQ(conductor_.control().common, 0.4);
  EXPECT_EQ(conductor_.control().common_now, 0.4);
  EXPECT_EQ(conductor_.control().drive, Drive::Balance);
  EXPECT_EQ(conductor_.control().driver, Commander::Window);
}

/// Small changes in a tenth of a second; from none to all in a second, or the joint would swing.
TEST_F(Commands, AGlideTakesTheLongerTheFartherItGoes) {
  conductor_.apply({messages::CoContract{0.04, 0.0}});
  run_until(0.05);
  EXPECT_EQ(conductor_.control().common, 0.04);
  EXPECT_NEAR(conductor_.control().common_now, 0.02, 1e-9);
  run_until(0.2);
  conductor_.apply({messages::CoContract{0.44, 0.0}});
  run_until(0.3);
  EXPECT_NEAR(conductor_.control().common_now, 0.14, 1e-9);
}

TEST_F(Commands, ThePersonLeadsUntilTheScriptIsToLeadAgain) {
  begin(CoContract{0.2, 0.0}, 0.2);
  EXPECT_EQ(conductor_.control().driver, Commander::Script);
  run_until(0.1);
  EXPECT_NEAR(conductor_.control().common, 0.1, 1e-9);  // of the script's: on its way
  conductor_.apply({messages::CoContract{0.6, 0.1}, Commander::Network});
  run_until(0.3);
  begin(CoContract{0.8, 0.0}, 0.5);  // heard, and not obeyed yet
  run_until(0.65);
  EXPECT_EQ(conductor_.control().common_now, 0.6);
  EXPECT_EQ(conductor_.control().driver, Commander::Network);
  conductor_.apply({messages::FollowScript{}});
  EXPECT_EQ(conductor_.control().drive, Drive::Script);
  run_until(0.8);  // when the script's own ramp ends
  EXPECT_EQ(conductor_.control().common_now, 0.8);
  EXPECT_EQ(conductor_.control().difference, 0.0);
}

TEST_F(Commands, LevelsOfBothSidesHaveTheSmallerInCommon) {
  conductor_.apply({messages::SetLevels{0.5, 0.25}, Commander::Lesson});
  run_until(0.2);
  const messages::ControlState state = conductor_.control();
  EXPECT_EQ(state.drive, Drive::Levels);
  EXPECT_EQ(state.driver, Commander::Lesson);
  EXPECT_EQ(state.flexors, 0.5);
  EXPECT_EQ(state.extensors, 0.25);
  EXPECT_EQ(state.common_now, 0.25);
}

TEST_F(Commands, AResetKeepsWhatAPersonSetAndForgetsTheScripts) {
  begin(CoContract{0.9, 0.0}, 0.0);
  begin(HoldPosture{false}, 0.0);
  run_until(0.1);
  conductor_.apply({messages::Reset{}});
  EXPECT_EQ(conductor_.control().common_now, 0.0);
  EXPECT_TRUE(conductor_.control().hold_posture);  // as the scene begins
  conductor_.apply({messages::SetLevels{0.5, 0.25}});
  conductor_.apply({messages::HoldPosture{false}});
  conductor_.apply({messages::SetGravity{true}});
  conductor_.apply({messages::Reset{}});
  EXPECT_EQ(conductor_.control().drive, Drive::Levels);
  EXPECT_EQ(conductor_.control().flexors, 0.5);
  EXPECT_FALSE(conductor_.control().hold_posture);
  EXPECT_TRUE(conductor_.control().gravity);
}

TEST_F(Commands, AShoveLastsAsLongAsItSays) {
  conductor_.apply({messages::Shove{0, 0.5}, Commander::Window, 0.05});
  StepRecord input;
  conductor_.prepare_step(0.04, input);
  EXPECT_EQ(input.joint_torques_Nm[0], 0.5);
  conductor_.prepare_step(0.05, input);
  EXPECT_EQ(input.joint_torques_Nm[0], 0.0);
}

TEST(CommandsWithoutCoContraction, AreLeftUndone) {
  const Scene scene = load_scene("plane");
  simulation::Simulation simulation(scene.specimen, scene.settings);
  Conductor conductor(scene, simulation);
  conductor.apply({messages::CoContract{0.5, 0.0}});
  conductor.apply({messages::SetLevels{0.5, 0.5}});
  conductor.apply({messages::TestShove{}});
  conductor.apply({messages::FollowScript{}});
  EXPECT_EQ(conductor.control().drive, Drive::Script);
  EXPECT_FALSE(conductor.shove_test().under_way());
}

}  // namespace
}  // namespace myotact::scene
