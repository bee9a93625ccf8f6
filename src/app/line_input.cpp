#include "app/line_input.h"

#include <array>
#include <cerrno>

#include <poll.h>
#include <unistd.h>

namespace myotact::app {

std::optional<std::string> LineInput::take_line() {
  const std::size_t end = read_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = read_.substr(0, end);
  read_.erase(0, end + 1);
  return line;
}

std::optional<std::string> LineInput::next(std::chrono::milliseconds patience) {
  if (auto line = take_line()) return line;
  if (ended_) return "";
  pollfd waiting{descriptor_, POLLIN, 0};
  if (poll(&waiting, 1, static_cast<int>(patience.count())) <= 0) return std::nullopt;
  std::array<char, 256> bytes{};
  const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
  if (count < 0 && errno == EINTR) return std::nullopt;
  ended_ = count <= 0;
  if (count > 0) read_.append(bytes.data(), static_cast<std::size_t>(count));
  return take_line();
}

}  // namespace myotact::app
