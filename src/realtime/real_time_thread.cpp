#include "realtime/real_time_thread.h"

#include <cerrno>
#include <cstring>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>

namespace myotact::realtime {

namespace {

/// Above ordinary threads and below the kernel's own interrupt threads, which Debian runs at 50.
constexpr int kPriority = 40;

void add_reason(std::string& text, const std::string& reason) {
  text += (text.empty() ? "" : "; ") + reason;
}

}  // namespace

RealTimePermission make_this_thread_real_time() {
  RealTimePermission permission;
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters); error != 0) {
    add_reason(permission.why_not, std::string("real-time priority refused (") + std::strerror(error) +
                                       "): allow rtprio 40 in /etc/security/limits.conf or give CAP_SYS_NICE");
  }
  // Not MCL_FUTURE: under a memory-lock limit it would make later allocations of the whole process fail.
  if (mlockall(MCL_CURRENT) != 0) {
    add_reason(permission.why_not, std::string("locking of memory refused (") + std::strerror(errno) +
                                       "): allow memlock in /etc/security/limits.conf or give CAP_IPC_LOCK");
  }
  permission.granted = permission.why_not.empty();
  return permission;
}

void name_this_thread(const char* name) noexcept {
  pthread_setname_np(pthread_self(), name);
}

}  // namespace myotact::realtime
