// Going on from a moment of the past: what is as it was then, what the hand feels of it, and that a recording repeats
// it.

#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "scene/conductor.h"
#include "scene/force_replay.h"
#include "scene/free_session.h"
#include "scene/recording_header.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace myotact::scene {
namespace {

using namespace std::chrono_literals;

Scene hinge() {
  Scene scene;
  scene.name = "hinge";
  scene.specimen_folder = ".";
  scene.specimen = testing::coarse_antagonist_hinge();
  scene.joints.resize(1);
  scene.activations.assign(2, 0.0);
  scene.settings.tissue.assign(2, simulation::TissueModel::Line);
  scene.tools.resize(1);
  CoContraction set;
  set.joint = 0;
  set.flexors = {0};
  set.extensors = {1};
  scene.co_contraction = set;
  return scene;
}

messages::Moment moment_of(const simulation::Simulation& simulation, const Conductor& conductor) {
  messages::Moment moment;
  moment.joints = 1;
  moment.angles_rad[0] = simulation.joint(0).angle_rad;
  moment.muscles = 2;
  for (int m = 0; m < 2; ++m) {
    moment.activations.at(static_cast<std::size_t>(m)) = static_cast<float>(simulation.activation(m));
  }
  moment.control = conductor.control();
  return moment;
}

class GoOn : public ::testing::Test {
 protected:
  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      conductor_.prepare_step(simulation_.time_s(), input_);
      apply(input_, simulation_);
      simulation_.step({});
    }
  }
  Scene scene_ = hinge();
  simulation::Simulation simulation_{scene_.specimen, scene_.settings};
  Conductor conductor_{scene_, simulation_};
  StepRecord input_;
};

TEST_F(GoOn, PostureActivationsAndWhatWasInForceAreThoseOfThatMoment) {
  conductor_.apply({messages::SetLevels{0.4, 0.1}});
  run(100);
  const messages::Moment then = moment_of(simulation_, conductor_);
  ASSERT_GT(std::abs(then.angles_rad[0]), 0.05) << "it flexed";
  conductor_.apply({messages::CoContract{0.2, 0.0}});
  conductor_.apply({messages::SetGravity{true}});
  conductor_.apply({messages::Shove{0, -0.05}, messages::Commander::Window, 10.0});
  run(100);
  ASSERT_GT(std::abs(simulation_.joint(0).angle_rad - then.angles_rad[0]), 0.02);
  const double before_s = simulation_.time_s();
  conductor_.apply({messages::GoOn{then}});
  EXPECT_EQ(conductor_.control(), then.control);
  conductor_.prepare_step(simulation_.time_s(), input_);
  ASSERT_TRUE(input_.from);
  apply(input_, simulation_);
  EXPECT_NEAR(simulation_.joint(0).angle_rad, then.angles_rad[0], 1e-9);
  EXPECT_EQ(simulation_.joint(0).velocity_rad_s, 0.0);
  EXPECT_EQ(simulation_.time_s(), before_s) << "time runs on";
  for (int m = 0; m < 2; ++m) {
    EXPECT_NEAR(simulation_.activation(m), then.activations.at(static_cast<std::size_t>(m)), 1e-6);
  }
  simulation_.step({});
  EXPECT_EQ(input_.joint_torques_Nm[0], 0.0) << "no shove is under way";
  run(1);
  EXPECT_FALSE(input_.from) << "once";
  run(100);  // the same levels lead to the same rest
  EXPECT_NEAR(simulation_.joint(0).angle_rad, then.angles_rad[0], 0.02);
}

TEST_F(GoOn, AHeldPostureIsHeldThere) {
  conductor_.apply({messages::SetLevels{0.3, 0.1}});
  run(100);
  messages::Moment then = moment_of(simulation_, conductor_);
  then.control.drive = messages::Drive::Balance;
  then.control.common = 0.3;
  then.control.hold_posture = true;
  conductor_.apply({messages::CoContract{0.0, 0.0}});
  run(100);
  conductor_.apply({messages::GoOn{then}});
  run(2);
  EXPECT_TRUE(conductor_.control().hold_posture);
  run(200);
  EXPECT_NEAR(simulation_.joint(0).angle_rad, then.angles_rad[0], 0.03);
}

TEST_F(GoOn, AMomentOfAnotherSceneIsNotObeyed) {
  run(5);
  const messages::Moment then = moment_of(simulation_, conductor_);
  for (const int wrong : {0, 1, 2}) {
    messages::Moment other = then;
    if (wrong == 0) other.joints = 2;
    if (wrong == 1) other.muscles = 4'000'000'000U;
    if (wrong == 2) other.angles_rad[0] = std::nan("");
    conductor_.apply({messages::GoOn{other}});
    conductor_.prepare_step(simulation_.time_s(), input_);
    EXPECT_FALSE(input_.from) << wrong;
  }
}

bool comes_true(FreeSession& session, messages::SceneFrame& frame, const std::function<bool()>& condition) {
  for (int i = 0; i < 2000; ++i) {
    if (session.fetch_frame(frame) && condition()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

messages::Moment moment_of(const messages::SceneFrame& frame) {
  messages::Moment moment;
  moment.joints = 1;
  moment.angles_rad[0] = frame.joints[0].angle_rad;
  moment.muscles = 2;
  moment.control = frame.control;
  return moment;
}

TEST_F(GoOn, NoHandFeelsItAndARecordingRepeatsItToTheLastBit) {
  const testing::TemporaryFolder folder;
  scene_.script.push_back({0.0, 0.5, TouchMuscle{0, 0.5, Vec3::UnitZ(), 4e-3}, 0});
  RecordingWriter recorder(folder.path() / "on.myorec", recording_header(scene_, 1, {}));
  device::SimulatedDevice hand("simulated", start_of_hand(scene_, 0));
  const std::array<ToolDevice, 1> devices = {ToolDevice{&hand, &hand}};
  simulation::Simulation simulation(scene_.specimen, scene_.settings);
  {
    FreeSession session(scene_, simulation, devices, &recorder);
    session.start();
    messages::SceneFrame frame;
    ASSERT_TRUE(comes_true(session, frame, [&] { return frame.tools.at(0).in_contact; }));
    const messages::Moment then = moment_of(frame);
    ASSERT_EQ(session.push({messages::SetLevels{0.5, 0.0}}), "");
    ASSERT_TRUE(comes_true(session, frame, [&] { return frame.joints[0].angle_rad > then.angles_rad[0] + 0.05; }));
    ASSERT_EQ(session.push({messages::Pause{true}}), "");
    ASSERT_TRUE(comes_true(session, frame, [&] { return frame.control.paused; }));
    ASSERT_EQ(session.push({messages::GoOn{then}}), "");
    EXPECT_TRUE(comes_true(session, frame, [&] { return frame.joints[0].angle_rad < then.angles_rad[0] + 0.02; }));
    EXPECT_FALSE(frame.control.paused);
    EXPECT_EQ(frame.control.drive, messages::Drive::Script);
    EXPECT_FALSE(session.forces_stopped()) << "a stop is something else";
    std::this_thread::sleep_for(300ms);
    session.stop();
  }
  const Recording recording = read_recording(folder.path() / "on.myorec");
  ForceReplay replay(scene_, recording, {});
  replay.feel(simulation_);
  int set_back = 0;
  for (const StepRecord& step : recording.steps) {
    set_back += step.from ? 1 : 0;
    apply(step, simulation_);
    simulation_.step(step.tools);
    ASSERT_EQ(simulation_.state_hash(), step.state_hash);
    replay.feel(simulation_);
  }
  EXPECT_EQ(set_back, 1);
  EXPECT_GT(replay.comparison().compared, 20u);
  EXPECT_EQ(replay.comparison().largest_difference_N, 0.0);
  int held_off = 0;
  for (const TickRecord& tick : recording.tools.at(0).ticks) {
    held_off += (tick.device.buttons & messages::kClutchButton) != 0;
  }
  EXPECT_GT(held_off, 0) << "no force while things were put elsewhere";
}

}  // namespace
}  // namespace myotact::scene
