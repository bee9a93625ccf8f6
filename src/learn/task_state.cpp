#include "learn/task_state.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace myotact::learn {

namespace {

constexpr double kTouch_s = 0.3;           // a tool that only brushes past has not touched
constexpr double kSettle_s = 0.5;          // until a joint rests after what a step has set
constexpr double kLongestPicture_s = 0.2;  // a pause or a jump of the clock is no time that the student held

/// What is new in this picture.
struct Look {
  const Observation& seen;
  double dt_s = 0.0;  // simulated, since the last one
};

const messages::JointFrame* joint_of(const messages::SceneFrame& frame, int joint) {
  const auto place = static_cast<std::size_t>(joint);
  return joint >= 0 && place < frame.joints.size() ? &frame.joints[place] : nullptr;
}

/// The tool that touches the part, or null. Bones of one body cannot be distinguished by touch: they count as one.
const messages::ToolFrame* tool_on(const Part& part, const Observation& seen) {
  const int body = part.bone < 0 ? -1 : seen.specimen.bones[static_cast<std::size_t>(part.bone)].body;
  const auto touches = [&](const messages::ToolFrame& tool) {
    if (!tool.in_contact) return false;
    return part.muscle >= 0 ? tool.touched_muscle == part.muscle : body >= 0 && tool.touched_body == body;
  };
  const auto found = std::find_if(seen.frame.tools.begin(), seen.frame.tools.end(), touches);
  return found == seen.frame.tools.end() ? nullptr : &*found;
}

/// Two decimals are what an instrument on a screen shows.
std::string rounded(double value) {
  return to_text(std::round(value * 100.0) / 100.0);
}

/// Time counts back twice as fast as it ran, so that a short slip does not cost all of it.
void hold(bool holds, double dt_s, TaskState& state) {
  state.held_s = holds ? state.held_s + dt_s : std::max(0.0, state.held_s - 2.0 * dt_s);
}

void feel(const Part& part, const Look& look, TaskState& state) {
  state.held_s = tool_on(part, look.seen) != nullptr ? state.held_s + look.dt_s : 0.0;
  state.touched = state.touched || state.held_s >= kTouch_s;
}

void watch_task(const ReadTask&, const Look&, TaskState&) {}
void watch_task(const NameTask&, const Look&, TaskState&) {}

void watch_task(const FindTask& task, const Look& look, TaskState& state) {
  const Part now = look.seen.selected;
  const bool is_new = now != state.selected_before && now != Part{};
  state.selected_before = now;
  if (is_new) count_answer(now == task.part, key_of(look.seen.specimen, now), state);
}

void watch_task(const TouchTask& task, const Look& look, TaskState& state) {
  feel(task.part, look, state);
  if (state.touched) count_answer(true, key_of(look.seen.specimen, task.part), state);
}

void watch_task(const PressTask& task, const Look& look, TaskState& state) {
  const messages::ToolFrame* tool = tool_on({task.muscle, -1}, look.seen);
  const auto force = [&] { return std::hypot(tool->force_world_N[0], tool->force_world_N[1], tool->force_world_N[2]); };
  state.force_N = tool == nullptr ? 0.0 : force();
  hold(state.force_N >= task.low_N && state.force_N <= task.high_N, look.dt_s, state);
  if (state.held_s >= task.hold_s) count_answer(true, rounded(state.force_N), state);
}

void watch_task(const PredictTask& task, const Look& look, TaskState& state) {
  const messages::JointFrame* joint = joint_of(look.seen.frame, task.joint);
  const auto muscle = static_cast<std::size_t>(task.muscle);
  if (joint == nullptr || muscle >= joint->muscles.size()) return;
  state.moment_arm_m = joint->muscles[muscle].moment_arm_m;
  if (!state.predicted) return;
  const auto& tools = look.seen.frame.tools;
  const bool pulls = std::any_of(tools.begin(), tools.end(),
                                 [&](const messages::ToolFrame& tool) { return tool.grabbed_line == task.muscle; });
  if (pulls && !state.pulling) state.start_rad = joint->angle_rad;
  state.pulling = pulls;
  state.turned_rad = pulls ? joint->angle_rad - state.start_rad : 0.0;
  const double sign = task.motion == Motion::Flexion ? 1.0 : -1.0;
  if (sign * state.turned_rad < task.turn_rad) return;
  const bool right = *state.predicted == task.motion;
  count_answer(right, *state.predicted == Motion::Flexion ? "flexion" : "extension", state);
  state.done = true;  // seen is seen: there is no second guess
}

void watch_task(const StiffenTask& task, const Look& look, TaskState& state) {
  const messages::JointFrame* joint = joint_of(look.seen.frame, task.joint);
  if (joint == nullptr) return;
  state.stiffness_Nm_rad = joint->stiffness_Nm_rad;
  if (state.age_s < kSettle_s) {
    state.start_rad = joint->angle_rad;
    return;
  }
  // A joint that is barely or not at all stable is compared with what it has without muscles.
  const double lowest = std::max({state.stiffness_Nm_rad, joint->passive_Nm_rad, 1e-6});
  state.lowest_Nm_rad = state.lowest_Nm_rad > 0.0 ? std::min(state.lowest_Nm_rad, lowest) : lowest;
  state.turned_rad = joint->angle_rad - state.start_rad;
  const bool stiff = state.stiffness_Nm_rad >= task.factor * state.lowest_Nm_rad;
  hold(stiff && std::abs(state.turned_rad) <= task.within_rad, look.dt_s, state);
  if (state.held_s >= task.hold_s) count_answer(true, rounded(state.stiffness_Nm_rad), state);
}

void watch_task(const IdentifyTask& task, const Look& look, TaskState& state) {
  feel(task.part, look, state);
}

}  // namespace

void watch(const Task& task, const Observation& seen, TaskState& state) {
  if (!state.begun) {
    state.begun = true;
    state.frame_s = seen.frame.time_s;
    state.selected_before = seen.selected;
  }
  const double dt_s = std::clamp(seen.frame.time_s - state.frame_s, 0.0, kLongestPicture_s);
  state.frame_s = seen.frame.time_s;
  state.age_s += dt_s;
  std::visit([&](const auto& kind) { watch_task(kind, {seen, dt_s}, state); }, task);
}

void count_answer(bool right, const std::string& answer, TaskState& state) {
  ++state.attempts;
  state.answer = answer;
  state.feedback = right ? Feedback::Right : Feedback::Wrong;
  if (right) {
    state.done = state.right = true;
  } else {
    ++state.wrong;
  }
}

}  // namespace myotact::learn
