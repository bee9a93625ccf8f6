#include "view/state/scene_controls.h"

namespace myotact::view {

namespace {

using messages::ControlState;

void carry_out(const messages::SetLevels& levels, ControlState& state) {
  state.drive = Drive::Levels;
  state.flexors = levels.flexors;
  state.extensors = levels.extensors;
}
void carry_out(const messages::CoContract& balance, ControlState& state) {
  state.drive = Drive::Balance;
  state.common = balance.common;
  state.difference = balance.difference;
}
void carry_out(const messages::FollowScript&, ControlState& state) {
  state.drive = Drive::Script;
}
void carry_out(const messages::HoldPosture& hold, ControlState& state) {
  state.hold_posture = hold.on;
}
void carry_out(const messages::SetGravity& gravity, ControlState& state) {
  state.gravity = gravity.on;
}
void carry_out(const messages::Pause& pause, ControlState& state) {
  state.paused = pause.on;
}
void carry_out(const messages::EndRecording&, ControlState& state) {
  state.recording = false;
}
void carry_out(const messages::ChooseTool& choice, ControlState& state) {
  const auto tool = static_cast<std::size_t>(choice.tool);
  if (tool < state.tools.size()) state.tools.at(tool) = choice.shape;
}

/// What the script has on its way, a frame states.
void carry_out(const messages::GoOn& go, ControlState& state) {
  const ControlState& from = go.from.control;
  if (from.drive == Drive::Script) carry_out(messages::FollowScript{}, state);
  if (from.drive == Drive::Levels) {
    carry_out(messages::CoContract{from.common, from.difference}, state);
    carry_out(messages::SetLevels{from.flexors, from.extensors}, state);
  }
  if (from.drive == Drive::Balance) carry_out(messages::CoContract{from.common, from.difference}, state);
  state.hold_posture = from.hold_posture;
  state.gravity = from.gravity;
  state.paused = false;
}

/// What is in force once the order is.
ControlState after(const messages::Order& order, ControlState state) {
  std::visit(
      [&]<class Asked>(const Asked& asked) {
        using messages::kIsOneOf;
        // What these do, no state shows.
        if constexpr (!kIsOneOf<Asked, messages::Activate, messages::Shove, messages::TestShove, messages::SingleStep,
                                messages::Reset>) {
          carry_out(asked, state);
        }
      },
      order);
  return state;
}

/// Of two orders for the same thing the later one counts.
bool replaces(const messages::Order& later, const messages::Order& earlier) {
  const auto drives = [](const messages::Order& order) {
    return std::holds_alternative<messages::SetLevels>(order) || std::holds_alternative<messages::CoContract>(order) ||
           std::holds_alternative<messages::FollowScript>(order);
  };
  const auto* tool = std::get_if<messages::ChooseTool>(&later);
  const auto* tool_before = std::get_if<messages::ChooseTool>(&earlier);
  if (tool != nullptr && tool_before != nullptr) return tool->tool == tool_before->tool;  // of the same hand
  return later.index() == earlier.index() || (drives(later) && drives(earlier));
}

}  // namespace

void SceneControls::hear(const messages::SceneFrame& newest, double now_s) {
  // When frames that differ mean that the scene does not do it. The first may be of a step begun before.
  constexpr double kPatience_s = 1.0;
  constexpr int kFrames = 3;
  now_s_ = now_s;
  if (newest.sequence == 0 || newest.sequence == heard_) return;  // a step that takes long reports nothing
  heard_ = newest.sequence;
  in_force_ = newest.control;
  std::erase_if(pending_, [&](Pending& pending) {
    const bool refused = ++pending.frames >= kFrames && now_s > pending.since_s + kPatience_s;
    return refused || after(pending.order, in_force_) == in_force_;
  });
  show();
}

void SceneControls::push(const messages::Order& order, messages::Commander by) {
  asked_.push_back({order, by});
  std::erase_if(pending_, [&](const Pending& pending) { return replaces(order, pending.order); });
  pending_.push_back({order, now_s_, 0});
  show();
}

void SceneControls::restore(const SceneState& wanted, messages::Commander by) {
  for (const messages::Order& order : orders_between(scene_state_of(state_), wanted)) push(order, by);
}

void SceneControls::show() {
  state_ = in_force_;
  for (const Pending& pending : pending_) state_ = after(pending.order, state_);
}

SceneState scene_state_of(const ControlState& state) {
  return {state.drive,      state.flexors,      state.extensors, state.common,
          state.difference, state.hold_posture, state.gravity,   state.tools};
}

std::vector<messages::Order> orders_between(const SceneState& from, const SceneState& to) {
  std::vector<messages::Order> orders;
  const bool other_drive = from.drive != to.drive;
  const bool other_levels = from.flexors != to.flexors || from.extensors != to.extensors;
  const bool other_balance = from.common != to.common || from.difference != to.difference;
  if (to.drive == Drive::Script && other_drive) orders.emplace_back(messages::FollowScript{});
  if (to.drive == Drive::Levels && (other_drive || other_levels)) {
    orders.emplace_back(messages::SetLevels{to.flexors, to.extensors});
  }
  if (to.drive == Drive::Balance && (other_drive || other_balance)) {
    orders.emplace_back(messages::CoContract{to.common, to.difference});
  }
  if (from.hold_posture != to.hold_posture) orders.emplace_back(messages::HoldPosture{to.hold_posture});
  if (from.gravity != to.gravity) orders.emplace_back(messages::SetGravity{to.gravity});
  for (std::size_t t = 0; t < to.tools.size(); ++t) {
    if (from.tools.at(t) != to.tools.at(t))
      orders.emplace_back(messages::ChooseTool{static_cast<int>(t), to.tools.at(t)});
  }
  return orders;
}

}  // namespace myotact::view
