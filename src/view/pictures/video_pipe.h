#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <sys/types.h>

namespace myotact::view {

/// The program of that name on PATH; nothing when there is none that may be run.
std::optional<std::filesystem::path> program_on_path(const std::string& name);

/// Pictures through ffmpeg into a video. It is another program: it may be missing, be slow, stop or die, and only the
/// video suffers. One thread at a time, and not one that draws: a write waits for ffmpeg.
class VideoPipe {
 public:
  static constexpr int kPictures_hz = 25;
  /// A second of a window's video takes an old computer about as long; what takes ten times that is stuck.
  static constexpr std::chrono::seconds kPatience{10};

  /// Starts `ffmpeg` on pictures of width x height pixels, both even. `patience`: for one of them, and for the end.
  /// Throws Error InputOutput.
  VideoPipe(const std::filesystem::path& ffmpeg, const std::filesystem::path& video, int width, int height,
            std::chrono::seconds patience = kPatience);
  ~VideoPipe();  // ends ffmpeg without waiting for what it has not written
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;

  /// 3 bytes a pixel, bottom row first, as OpenGL reads them. Throws Error InputOutput when ffmpeg died, or took
  /// nothing for so long.
  void write(std::span<const std::uint8_t> rgb);
  /// Waits until ffmpeg has written the video. Throws Error InputOutput when it could not, or takes too long.
  void close();

 private:
  void close_input();

  std::filesystem::path video_;
  std::chrono::seconds patience_;
  int input_ = -1;  // write end of its standard input
  pid_t process_ = -1;
};

}  // namespace myotact::view
