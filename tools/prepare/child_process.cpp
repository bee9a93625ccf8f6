#include "prepare/child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

namespace myotact::prepare {

namespace {

/// A child that neither works nor ends (it waits for a lock) meets a limit, too, and one on a busy machine does not.
constexpr int kClockPerCpu = 10;

void write_all(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(pipe, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) ::_exit(3);
    bytes.remove_prefix(static_cast<std::size_t>(done));
  }
}

void set_limits(int limit_cpu_s) {
  const auto cpu_s = static_cast<rlim_t>(limit_cpu_s);
  const rlimit cpu{cpu_s, cpu_s + 1};  // equal limits would end it by a signal that does not show why
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CPU, &cpu);
  ::setrlimit(RLIMIT_CORE, &no_core);
}

/// The child's whole life. Faults end it by the system's default, whatever handlers the parent had.
[[noreturn]] void run_child(const std::function<std::string()>& work, int limit_cpu_s, int pipe) {
  // Pipes of children that other threads started: as long as this one held them, too, their readers would wait for it.
  constexpr int kOwnPipe = STDERR_FILENO + 1;
  ::dup2(pipe, kOwnPipe);
  ::close_range(kOwnPipe + 1, ~0U, 0);
  pipe = kOwnPipe;
  for (const int fault : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) ::signal(fault, SIG_DFL);
  set_limits(limit_cpu_s);
  const int silent = ::open("/dev/null", O_WRONLY);
  if (silent >= 0) {  // TetGen talks on standard output, which carries data
    ::dup2(silent, STDOUT_FILENO);
    ::dup2(silent, STDERR_FILENO);
  }
  try {
    write_all(pipe, work());
    ::_exit(0);
  } catch (...) {
    ::_exit(2);
  }
}

/// All that the child writes; stops at the time limit with what there is.
std::string read_until_closed(int pipe, int limit_s, bool& timed_out) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(limit_s);
  std::string bytes;
  std::vector<char> chunk(1 << 16);
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd wait{pipe, POLLIN, 0};
    const int ready = ::poll(&wait, 1, static_cast<int>(std::max<long long>(left, 0)));
    if (ready < 0 && errno == EINTR) continue;
    timed_out = ready == 0;
    if (ready <= 0) return bytes;
    const ssize_t got = ::read(pipe, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(chunk.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

ChildResult run_in_child(const std::function<std::string()>& work, int limit_cpu_s) {
  using End = ChildResult::End;
  int ends[2] = {-1, -1};
  if (::pipe(ends) != 0) throw Error(ExitStatus::Internal, std::string("cannot make a pipe: ") + std::strerror(errno));
  const pid_t child = ::fork();
  if (child < 0) {
    throw Error(ExitStatus::Internal, std::string("cannot start a process: ") + std::strerror(errno));
  }
  if (child == 0) {
    ::close(ends[0]);
    run_child(work, limit_cpu_s, ends[1]);
  }
  ::close(ends[1]);
  bool timed_out = false;
  ChildResult result;
  result.bytes = read_until_closed(ends[0], kClockPerCpu * limit_cpu_s, timed_out);
  ::close(ends[0]);
  if (timed_out) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (timed_out || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)) {
    result.end = End::TimedOut;
  } else if (WIFSIGNALED(status)) {
    result.end = End::Signalled;
    result.signal = WTERMSIG(status);
  } else {
    result.end = WEXITSTATUS(status) == 0 ? End::Done : End::Failed;
  }
  return result;
}

}  // namespace myotact::prepare
