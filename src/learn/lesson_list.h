#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "learn/lesson.h"

namespace myotact::learn {

/// A lesson file that was found.
struct ListedLesson {
  std::filesystem::path path;
  LessonHead head;        // where it can be read
  std::string complaint;  // what is wrong with it otherwise
};

/// Where a person's own lessons lie: $XDG_DATA_HOME/myotact/lessons, or ~/.local/share in its place. Empty without a
/// home.
std::filesystem::path own_lessons_folder();

/// The shipped lessons, then the person's own, each by file name; broken ones too.
std::vector<ListedLesson> list_lessons();

/// Path of a lesson: of a listed one by its key or file name, or any file. Throws Error NoInput that names the nearest.
std::filesystem::path find_lesson(const std::string& name_or_path);

}  // namespace myotact::learn
