#include "view/pictures/video_file.h"

#include <system_error>

#include "core/file.h"

namespace myotact::view {

VideoFile::VideoFile(const std::filesystem::path& ffmpeg, const std::filesystem::path& video, int width, int height,
                     std::chrono::seconds patience)
    : video_(video), part_(video.parent_path() / ("unfinished_" + video.filename().string())) {
  require_writable(video);
  pipe_.emplace(ffmpeg, part_, width, height, patience);
}

VideoFile::~VideoFile() {
  pipe_.reset();
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void VideoFile::write(std::span<const std::uint8_t> rgb, int times) {
  for (int i = 0; i < times; ++i) pipe_->write(rgb);
}

void VideoFile::close() {
  pipe_->close();
  std::filesystem::rename(part_, video_);
}

}  // namespace myotact::view
