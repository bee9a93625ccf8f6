#include "core/file.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"

namespace myotact {

namespace {

/// Owns a POSIX file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

Error io_error(const std::filesystem::path& path, const char* doing) {
  return {ExitStatus::InputOutput, fmt::format("{}: {}: {}. Check the folder, its permissions and the free space.",
                                               path.string(), doing, std::strerror(errno))};
}

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

void probe_folder(const std::filesystem::path& folder) {
  std::string probe = (folder / ".writable.XXXXXX").string();
  const Descriptor file(::mkostemp(probe.data(), O_CLOEXEC));
  if (file.get() < 0) throw io_error(folder, "cannot be written to");
  ::unlink(probe.c_str());
}

/// The rename at the end of a write would put a file in the place of a device.
void refuse_special(const std::filesystem::path& path) {
  if (!path.has_filename()) {
    throw Error(ExitStatus::InputOutput, fmt::format("\"{}\": names no file; give the name of one", path.string()));
  }
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode)) return;
  throw Error(ExitStatus::InputOutput,
              fmt::format("{}: cannot be written: it is a {}, not a file; give another name", path.string(),
                          S_ISDIR(status.st_mode) ? "folder" : "device or pipe"));
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  // Non-blocking, so that a named pipe cannot hang the program before it is refused below.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.get() < 0) {
    throw Error(ExitStatus::NoInput, fmt::format("{}: cannot be opened: {}. Check the path and its permissions.",
                                                 path.string(), std::strerror(errno)));
  }
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) throw io_error(path, "cannot be examined");
  if (!S_ISREG(status.st_mode)) throw bad_data(path.string(), "", "is not a regular file; name a file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > kLargestInput_bytes) {
    throw bad_data(path.string(), "", fmt::format("has {} bytes; at most {} are read", size, kLargestInput_bytes));
  }
  std::string bytes(size, '\0');
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t got = ::read(file.get(), bytes.data() + filled, size - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw io_error(path, "cannot be read");
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes.resize(filled);
  return bytes;
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  refuse_special(path);
  std::string temporary = path.string() + ".XXXXXX";
  const Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
  if (file.get() < 0) throw io_error(path, "cannot be written");
  constexpr mode_t kReadableByAll = 0644;
  const bool stored = write_all(file.get(), bytes) && ::fchmod(file.get(), kReadableByAll) == 0 &&
                      ::fsync(file.get()) == 0 && ::rename(temporary.c_str(), path.c_str()) == 0;
  if (!stored) {
    const Error error = io_error(path, "cannot be written");
    ::unlink(temporary.c_str());
    throw error;
  }
}

std::optional<std::filesystem::path> set_aside(const std::filesystem::path& path) {
  const std::filesystem::path aside = path.string() + ".broken";
  std::error_code refused;
  std::filesystem::rename(path, aside, refused);
  return refused ? std::nullopt : std::optional(aside);
}

void make_writable_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) {
    errno = failure.value();
    throw io_error(folder, "cannot be made");
  }
  probe_folder(folder);
}

void require_writable(const std::filesystem::path& path) {
  refuse_special(path);
  probe_folder(path.has_parent_path() ? path.parent_path() : ".");
}

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr) != 1) {
    throw Error(ExitStatus::Internal, "SHA-256 is not available from the system's libcrypto");
  }
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

}  // namespace myotact
