#pragma once

#include <filesystem>
#include <string>

#include "anatomy/specimen.h"
#include "learn/lesson.h"

namespace myotact::learn {

/// A lesson file (assets/lessons/README.md) with every name resolved against the specimen of its scene. Throws Error
/// NoInput, or BadData that names file, place, value, what is allowed and the nearest known word.
Lesson load_lesson(const std::filesystem::path& path, const anatomy::Specimen& specimen);
/// The same from text; `file` is named in errors.
Lesson parse_lesson(const std::string& text, const std::string& file, const anatomy::Specimen& specimen);

/// What a list shows of a lesson, and its scene, without which its names mean nothing. Throws as load_lesson() does.
LessonHead load_lesson_head(const std::filesystem::path& path);

}  // namespace myotact::learn
