#include <chrono>
#include <iostream>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "app/interruption.h"
#include "app/options.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "exchange/febio_read.h"
#include "measure/solve_answer.h"

namespace myotact::app {

namespace {

using Clock = std::chrono::steady_clock;

/// A signal came: the solve ends where it is, and nothing has been written.
struct Stopped {
  int status = 0;
};

/// One line on standard error for solves that take longer than a second: rewritten on a terminal, repeated every few
/// seconds in a log.
class ProgressLine {
 public:
  ~ProgressLine() { end(); }

  void show(const measure::SolveProgress& progress) {
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    next_ = now + (on_terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(5));
    const std::string line = fmt::format("solve: at {:.0f} %, {} Newton steps, out of balance {:.1e}",
                                         100.0 * progress.share, progress.iterations, progress.residual_share);
    std::cerr << (on_terminal_ ? "\r" : "") << line << (on_terminal_ ? " " : "\n") << std::flush;
    shown_ = true;
  }

  /// The line stays and what follows begins a new one.
  void end() {
    if (shown_ && on_terminal_) std::cerr << '\n' << std::flush;
    shown_ = false;
  }

 private:
  bool on_terminal_ = ::isatty(STDERR_FILENO) == 1;
  bool shown_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
};

measure::SolveAnswer solve_watched(const measure::SolveCase& input) {
  ProgressLine line;
  return measure::solve_case(input, [&](const measure::SolveProgress& progress) {
    if (const int status = interruption(); status != 0) throw Stopped{status};
    line.show(progress);
  });
}

/// A case of ours, or a model of FEBio as one.
measure::SolveCase case_of(const std::filesystem::path& file) {
  if (lower(file.extension().string()) != ".feb") return measure::load_case(file);
  exchange::FebioCase febio = exchange::read_febio(file);
  if (!febio.left_out.empty()) {
    spdlog::info("{}: left out, since it changes no answer: {}", file.string(), join(febio.left_out, "; "));
  }
  return std::move(febio.solve_case);
}

std::string what_stopped(const measure::SolveCase& input, const measure::SolveAnswer& answer) {
  const bool is_static = input.dynamics == measure::Dynamics::Static;
  const std::string remedy = is_static ? "load less, give \"ramp\" more steps, or mesh finer where it folds"
                                       : "load less, or give a smaller dt_s";
  if (answer.steps == 0) {
    return fmt::format(
        "no equilibrium under the first part of the {}: the answer is the body at rest; see whether loads "
        "and stiffnesses are in Pa, {}",
        is_static ? "load" : "motion", remedy);
  }
  std::string inside_out;
  if (!(answer.least_volume_ratio > 0.0)) {
    inside_out = fmt::format(", with tet {} inside out (volume ratio {}; must be > 0)", answer.most_crushed_tet,
                             to_text(answer.least_volume_ratio));
  }
  return fmt::format("the answer is the last state in equilibrium, at {} of the {}{}; {}", to_text(answer.reached),
                     is_static ? "load" : "time", inside_out, remedy);
}

}  // namespace

int solve(const Options& options) {
  watch_for_interruption();
  try {
    const measure::SolveCase input = case_of(options.file);
    // Before a solve that may be long, not after it.
    if (options.vtk && options.vtk->has_parent_path()) make_writable_folder(options.vtk->parent_path());
    if (options.vtk) require_writable(*options.vtk);
    const measure::SolveAnswer answer = solve_watched(input);
    if (const int status = interruption(); status != 0) return status;
    if (options.vtk) geometry::write_vtk(answer.deformed, answer.results, *options.vtk);
    std::cout << measure::answer_json(answer) << std::flush;
    if (answer.converged) return static_cast<int>(ExitStatus::Done);
    spdlog::error("{}: did not converge: {}", options.file.string(), what_stopped(input, answer));
    return static_cast<int>(ExitStatus::CheckFailed);
  } catch (const Stopped& stopped) {
    return stopped.status;
  }
}

}  // namespace myotact::app
