#include "learn/lesson_run.h"

#include <algorithm>

namespace myotact::learn {

LessonRun::LessonRun(const Lesson& lesson, const anatomy::Specimen& specimen, const anatomy::FactsByKey& facts)
    : lesson_(&lesson), specimen_(&specimen), facts_(&facts), states_(lesson.steps.size()) {}

void LessonRun::observe(const Observation& seen) {
  constexpr double kLongestPicture_s = 5.0;  // longer ones are a machine that slept
  const double passed_s = clock_runs_ ? std::clamp(seen.clock_s - clock_s_, 0.0, kLongestPicture_s) : 0.0;
  clock_s_ = seen.clock_s;
  clock_runs_ = true;
  if (finished_ || now().done) return;
  now().seconds += passed_s;
  watch(step().task, seen, now());
}

void LessonRun::choose(std::size_t option) {
  if (finished_ || now().done) return;
  const auto answer = [&](const Part& right, const std::vector<Part>& options) {
    if (option >= options.size()) return;
    count_answer(options[option] == right, key_of(*specimen_, options[option]), now());
  };
  if (const auto* name = std::get_if<NameTask>(&step().task)) return answer(name->part, name->options);
  const auto* identify = std::get_if<IdentifyTask>(&step().task);
  if (identify == nullptr) return;
  if (!now().touched) {
    now().feedback = Feedback::TouchFirst;
    return;
  }
  answer(identify->part, identify->options);
}

void LessonRun::type(const std::string& name) {
  const auto* task = std::get_if<NameTask>(&step().task);
  if (task == nullptr || finished_ || now().done) return;
  count_answer(names_part(name, task->part, {*specimen_, *facts_, task->accept}), name, now());
}

void LessonRun::predict(Motion motion) {
  if (!std::holds_alternative<PredictTask>(step().task) || finished_ || now().done || now().predicted) return;
  now().predicted = motion;
  now().feedback = Feedback::PullNow;
}

void LessonRun::ask_hint() {
  const int left = static_cast<int>(step().hints.size()) - now().hints;
  if (!finished_ && !now().done && left > 0) ++now().hints;
}

void LessonRun::go_on() {
  if (finished_) return;
  if (std::holds_alternative<ReadTask>(step().task)) now().right = true;
  now().done = true;
  if (index_ + 1 < states_.size()) {
    ++index_;
  } else {
    finished_ = true;
  }
}

void LessonRun::go_back() {
  if (finished_) {
    finished_ = false;
  } else if (index_ > 0) {
    --index_;
  }
}

double LessonRun::score() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < states_.size(); ++i) sum += points_of(lesson_->steps[i], states_[i]);
  return sum;
}

double points_of(const Step& step, const TaskState& state) {
  const bool seen = std::holds_alternative<PredictTask>(step.task) && state.attempts > 0;
  if (!state.right && !seen) return 0.0;
  return step.points * std::max(0.0, 1.0 - 0.25 * state.hints - 0.5 * state.wrong);
}

}  // namespace myotact::learn
