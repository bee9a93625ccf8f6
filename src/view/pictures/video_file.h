#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "view/pictures/video_pipe.h"

namespace myotact::view {

/// A video whose file is there when it is whole. Throws as VideoPipe.
class VideoFile {
 public:
  /// Throws Error InputOutput also where no file of that name can be made.
  VideoFile(const std::filesystem::path& ffmpeg, const std::filesystem::path& video, int width, int height,
            std::chrono::seconds patience = VideoPipe::kPatience);
  ~VideoFile();  // leaves nothing of a video that was not closed
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// One picture, shown `times` times; as VideoPipe::write().
  void write(std::span<const std::uint8_t> rgb, int times);
  void close();

 private:
  std::filesystem::path video_, part_;
  std::optional<VideoPipe> pipe_;
};

}  // namespace myotact::view
