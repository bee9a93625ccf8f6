#pragma once

#include <chrono>

namespace myotact::app {

/// Shows on standard error how far long work has come: a bar where that is a terminal, else a plain line every few
/// seconds; nothing when the log level hides information. One thread at a time.
class Progress {
 public:
  Progress();
  ~Progress();  // leaves the bar's line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(int done, int all);
  double seconds() const;  // since it was made

 private:
  const bool wanted_, terminal_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double shown_s_ = 0.0;
  bool open_line_ = false;
};

}  // namespace myotact::app
