#pragma once

#include <string>

#include "anatomy/part_facts.h"
#include "anatomy/specimen.h"
#include "learn/lesson_file.h"
#include "support/source_folder.h"

namespace myotact::testing {

/// The canine elbow of the repository.
inline const anatomy::Specimen& elbow() {
  static const anatomy::Specimen kElbow =
      anatomy::load_specimen(std::filesystem::path(source_folder()) / "meshes" / "canine_elbow");
  return kElbow;
}

/// One synonym.
inline const anatomy::FactsByKey& facts() {
  static const anatomy::FactsByKey kFacts = {{"ulna", {{"elbow bone"}, "", "", "", "", "", ""}}};
  return kFacts;
}

/// A lesson of the elbow whose only step holds these members, the first of them the task.
inline std::string lesson_text(const std::string& members) {
  return R"({"schema": 1, "key": "l", "title": "T", "scene": "elbow", "steps": [{"title": "S", "text": "X", )" +
         members + "}]}";
}

inline learn::Lesson lesson_of(const std::string& members) {
  return learn::parse_lesson(lesson_text(members), "l.json", elbow());
}

}  // namespace myotact::testing
