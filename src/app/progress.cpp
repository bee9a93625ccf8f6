#include "app/progress.h"

#include <iostream>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

namespace myotact::app {

namespace {

constexpr double kBarPeriod_s = 0.1;   // as smooth as a bar needs to be
constexpr double kLinePeriod_s = 5.0;  // log files stay short
constexpr int kBarWidth = 30;

}  // namespace

Progress::Progress() : wanted_(spdlog::should_log(spdlog::level::info)), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (open_line_) std::cerr << '\n' << std::flush;
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::show(int done, int all) {
  const double now_s = seconds();
  const bool last = done == all;
  if (!wanted_ || done <= 0 || all <= 0) return;
  if (now_s - shown_s_ < (terminal_ ? kBarPeriod_s : kLinePeriod_s) && !(last && terminal_)) return;
  shown_s_ = now_s;
  const double left_s = now_s * (all - done) / done;
  const std::string text = fmt::format("{} of {}, about {:.0f} s left", done, all, left_s);
  if (!terminal_) {
    spdlog::info("{}", text);
    return;
  }
  const auto full = static_cast<std::size_t>(kBarWidth * done / all);
  const std::string bar = std::string(full, '#') + std::string(kBarWidth - full, '.');
  std::cerr << "\r[" << bar << "] " << text << "   " << std::flush;
  open_line_ = true;
}

}  // namespace myotact::app
