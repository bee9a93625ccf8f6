#include "view/pictures/filming.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "core/error.h"
#include "core/user_folder.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

/// Video wants even lengths.
int even(int length) {
  return length - length % 2;
}

std::vector<std::uint8_t> pixels_of(const Viewport& box, int width, int height) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(box.x, box.y, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  return pixels;
}

std::string sentence_of(const FilmResult& result, bool resized) {
  if (!result.fault.empty()) return ui::tr("keep.film_not_saved", ui::retold(result.fault));
  if (!result.video) return ui::tr("keep.film_in_pictures", result.pictures, result.path.string());
  return ui::tr(resized ? "keep.film_resized" : "keep.film_saved", result.path.string());
}

}  // namespace

void Filming::begin_or_end(const std::string& scene_name) {
  if (film_ == nullptr) {
    wanted_ = scene_name;
  } else {
    film_->end();
    ending_ = true;
  }
}

std::optional<std::string> Filming::take(const Viewport& box) {
  const int width = even(box.width), height = even(box.height);
  if (!wanted_.empty() && width > 0 && height > 0) {
    try {
      film_ = std::make_unique<Film>(new_user_path("films", std::exchange(wanted_, {}), ""), width, height);
    } catch (const Error& failure) {
      return ui::tr("keep.film_not_saved", ui::retold(failure.what()));
    }
    since_ = std::chrono::steady_clock::now();
    ending_ = resized_ = false;
  }
  if (film_ == nullptr) return std::nullopt;
  const bool seen = width > 0 && height > 0;  // not minimised
  if (seen && (width != film_->width() || height != film_->height())) {
    resized_ = resized_ || !ending_;
    ending_ = true;
    film_->end();
  }
  const double time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count();
  if (seen && !ending_ && film_->wants_picture(time_s)) film_->add(time_s, pixels_of(box, width, height));
  const auto result = film_->result();
  if (!result) return std::nullopt;
  film_.reset();
  return sentence_of(*result, resized_);
}

}  // namespace myotact::view
