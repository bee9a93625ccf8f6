#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace myotact::app {

/// Lines of a file descriptor, such as standard input, without waiting longer than one wants to.
class LineInput {
 public:
  explicit LineInput(int descriptor) : descriptor_(descriptor) {}

  /// The next line without its end, if it comes within `patience`. After the end of the input: empty lines, at once.
  std::optional<std::string> next(std::chrono::milliseconds patience);
  bool ended() const { return ended_; }

 private:
  std::optional<std::string> take_line();

  int descriptor_;
  std::string read_;  // and not yet given out
  bool ended_ = false;
};

}  // namespace myotact::app
