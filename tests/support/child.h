#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace myotact::testing {

/// Another process of this test, which ends with it at the latest.
class Child {
 public:
  /// Runs `arguments` with standard output in a file.
  Child(std::vector<std::string> arguments, std::filesystem::path output) : output_(std::move(output)) {
    pid_ = fork();
    if (pid_ != 0) return;
    const int file = open(output_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    execv(pointers[0], pointers.data());
    _exit(127);
  }
  ~Child() { end(SIGKILL); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Sends the signal and waits for the end; the exit status, or minus the signal that it died of.
  int end(int signal) {
    if (pid_ <= 0) return 0;
    kill(pid_, signal);
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  void send(int signal) const { kill(pid_, signal); }
  int pid() const { return pid_; }

  /// What stands after `word` and a blank in a line of its output; waits for it at most 60 s.
  std::string told(const std::string& word) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
      std::ifstream file(output_);
      for (std::string line; std::getline(file, line) && !file.eof();) {
        if (line.starts_with(word + " ")) return line.substr(word.size() + 1);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return "";
  }

 private:
  std::filesystem::path output_;
  int pid_ = -1;
};

}  // namespace myotact::testing
