#include "view/pictures/window_pictures.h"

#include <cstdint>
#include <vector>

#include <epoxy/gl.h>

#include "core/error.h"
#include "core/user_folder.h"
#include "view/pictures/offscreen.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

void save_framebuffer(const std::filesystem::path& path, const Viewport& box) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(box.x, box.y, box.width, box.height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  write_png(path, flipped(box.width, box.height, pixels));
}

std::string save_picture_for_person(const std::string& scene_name, const Viewport& box) {
  try {
    const auto path = new_user_path("pictures", scene_name, ".png");
    save_framebuffer(path, box);
    return ui::tr("keep.picture_saved", path.string());
  } catch (const Error& error) {
    return ui::tr("keep.picture_not_saved", ui::retold(error.what()));
  }
}

}  // namespace myotact::view
