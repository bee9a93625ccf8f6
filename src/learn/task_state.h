#pragma once

#include <optional>
#include <string>

#include "learn/lesson.h"
#include "messages/scene_frame.h"

namespace myotact::learn {

/// What a lesson sees of scene and student in one picture.
struct Observation {
  const anatomy::Specimen& specimen;
  const messages::SceneFrame& frame;
  double clock_s = 0.0;  // rising; of the wall, or of a run without a window
  Part selected;         // what was clicked last
};

/// What is shown to a student about the last answer.
enum class Feedback { None, Right, Wrong, TouchFirst, PullNow };

/// Where a student stands in one step.
struct TaskState {
  bool done = false;   // answered for good, or left out
  bool right = false;  // and rightly in the end
  int attempts = 0;    // answers given
  int wrong = 0;       // of these
  int hints = 0;       // asked for
  double seconds = 0.0;
  std::string answer;  // the last one: a key, a word or a number
  Feedback feedback = Feedback::None;
  Part wrong_part;  // of the last wrong answer, where it was a part

  // As of the last picture, for the student to see.
  bool touched = false;  // the part asked for, long enough, now or before
  double held_s = 0.0;   // so long now, of the time that is asked for
  double force_N = 0.0;  // on the hand
  std::optional<Motion> predicted;
  double moment_arm_m = 0.0;  // of the muscle about the joint, positive flexes
  double turned_rad = 0.0;    // since the line was taken, positive flexed; or since the step began
  double stiffness_Nm_rad = 0.0, lowest_Nm_rad = 0.0;

  // To detect what is new.
  bool begun = false;
  double frame_s = 0.0;    // of the last picture
  double age_s = 0.0;      // simulated, since the step began
  double start_rad = 0.0;  // of the joint
  bool pulling = false;    // the line is in hand
  Part selected_before;
};

/// Follows what the student does; sets `done` and `right` when the task is fulfilled. Not for one that is done.
void watch(const Task& task, const Observation& seen, TaskState& state);

/// Counts an answer: what was clicked, chosen or typed, as the results list it.
void count_answer(bool right, const std::string& answer, TaskState& state);

}  // namespace myotact::learn
