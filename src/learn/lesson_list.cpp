#include "learn/lesson_list.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/text.h"
#include "core/user_folder.h"
#include "learn/lesson_file.h"

namespace myotact::learn {

namespace {

/// The number in front of a name; a name without one comes last.
unsigned long number_of(const std::filesystem::path& file) {
  const std::string name = file.filename().string();
  unsigned long number = std::numeric_limits<unsigned long>::max();
  std::from_chars(name.data(), name.data() + name.size(), number);
  return number;
}

/// As lessons are counted: 2 before 10.
bool comes_before(const std::filesystem::path& a, const std::filesystem::path& b) {
  return std::tuple(number_of(a), a) < std::tuple(number_of(b), b);
}

void add_folder(const std::filesystem::path& folder, std::vector<ListedLesson>& lessons) {
  std::error_code failure;  // no folder, no lessons
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failure)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), comes_before);
  for (const std::filesystem::path& file : files) {
    ListedLesson lesson{file, {}, ""};
    try {
      lesson.head = load_lesson_head(file);
    } catch (const Error& error) {
      lesson.complaint = error.what();
    }
    lessons.push_back(lesson);
  }
}

}  // namespace

std::filesystem::path own_lessons_folder() {
  const std::filesystem::path own = user_data_folder();
  return own.empty() ? own : own / "lessons";
}

std::vector<ListedLesson> list_lessons() {
  std::vector<ListedLesson> lessons;
  add_folder(data_folder() / "assets" / "lessons", lessons);
  if (const auto own = own_lessons_folder(); !own.empty()) add_folder(own, lessons);
  return lessons;
}

std::filesystem::path find_lesson(const std::string& name_or_path) {
  std::vector<std::string> names;
  for (const ListedLesson& lesson : list_lessons()) {
    const std::string stem = lesson.path.stem().string();
    if (name_or_path == stem || (!lesson.head.key.empty() && name_or_path == lesson.head.key)) return lesson.path;
    names.push_back(lesson.head.key.empty() ? stem : lesson.head.key);
  }
  if (std::filesystem::exists(name_or_path)) return name_or_path;
  throw Error(ExitStatus::NoInput,
              fmt::format("{}: no such lesson or file; there are {} (nearest: {}), and your own in {}", name_or_path,
                          join(names), nearest_word(name_or_path, names), own_lessons_folder().string()));
}

}  // namespace myotact::learn
