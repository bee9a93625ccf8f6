#include "view/pictures/film.h"

#include <cmath>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "view/pictures/offscreen.h"
#include "view/pictures/video_file.h"
#include "view/pictures/video_pipe.h"

namespace myotact::view {

namespace {

/// Pictures that wait for the writer: a third of a second, 25 MB of a window of 1280 x 800.
constexpr std::size_t kMostWaiting = 8;

/// Numbered PNG files: 00001.png ...
class PictureFolder {
 public:
  PictureFolder(const std::filesystem::path& folder, int width, int height)
      : folder_(folder), width_(width), height_(height) {
    make_writable_folder(folder);
  }

  void write(const std::vector<std::uint8_t>& rgb, int times) {
    const std::filesystem::path first = next_path();
    write_file(first, png_bytes(flipped(width_, height_, rgb)));
    for (int i = 1; i < times; ++i) std::filesystem::copy_file(first, next_path());
  }
  void close() {}

 private:
  std::filesystem::path next_path() { return folder_ / fmt::format("{:05}.png", ++count_); }

  std::filesystem::path folder_;
  int width_, height_, count_ = 0;
};

}  // namespace

Film::Film(const std::filesystem::path& stem, int width, int height)
    : stem_(stem), width_(width), height_(height), thread_([this] { write_all(); }) {}

Film::~Film() {
  end();
  thread_.join();
}

bool Film::wants_picture(double time_s) {
  if (static_cast<int>(std::floor(time_s * VideoPipe::kPictures_hz)) < taken_) return false;
  const std::lock_guard lock(mutex_);
  return !ended_ && !written_ && waiting_.size() < kMostWaiting;
}

void Film::add(double time_s, std::vector<std::uint8_t> rgb) {
  const int now = static_cast<int>(std::floor(time_s * VideoPipe::kPictures_hz));
  if (now < taken_) return;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({std::move(rgb), now + 1 - taken_});
  }
  taken_ = now + 1;
  news_.notify_one();
}

void Film::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  news_.notify_one();
}

std::optional<FilmResult> Film::result() {
  const std::lock_guard lock(mutex_);
  return written_ ? std::optional(result_) : std::nullopt;
}

std::optional<Film::Picture> Film::next() {
  std::unique_lock lock(mutex_);
  news_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
  if (waiting_.empty()) return std::nullopt;
  Picture picture = std::move(waiting_.front());
  waiting_.pop_front();
  return picture;
}

template <typename Sink>
void Film::drain(Sink& sink) {
  while (auto picture = next()) {
    sink.write(picture->rgb, picture->times);
    result_.pictures += picture->times;  // read by others once all is written
  }
  sink.close();
}

/// Whatever goes wrong ends the film and nothing else.
void Film::write_all() {
  try {
    if (const auto ffmpeg = program_on_path("ffmpeg")) {
      result_.video = true;
      result_.path = stem_.string() + ".mp4";
      VideoFile video(*ffmpeg, result_.path, width_, height_);
      drain(video);
    } else {
      result_.path = stem_;
      PictureFolder folder(stem_, width_, height_);
      drain(folder);
    }
  } catch (const std::exception& failure) {
    result_.fault = failure.what();
  }
  const std::lock_guard lock(mutex_);
  written_ = true;
  waiting_.clear();
}

}  // namespace myotact::view
