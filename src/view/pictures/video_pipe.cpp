#include "view/pictures/video_pipe.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

namespace myotact::view {

namespace {

Error failure(const std::filesystem::path& video, const std::string& what) {
  return Error(ExitStatus::InputOutput,
               fmt::format("{}: {}. Look whether the disk is full, and whether ffmpeg works.", video.string(), what));
}

/// The codec is left to ffmpeg: what fits .mp4 depends on how it was built.
std::vector<std::string> arguments(const std::filesystem::path& video, int width, int height) {
  return {"ffmpeg",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pixel_format",
          "rgb24",
          "-video_size",
          fmt::format("{}x{}", width, height),
          "-framerate",
          fmt::format("{}", VideoPipe::kPictures_hz),
          "-i",
          "-",
          "-threads",
          "1",
          "-vf",
          "vflip",
          "-pix_fmt",
          "yuv420p",
          video.string()};
}

/// With `input` as standard input, without standard output, with no signal held back. -1: errno states why.
pid_t start(const std::filesystem::path& program, std::vector<std::string> words, int input) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t process = -1;
  const int error = posix_spawn(&process, program.c_str(), &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error == 0) return process;
  errno = error;
  return -1;
}

/// A write to a dead program is to fail, not to end this one.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe, &before_);
  }
  ~NoPipeSignal() {
    sigset_t pipe;
    sigemptyset(&pipe);
    sigaddset(&pipe, SIGPIPE);
    const timespec now{};
    while (sigtimedwait(&pipe, nullptr, &now) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

std::optional<std::filesystem::path> program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const std::filesystem::path file = std::filesystem::path(rest.substr(0, end)) / name;
    std::error_code ignored;
    if (file.is_absolute() && std::filesystem::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) {
      return file;
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return std::nullopt;
}

VideoPipe::VideoPipe(const std::filesystem::path& ffmpeg, const std::filesystem::path& video, int width, int height,
                     std::chrono::seconds patience)
    : video_(video), patience_(patience) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw failure(video_, std::strerror(errno));
  process_ = start(ffmpeg, arguments(video, width, height), ends[0]);
  const int error = errno;
  ::close(ends[0]);
  input_ = ends[1];
  if (process_ < 0) {
    close_input();
    throw failure(video_, fmt::format("ffmpeg cannot be started ({})", std::strerror(error)));
  }
  ::fcntl(input_, F_SETFL, O_NONBLOCK);
}

VideoPipe::~VideoPipe() {
  close_input();
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void VideoPipe::close_input() {
  if (input_ >= 0) ::close(std::exchange(input_, -1));
}

void VideoPipe::write(std::span<const std::uint8_t> rgb) {
  const NoPipeSignal guard;
  while (!rgb.empty()) {
    pollfd ready{input_, POLLOUT, 0};
    const auto patience_ms = static_cast<int>(std::chrono::milliseconds(patience_).count());
    if (::poll(&ready, 1, patience_ms) == 0) throw failure(video_, "ffmpeg takes no more pictures");
    const ssize_t written = ::write(input_, rgb.data(), rgb.size());
    if (written >= 0) {
      rgb = rgb.subspan(static_cast<std::size_t>(written));
    } else if (errno != EAGAIN && errno != EINTR) {
      throw failure(video_, "ffmpeg ended before the film did");
    }
  }
}

void VideoPipe::close() {
  close_input();
  const auto end = std::chrono::steady_clock::now() + patience_;
  int status = 0;
  while (::waitpid(process_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) throw failure(video_, "ffmpeg does not come to an end");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  process_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw failure(video_, "ffmpeg could not write it");
}

}  // namespace myotact::view
