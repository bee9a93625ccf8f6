#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "messages/command.h"
#include "messages/scene_frame.h"
#include "view/state/scene_state.h"

namespace myotact::view {

/// What a window shows of the scene's controls, and what the person asks of them. What is in force comes with the
/// frames; what was asked for since shows at once, until a frame says the same or the scene does not do it. One thread.
///
///   SceneFrame::control --hear()--> state() --> sliders, buttons, saved works, undo
///   the person, a lesson --push()--> take_commands() --> the session
class SceneControls {
 public:
  /// `start`: what is in force until the first frame states it.
  explicit SceneControls(const messages::ControlState& start) : in_force_(start), state_(start) {}

  /// Once a picture, before the panels. `now_s`: of a clock that rises with the pictures.
  void hear(const messages::SceneFrame& newest, double now_s);
  const messages::ControlState& state() const { return state_; }

  void push(const messages::Order& order, messages::Commander by = messages::Commander::Window);
  /// As many orders as lead from what is shown to `wanted`.
  void restore(const SceneState& wanted, messages::Commander by = messages::Commander::Window);
  /// Of all devices; of both in one picture, the stop counts.
  void stop_forces() { forces_on_ = false; }
  void enable_forces() { forces_on_ = forces_on_.value_or(true); }

  /// What was pushed and not yet taken.
  const std::vector<messages::Command>& asked() const { return asked_; }
  std::vector<messages::Command> take_commands() { return std::exchange(asked_, {}); }
  /// Whether forces are to be enabled or stopped, once; none: as they are.
  std::optional<bool> take_forces_on() { return std::exchange(forces_on_, std::nullopt); }

 private:
  /// Asked for, and not seen in a frame yet.
  struct Pending {
    messages::Order order;
    double since_s = 0.0;
    int frames = 0;  // heard since
  };

  void show();

  messages::ControlState in_force_, state_;
  std::uint64_t heard_ = 0;  // sequence of the newest frame
  double now_s_ = 0.0;
  std::vector<Pending> pending_;  // at most one of what an order replaces
  std::vector<messages::Command> asked_;
  std::optional<bool> forces_on_;
};

/// What a person sets, of all that is in force.
SceneState scene_state_of(const messages::ControlState& state);
/// What leads from one to the other; empty where what is in force is the same.
std::vector<messages::Order> orders_between(const SceneState& from, const SceneState& to);

}  // namespace myotact::view
