#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "messages/command.h"
#include "messages/control_state.h"
#include "scene/co_contraction.h"
#include "scene/recording.h"
#include "scene/scene_file.h"
#include "scene/scripted_hand.h"
#include "scene/shove_test.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Carries out the scene's script, and what people ask for, step by step: decides the inputs of muscles and joints
/// and where the hand wants to be. Lives on the simulation's thread.
class Conductor {
 public:
  /// Puts the simulation at rest in the scene's posture; measures the torque table when the scene co-contracts.
  /// Where there is no complete equilibrium the motion starts from what comes nearest, and notice() reports it.
  Conductor(const Scene& scene, simulation::Simulation& simulation);

  /// Fills excitations, torques and gravity of the step that starts at `simulated_s`. Starts the script's due actions.
  void prepare_step(double simulated_s, StepRecord& input);

  HandTarget hand(std::size_t tool, double time_s) const { return hands_[tool].target(time_s - script_start_s_); }

  /// The picture that the script asked for since the last call, if any.
  std::optional<TakePicture> take_picture();

  /// Begins an action that the script does not hold; its start is a time of the script's clock, which begins at 0 and
  /// with every reset. For a hand that decides as it goes.
  void begin(const ScriptAction& action);

  /// Carries out now what somebody asks of muscles, joints, gravity or the whole scene. From then on the levels that a
  /// person asked for lead, until the script is to lead again. What concerns clock and recording is left to the
  /// session.
  void apply(const messages::Command& command);

  /// What is in force now, as far as the muscles and gravity go.
  messages::ControlState control() const;

  /// What a person should know about the last step, or nothing: muscles that cannot hold the posture, a
  /// line caught in its wrap.
  std::string notice() const;
  const ShoveTest& shove_test() const { return shove_test_; }

  double script_end_s() const;

 private:
  /// A value on its way from one level to another.
  struct Ramp {
    double start_s = 0.0, end_s = 0.0, from = 0.0, to = 0.0;
    double at(double time_s) const;
  };

  /// Who asks, from when to when, by the script's clock.
  struct When {
    messages::Commander by = messages::Commander::Script;
    double start_s = 0.0, end_s = 0.0;
  };
  /// A constant torque under way.
  struct Push {
    messages::Shove shove;
    double end_s = 0.0;
  };

  void settle();
  double now_s() const;  // of the script's clock
  void carry_out(const messages::Command& command, double start_s);
  void obey(const messages::SetLevels& levels, const When& when);
  void obey(const messages::CoContract& balance, const When& when);
  void obey(const messages::FollowScript& script, const When& when);
  void obey(const messages::Activate& activate, const When& when);
  void obey(const messages::HoldPosture& hold, const When& when);
  void obey(const messages::SetGravity& gravity, const When& when);
  void obey(const messages::Shove& shove, const When& when);
  void obey(const messages::TestShove& test, const When& when);
  void obey(const messages::ChooseTool& choice, const When& when);
  void obey(const messages::GoOn& go, const When& when);
  void obey(const messages::Reset& reset, const When& when);
  void balance_by(const messages::CoContract& balance, const When& when);
  bool posture_is_held(double time_s) const;
  void trim_posture(double time_s);
  void drive_co_contraction(double time_s, std::vector<double>& excitations);
  std::string weak_tissue() const;  // a notice, or empty

  const Scene* scene_;
  simulation::Simulation* simulation_;
  std::vector<ScriptedHand> hands_;       // one a tool
  TorqueTable measured_torques_;          // in the starting posture
  TorqueTable torques_;                   // in the posture that is held
  simulation::JointReadout start_joint_;  // the co-contraction's, at rest in the starting posture
  PostureTrim trim_;
  ShoveTest shove_test_;
  double script_start_s_ = 0.0;  // simulated time at which the script began
  std::size_t next_action_ = 0;
  std::vector<Ramp> activations_;  // one a muscle
  Ramp common_, difference_;
  messages::CoContract scripted_;                      // what the script would have, whoever leads
  double scripted_end_s_ = 0.0;                        // when it is there
  std::optional<Ramp> flexor_level_, extensor_level_;  // set by the sliders: no balance
  messages::Drive drive_ = messages::Drive::Script;
  messages::Commander driver_ = messages::Commander::Script;  // who set it
  messages::Commander holder_ = messages::Commander::Script;  // who said last whether the posture is held
  bool co_contracting_ = false;
  bool hold_posture_ = false;
  bool balanced_ = true;  // of the last step
  bool starts_at_rest_ = true;
  std::vector<Push> shoves_;  // under way
  Vec3 gravity_m_s2_;
  messages::ChosenTools tools_chosen_{};
  std::optional<RestPosture> from_;  // where the next step is to begin
  bool holds_from_there_ = false;    // the posture is to be held once the next step has begun there
  std::optional<TakePicture> picture_;
};

/// Where the hand of a tool begins: beside the limb, out of reach of every muscle; two hands 0.16 m apart, the left one
/// on the left of a person who looks at the limb from its lateral side. On a tether, where nothing pulls.
Vec3 start_of_hand(const Scene& scene, std::size_t tool);

/// Sets the inputs of the simulation from a step's record.
void apply(const StepRecord& input, simulation::Simulation& simulation);

}  // namespace myotact::scene
