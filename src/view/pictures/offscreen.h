#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/render/scene_renderer.h"

namespace myotact::view {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // 3 bytes a pixel, top row first
};

/// Draws scenes without a display, by EGL without a surface; a software renderer is enough.
class OffscreenRenderer {
 public:
  /// `text_px`: height of what is written. Throws Error Unavailable when there is no EGL or no OpenGL 3.3, with what to
  /// install.
  OffscreenRenderer(const anatomy::Specimen& specimen, int width, int height, float text_px);
  /// With text of a height that suits a picture of this size.
  OffscreenRenderer(const anatomy::Specimen& specimen, int width, int height);
  ~OffscreenRenderer();

  Image render(const messages::SceneFrame& frame, const ViewState& view, const SceneExtras& extras = {});
  /// With names, legend and scale bar over it, as in the window's scene.
  Image render_with_text(const messages::SceneFrame& frame, const ViewState& view, const SceneExtras& extras = {});
  /// Of the last picture.
  const RenderStatistics& statistics() const;
  const std::vector<bool>& superficial() const;

 private:
  Image read_back();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Height of text that suits a picture of this size [pixels].
float suitable_text_px(int width, int height);

std::string png_bytes(const Image& image);
/// The same as text, for a page that holds its pictures: src="data:image/png;base64,...".
std::string png_base64(const Image& image);

/// PNG by temporary file and rename. Throws Error InputOutput.
void write_png(const std::filesystem::path& path, const Image& image);

/// The bottom-up RGB pixels that OpenGL reads, top row first.
Image flipped(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace myotact::view
