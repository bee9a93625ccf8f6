#pragma once

#include <string>

namespace myotact::realtime {

struct RealTimePermission {
  bool granted = false;
  std::string why_not;  // what was refused and how to allow it; empty when granted
};

/// Asks for SCHED_FIFO for the calling thread and keeps the process's present memory from being paged out. The thread
/// runs on without either when they are refused. Not real-time safe.
RealTimePermission make_this_thread_real_time();

/// What debuggers and lists of threads call this one; at most 15 letters.
void name_this_thread(const char* name) noexcept;

}  // namespace myotact::realtime
