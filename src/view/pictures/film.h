#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace myotact::view {

/// How a film came out.
struct FilmResult {
  std::filesystem::path path;  // of the video, or of the folder of pictures
  bool video = false;          // else numbered pictures, 25 a second: there is no ffmpeg
  int pictures = 0;
  std::string fault;  // why it ended early or is not there; empty: it is whole
};

/// A film of 25 pictures a second, written by a thread of its own, through ffmpeg where it is installed. The drawing
/// thread never waits: where the writer lags, a picture stands for those that were left out, and the film keeps its
/// time.
class Film {
 public:
  /// `stem`: its path without extension. Width and height [pixels], both even.
  Film(const std::filesystem::path& stem, int width, int height);
  /// Waits until it is written, at most twenty seconds.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  int width() const { return width_; }
  int height() const { return height_; }

  // ---- the drawing thread
  /// Whether the film lacks a picture at that time since its beginning, and the writer keeps up.
  bool wants_picture(double time_s);
  /// 3 bytes a pixel, bottom row first.
  void add(double time_s, std::vector<std::uint8_t> rgb);
  /// No more pictures; the writer goes on until all are written.
  void end();
  /// Once all is written, or a fault ended it; nothing before.
  std::optional<FilmResult> result();

 private:
  struct Picture {
    std::vector<std::uint8_t> rgb;
    int times = 1;  // that it is shown
  };

  void write_all();
  template <typename Sink>
  void drain(Sink& sink);
  std::optional<Picture> next();

  std::filesystem::path stem_;
  int width_, height_;
  int taken_ = 0;  // pictures of the film that are given; the drawing thread's
  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<Picture> waiting_;
  bool ended_ = false;
  bool written_ = false;
  FilmResult result_;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace myotact::view
