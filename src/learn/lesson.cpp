#include "learn/lesson.h"

#include <numeric>

namespace myotact::learn {

const char* kind_of(const Task& task) {
  static constexpr const char* kKinds[] = {"read", "find", "touch", "name", "press", "predict", "stiffen", "identify"};
  static_assert(std::size(kKinds) == std::variant_size_v<Task>);
  return kKinds[task.index()];
}

double most_points(const Lesson& lesson) {
  return std::accumulate(lesson.steps.begin(), lesson.steps.end(), 0.0,
                         [](double sum, const Step& step) { return sum + step.points; });
}

std::string key_of(const anatomy::Specimen& specimen, const Part& part) {
  if (part.muscle >= 0) return specimen.muscles[static_cast<std::size_t>(part.muscle)].key;
  if (part.bone >= 0) return specimen.bones[static_cast<std::size_t>(part.bone)].key;
  return "";
}

const std::vector<std::string>& colour_names() {
  static const std::vector<std::string> kNames = {"kind", "activation", "tension", "stretch", "pressure"};
  return kNames;
}

}  // namespace myotact::learn
