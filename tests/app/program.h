#pragma once

#include <filesystem>
#include <string>

namespace myotact::testing {

struct Outcome {
  int status = -1;     // exit status, or 128 + signal
  std::string output;  // standard output and standard error together
};

/// Runs the program with a shell, so that arguments may hold redirections and variables may stand before them.
Outcome run_program(const std::string& arguments, const std::string& before = "");

/// An empty folder of this test, removed when it goes out of scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace myotact::testing
