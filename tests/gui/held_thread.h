#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace myotact::testing {

/// A thread of the program as the system lists it.
struct ListedThread {
  pid_t id = -1;
  std::string name;
};
std::vector<ListedThread> threads_of(pid_t process);
/// Of that name; -1 when there is none.
pid_t thread_named(pid_t process, const std::string& name);

/// How often a thread went to sleep so far and was woken again. A periodic thread does it once a period.
long sleeps_of(pid_t process, pid_t thread);

/// Whether this system lets a debugger stop a thread; if not, why.
std::string debugger_refused();

/// One thread of a child process, stopped as by a debugger for as long as this lives; its other threads go on.
/// The thread that made this also ends it.
class HeldThread {
 public:
  explicit HeldThread(pid_t thread);  // throws when it cannot be stopped
  ~HeldThread();
  HeldThread(const HeldThread&) = delete;
  HeldThread& operator=(const HeldThread&) = delete;

 private:
  pid_t thread_;
};

}  // namespace myotact::testing
