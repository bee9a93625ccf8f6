#include "prepare/volume/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"

namespace myotact::prepare {

namespace {

constexpr std::size_t kBuffer_bytes = std::size_t{1} << 16;  // as much as a read of a disk gives at once

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path) : path_(path) {
    // Non-blocking, so that a named pipe cannot hang the program before it is refused below.
    fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd_ < 0) throw failure(ExitStatus::NoInput, "cannot be opened");
    struct stat status {};
    const bool known = ::fstat(fd_, &status) == 0;
    if (known && S_ISREG(status.st_mode)) {
      left_ = static_cast<std::uint64_t>(status.st_size);
      return;
    }
    ::close(fd_);
    throw bad_data(path.string(), "", "is not a regular file; name a file");
  }
  ~FileSource() override { ::close(fd_); }

 protected:
  std::size_t refill(char* out, std::size_t room) override {
    while (true) {
      const ssize_t got = ::read(fd_, out, room);
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) throw failure(ExitStatus::InputOutput, "cannot be read");
      left_ -= std::min(left_, static_cast<std::uint64_t>(got));
      return static_cast<std::size_t>(got);
    }
  }
  std::uint64_t most_left_to_refill() const override { return left_; }

 private:
  Error failure(ExitStatus status, const char* doing) const {
    return {status, fmt::format("{}: {}: {}. Check the path, its permissions and the disk.", path_.string(), doing,
                                std::strerror(errno))};
  }

  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t left_ = 0;
};

class MemorySource final : public ByteSource {
 public:
  explicit MemorySource(std::string_view bytes) : rest_(bytes) {}

 protected:
  std::size_t refill(char* out, std::size_t room) override {
    const std::size_t got = rest_.copy(out, room);
    rest_.remove_prefix(got);
    return got;
  }
  std::uint64_t most_left_to_refill() const override { return rest_.size(); }

 private:
  std::string_view rest_;
};

}  // namespace

ByteSource::ByteSource() : buffer_(kBuffer_bytes) {}

bool ByteSource::fill() {
  begin_ = 0;
  end_ = refill(buffer_.data(), buffer_.size());
  return end_ > 0;
}

std::size_t ByteSource::read(char* out, std::size_t wanted) {
  std::size_t got = 0;
  while (got < wanted && (begin_ < end_ || fill())) {
    const std::size_t part = std::min(wanted - got, end_ - begin_);
    std::memcpy(out + got, buffer_.data() + begin_, part);
    begin_ += part;
    got += part;
  }
  return got;
}

std::optional<std::string> ByteSource::line(std::size_t longest) {
  if (begin_ == end_ && !fill()) return {};
  std::string text;
  while (begin_ < end_ || fill()) {
    const char* first = buffer_.data() + begin_;
    const auto* end = static_cast<const char*>(std::memchr(first, '\n', end_ - begin_));
    const std::size_t part = end ? static_cast<std::size_t>(end - first) : end_ - begin_;
    text.append(first, std::min(part, longest - text.size()));
    begin_ += part + (end ? 1 : 0);
    if (end) break;
  }
  if (text.ends_with('\r')) text.pop_back();
  return text;
}

std::uint64_t ByteSource::skip(std::uint64_t wanted) {
  std::uint64_t got = 0;
  while (got < wanted && (begin_ < end_ || fill())) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(wanted - got, end_ - begin_));
    begin_ += part;
    got += part;
  }
  return got;
}

std::string_view ByteSource::peek(std::size_t wanted) {
  if (end_ - begin_ < wanted) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    while (end_ < wanted) {
      const std::size_t got = refill(buffer_.data() + end_, buffer_.size() - end_);
      if (got == 0) break;
      end_ += got;
    }
  }
  return {buffer_.data() + begin_, std::min(wanted, end_ - begin_)};
}

std::uint64_t ByteSource::most_left() const {
  return (end_ - begin_) + most_left_to_refill();
}

std::unique_ptr<ByteSource> open_bytes(const std::filesystem::path& path) {
  return std::make_unique<FileSource>(path);
}

std::unique_ptr<ByteSource> bytes_in_memory(std::string_view bytes) {
  return std::make_unique<MemorySource>(bytes);
}

}  // namespace myotact::prepare
