#include "view/pictures/turntable.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/error.h"
#include "view/look/limb_bounds.h"
#include "view/pictures/offscreen.h"
#include "view/pictures/video_file.h"

namespace myotact::view {

namespace {

constexpr int kLargest_px = 4096;  // of H.264 as players decode it

/// ffmpeg keeps some fifty pictures before it writes the first, and may take a second for each of the largest.
constexpr std::chrono::seconds kPatience{120};

}  // namespace

std::vector<Camera> cameras_round(const Camera& start, const ViewBox& box, float aspect, int pictures) {
  std::vector<Camera> cameras;
  float farthest_m = 0.0f;
  for (int i = 0; i < pictures; ++i) {
    Camera camera = start;
    camera.orbit(2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(pictures), 0.0f);
    cameras.push_back(framed(camera, box, aspect));
    farthest_m = std::max(farthest_m, cameras.back().distance_m);
  }
  for (Camera& camera : cameras) camera.distance_m = farthest_m;
  return cameras;
}

void check_film_size(const PictureSize& size) {
  const auto fits = [](int side) { return side % 2 == 0 && side <= kLargest_px; };
  if (fits(size.width) && fits(size.height)) return;
  throw Error(ExitStatus::Usage, fmt::format("--size {}x{}: of a film both sides must be even and at most {} pixels, "
                                             "for example 1920x1080",
                                             size.width, size.height, kLargest_px));
}

std::filesystem::path ffmpeg_for_films() {
  if (const auto ffmpeg = program_on_path("ffmpeg")) return *ffmpeg;
  throw Error(ExitStatus::Unavailable,
              "ffmpeg is not on PATH: no film can be made; sudo apt-get install ffmpeg, or make a picture (.png)");
}

bool write_turntable(const Turntable& turntable, const std::filesystem::path& video,
                     const std::function<bool(int, int)>& go_on) {
  const auto [width, height] = turntable.size;
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const int pictures =
      std::max(1, static_cast<int>(std::lround(turntable.seconds * static_cast<double>(VideoPipe::kPictures_hz))));
  const ViewBox box = bounds_of(turntable.specimen, turntable.frame);
  OffscreenRenderer renderer(turntable.specimen, width, height);
  VideoFile file(ffmpeg_for_films(), video, width, height, kPatience);
  ViewState look = turntable.look;
  int done = 0;
  for (const Camera& camera : cameras_round(look.camera, box, aspect, pictures)) {
    look.camera = camera;
    const Image image = renderer.render(turntable.frame, look);
    file.write(flipped(width, height, image.rgb).rgb, 1);  // bottom row first
    if (!go_on(++done, pictures)) return false;
  }
  file.close();
  return true;
}

}  // namespace myotact::view
