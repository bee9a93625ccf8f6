#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "anatomy/part_facts.h"
#include "anatomy/specimen.h"
#include "learn/lesson.h"
#include "learn/task_state.h"

namespace myotact::learn {

/// A student's way through a lesson: which step, what was answered, how many points. Fed once a picture, in a window
/// and without one alike. One thread.
class LessonRun {
 public:
  /// `facts`: other names of the parts that may be typed. All outlive the run.
  LessonRun(const Lesson& lesson, const anatomy::Specimen& specimen, const anatomy::FactsByKey& facts);

  void observe(const Observation& seen);

  // The student's answers; ignored where the task is of another kind, or done.
  void choose(std::size_t option);     // of name and identify
  void type(const std::string& name);  // of name
  void predict(Motion motion);         // before pulling
  /// Counts one more hint where the step has one left.
  void ask_hint();
  /// To the next step; a task that is not done counts as left out. After the last step the lesson is finished.
  void go_on();
  void go_back();

  const Lesson& lesson() const { return *lesson_; }
  const Step& step() const { return lesson_->steps[index_]; }
  const TaskState& state() const { return states_[index_]; }
  std::size_t index() const { return index_; }  // of the step
  bool finished() const { return finished_; }
  const std::vector<TaskState>& states() const { return states_; }  // as the steps
  double score() const;

 private:
  TaskState& now() { return states_[index_]; }

  const Lesson* lesson_;
  const anatomy::Specimen* specimen_;
  const anatomy::FactsByKey* facts_;
  std::vector<TaskState> states_;
  std::size_t index_ = 0;
  double clock_s_ = 0.0;
  bool clock_runs_ = false;
  bool finished_ = false;
};

/// Points of a step: all of them for a right answer without help; each hint takes a quarter, each wrong answer half,
/// never below none. A wrong prediction that the pull has put right still earns the half.
double points_of(const Step& step, const TaskState& state);

/// What a typed name is compared with.
struct NameBook {
  const anatomy::Specimen& specimen;
  const anatomy::FactsByKey& facts;
  const std::vector<std::string>& accept;  // of the part asked for, besides its own
};

/// Whether the text names the part: its key, Latin or English name, a synonym or one of `accept`, capitals and spaces
/// aside, "m." for "musculus", and with one slip of typing in each long word, unless that is another part's name.
bool names_part(const std::string& text, const Part& part, const NameBook& book);

}  // namespace myotact::learn
