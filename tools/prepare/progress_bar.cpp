#include "prepare/progress_bar.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace myotact::prepare {

namespace {

constexpr int kBarWidth = 30;
/// Below this part of the work the time left is a guess that would only alarm.
constexpr double kKnown = 0.02;

}  // namespace

std::string progress_line(const Progress& progress, double elapsed_s) {
  const int full = static_cast<int>(std::lround(progress.whole * kBarWidth));
  std::string left;
  if (progress.whole > kKnown) {
    const int seconds = static_cast<int>(elapsed_s * (1.0 - progress.whole) / progress.whole);
    left = fmt::format("{}:{:02} left", seconds / 60, seconds % 60);
  }
  return fmt::format("{:<15} {:>3}/{:<3} [{}{}] {}", progress.stage, progress.done, progress.parts,
                     std::string(static_cast<std::size_t>(full), '#'),
                     std::string(static_cast<std::size_t>(kBarWidth - full), '.'), left);
}

ProgressBar::ProgressBar() : on_terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (on_terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(const Progress& progress) {
  if (!on_terminal_) return;
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  std::fputs(("\r\033[K" + progress_line(progress, elapsed_s)).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace myotact::prepare
