#include "learn/lesson_results.h"

#include <cmath>

#include <fmt/format.h>

#include "core/csv.h"
#include "core/text.h"

namespace myotact::learn {

namespace {

std::string rounded(double value) {
  return to_text(std::round(value * 100.0) / 100.0);
}

}  // namespace

std::string results_csv(const LessonRun& run) {
  std::string csv = "lesson,step,task,answer,right,attempts,hints,seconds,score\n";
  for (std::size_t i = 0; i < run.states().size(); ++i) {
    const Step& step = run.lesson().steps[i];
    const TaskState& state = run.states()[i];
    if (std::holds_alternative<ReadTask>(step.task)) continue;
    csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_field(run.lesson().key), i + 1, kind_of(step.task),
                       csv_field(state.answer), state.right ? 1 : 0, state.attempts, state.hints,
                       rounded(state.seconds), rounded(points_of(step, state)));
  }
  return csv;
}

std::string results_file_name(const std::string& student, const std::string& lesson_key) {
  constexpr std::size_t kLongest = 80;  // bytes; file systems support 255
  std::string name;
  for (const char c : student.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || byte >= 0x80;
    name += plain ? c : '_';
  }
  if (name.find_first_not_of('_') == std::string::npos) return "";
  return name + "_" + lesson_key + ".csv";
}

}  // namespace myotact::learn
