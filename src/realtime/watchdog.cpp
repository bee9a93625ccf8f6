#include "realtime/watchdog.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "realtime/periodic_loop.h"

namespace myotact::realtime {

namespace {

constexpr std::uint64_t kHangs_ns = 60'000'000;
constexpr int kLook_ms = 5;
constexpr int kPriority = 41;  // one above the haptic thread, which it must catch when that one never sleeps

/// What this process starts with as a process of its own: the program's signals and terminal are not its own.
void leave_the_program() noexcept {
  ::setsid();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) ::signal(signal, SIG_IGN);
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) ::signal(signal, SIG_DFL);
  ::prctl(PR_SET_NAME, "myotact-watch");
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  ::sched_setscheduler(0, SCHED_FIFO, &parameters);  // where it is refused, ordinary priority has to do
  // Whoever reads the program's output to its end must not wait for this process.
  if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0) {
    for (int stream = 0; stream < 3; ++stream) ::dup2(nowhere, stream);
    if (nowhere > 2) ::close(nowhere);
  }
}

bool program_is_gone(int pipe_end) noexcept {
  pollfd waits{pipe_end, POLLIN, 0};
  return ::poll(&waits, 1, kLook_ms) > 0;  // nothing is ever written: an event is the end
}

}  // namespace

Watchdog::Watchdog(ForceCutout& cutout) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "watchdog's pipe");
  process_ = ::fork();
  if (process_ == 0) {
    ::close(ends[1]);
    watch(ends[0], cutout);
  }
  ::close(ends[0]);
  pipe_ = ends[1];
  if (process_ < 0) {
    const int error = errno;
    ::close(pipe_);
    throw std::system_error(error, std::generic_category(), "watchdog's process");
  }
  while (!page_->ready.load(std::memory_order_acquire)) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0) {
      ::close(pipe_);
      throw std::system_error(ECHILD, std::generic_category(), "watchdog's process");
    }
    ::usleep(100);
  }
}

Watchdog::~Watchdog() {
  ::close(pipe_);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Watchdog::watch(int pipe_end, ForceCutout& cutout) noexcept {
  leave_the_program();
  page_->ready.store(true, std::memory_order_release);
  std::uint64_t last_beat = 0;
  std::uint64_t since_ns = steady_now_ns();
  while (!program_is_gone(pipe_end)) {
    const std::uint64_t beat = page_->beats.load(std::memory_order_acquire);
    const std::uint64_t now_ns = steady_now_ns();
    if (beat != last_beat) {
      last_beat = beat;
      since_ns = now_ns;
    }
    if (beat == 0 || now_ns - since_ns < kHangs_ns) continue;
    cutout.cut();
    page_->tripped.store(true, std::memory_order_release);
  }
  cutout.cut();
  ::_exit(0);
}

}  // namespace myotact::realtime
