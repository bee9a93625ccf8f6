#pragma once

#include <functional>
#include <string>

namespace myotact::prepare {

/// How a child process ended, and what its work returned when it was done.
struct ChildResult {
  enum class End { Done, TimedOut, Signalled, Failed };
  End end = End::Failed;
  int signal = 0;  // when it was ended by one
  std::string bytes;
};

/// Runs the work in a child process with a limit on its processor time, because libraries that are given odd surfaces
/// end their process or go round in circles. The clock on the wall does not count: what comes out would depend on what
/// else the machine does. The work must not touch other threads' locks.
/// Throws Error Internal when no child can be made.
ChildResult run_in_child(const std::function<std::string()>& work, int limit_cpu_s);

}  // namespace myotact::prepare
