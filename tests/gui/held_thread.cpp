#include "gui/held_thread.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

namespace myotact::testing {

namespace {

std::filesystem::path tasks_of(pid_t process) {
  return std::filesystem::path("/proc") / std::to_string(process) / "task";
}

}  // namespace

std::vector<ListedThread> threads_of(pid_t process) {
  std::vector<ListedThread> threads;
  for (const auto& entry : std::filesystem::directory_iterator(tasks_of(process))) {
    ListedThread& thread = threads.emplace_back();
    thread.id = std::stoi(entry.path().filename());
    std::ifstream name(entry.path() / "comm");
    std::getline(name, thread.name);
  }
  return threads;
}

pid_t thread_named(pid_t process, const std::string& name) {
  for (const ListedThread& thread : threads_of(process)) {
    if (thread.name == name) return thread.id;
  }
  return -1;
}

long sleeps_of(pid_t process, pid_t thread) {
  std::ifstream status(tasks_of(process) / std::to_string(thread) / "status");
  constexpr const char* kKey = "voluntary_ctxt_switches:";
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(kKey)) return std::stol(line.substr(std::strlen(kKey)));
  }
  return -1;
}

std::string debugger_refused() {
  const pid_t child = ::fork();
  if (child == 0) {
    for (;;) ::pause();
  }
  std::string why;
  if (::ptrace(PTRACE_SEIZE, child, nullptr, nullptr) != 0) why = std::strerror(errno);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, __WALL);
  return why;
}

HeldThread::HeldThread(pid_t thread) : thread_(thread) {
  const bool held = ::ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr) == 0 &&
                    ::ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr) == 0;
  if (!held) throw std::runtime_error(std::string("the thread cannot be stopped: ") + std::strerror(errno));
  int status = 0;
  ::waitpid(thread_, &status, __WALL);
}

HeldThread::~HeldThread() {
  ::ptrace(PTRACE_DETACH, thread_, nullptr, nullptr);
}

}  // namespace myotact::testing
