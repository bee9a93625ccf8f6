#pragma once

#include <chrono>
#include <string>

#include "prepare/prepare_limb.h"

namespace myotact::prepare {

/// Draws progress on one line of standard error when that is a terminal: stage, parts, time left.
class ProgressBar {
 public:
  ProgressBar();
  /// Wipes the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  bool on_terminal_;
  Clock::time_point start_ = Clock::now();
};

/// "part            12/33  [#######.............]  0:21 left"
std::string progress_line(const Progress& progress, double elapsed_s);

}  // namespace myotact::prepare
