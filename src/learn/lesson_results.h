#pragma once

#include <string>

#include "learn/lesson_run.h"

namespace myotact::learn {

/// What came of a lesson: a head line, then one line a step with a task (CSV, RFC 4180): lesson, step (from 1), task,
/// answer, right (0 or 1), attempts, hints, seconds, score. The same in every locale.
std::string results_csv(const LessonRun& run);

/// A file name made of what a student typed, with ".csv"; letters that file systems refuse become "_". Empty where
/// nothing usable was typed.
std::string results_file_name(const std::string& student, const std::string& lesson_key);

}  // namespace myotact::learn
