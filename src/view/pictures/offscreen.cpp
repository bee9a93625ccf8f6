#include "view/pictures/offscreen.h"

#include <algorithm>
#include <string>

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <openssl/evp.h>
#include <stb/stb_image_write.h>

#include "core/error.h"
#include "core/file.h"
#include "view/overlay/scene_overlay.h"
#include "view/pictures/headless_imgui.h"

namespace myotact::view {

namespace {

constexpr int kSamples = 4;  // of anti-aliasing
// Of a picture's shorter side: it is looked at as a whole, on a page or a slide.
constexpr float kFontShare = 0.019f, kSmallestFont_px = 13.0f;
constexpr float kOnScreen_px = 900.0f;  // of a larger picture's shorter side all strokes are as wide as on such a one

Error no_egl(const std::string& what) {
  return {ExitStatus::Unavailable, what + ": no picture can be drawn; install libegl1 and libgl1-mesa-dri"};
}

/// A current OpenGL context without any window.
class EglContext {
 public:
  EglContext() {
    if (!epoxy_has_egl()) throw no_egl("libEGL.so.1 is not there");  // any call would abort
    display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || eglInitialize(display_, nullptr, nullptr) != EGL_TRUE) {
      throw no_egl("EGL has no surfaceless display");
    }
    eglBindAPI(EGL_OPENGL_API);
    const EGLint attributes[] = {
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (context_ == EGL_NO_CONTEXT) throw no_egl("EGL gives no OpenGL 3.3 context");
    make_current();
  }
  ~EglContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void make_current() {
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      throw no_egl("the EGL context cannot be made current");
    }
  }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

/// Colour, depth and stencil of one size, with or without samples.
class Target {
 public:
  Target(int width, int height, int samples) {
    glGenFramebuffers(1, &frame_);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glGenRenderbuffers(2, buffers_);
    const GLenum formats[2] = {GL_RGB8, GL_DEPTH24_STENCIL8};
    const GLenum places[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_STENCIL_ATTACHMENT};
    for (int i = 0; i < 2; ++i) {
      glBindRenderbuffer(GL_RENDERBUFFER, buffers_[i]);
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, formats[i], width, height);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, places[i], GL_RENDERBUFFER, buffers_[i]);
    }
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) throw no_egl("no framebuffer");
  }
  ~Target() {
    glDeleteFramebuffers(1, &frame_);
    glDeleteRenderbuffers(2, buffers_);
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  GLuint frame() const { return frame_; }

 private:
  GLuint frame_ = 0;
  GLuint buffers_[2] = {0, 0};
};

void append_bytes(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

struct OffscreenRenderer::Impl {
  Impl(const anatomy::Specimen& given, int w, int h, float text_px)
      : specimen(&given),
        width(w),
        height(h),
        sampled(w, h, kSamples),
        plain(w, h, 0),
        renderer(given),
        imgui(w, h, text_px) {}

  void draw_scene(const messages::SceneFrame& frame, const ViewState& view, const SceneExtras& extras) {
    glBindFramebuffer(GL_FRAMEBUFFER, sampled.frame());
    SceneExtras scaled = extras;
    scaled.stroke_scale *= std::max(1.0f, static_cast<float>(std::min(width, height)) / kOnScreen_px);
    renderer.draw(frame, view, {0, 0, width, height}, scaled);
  }

  const anatomy::Specimen* specimen;
  EglContext context;
  int width, height;
  Target sampled, plain;
  SceneRenderer renderer;
  HeadlessImGui imgui;
};

OffscreenRenderer::OffscreenRenderer(const anatomy::Specimen& specimen, int width, int height, float text_px)
    : impl_(std::make_unique<Impl>(specimen, width, height, text_px)) {}

OffscreenRenderer::OffscreenRenderer(const anatomy::Specimen& specimen, int width, int height)
    : OffscreenRenderer(specimen, width, height, suitable_text_px(width, height)) {}

OffscreenRenderer::~OffscreenRenderer() = default;

const RenderStatistics& OffscreenRenderer::statistics() const {
  return impl_->renderer.statistics();
}

const std::vector<bool>& OffscreenRenderer::superficial() const {
  return impl_->renderer.superficial();
}

Image OffscreenRenderer::render(const messages::SceneFrame& frame, const ViewState& view, const SceneExtras& extras) {
  impl_->context.make_current();
  impl_->draw_scene(frame, view, extras);
  return read_back();
}

Image OffscreenRenderer::render_with_text(const messages::SceneFrame& frame, const ViewState& view,
                                          const SceneExtras& extras) {
  impl_->context.make_current();
  impl_->draw_scene(frame, view, extras);
  const Area whole{0.0f, 0.0f, static_cast<float>(impl_->width), static_cast<float>(impl_->height)};
  impl_->imgui.draw([&](ImDrawList& list) {
    OverlaidScene scene{*impl_->specimen, frame, view, superficial(), extras.hovered, extras.background};
    scene.legend = extras.legend;
    SceneOverlay().draw(scene, whole, list);
  });
  return read_back();
}

Image OffscreenRenderer::read_back() {
  const int width = impl_->width;
  const int height = impl_->height;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, impl_->sampled.frame());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, impl_->plain.frame());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, impl_->plain.frame());
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  return flipped(width, height, pixels);
}

float suitable_text_px(int width, int height) {
  return std::max(kSmallestFont_px, kFontShare * static_cast<float>(std::min(width, height)));
}

Image flipped(int width, int height, const std::vector<std::uint8_t>& rgb) {
  Image image{width, height, std::vector<std::uint8_t>(rgb.size())};
  const auto row = static_cast<std::ptrdiff_t>(width) * 3;
  for (std::ptrdiff_t y = 0; y < height; ++y) {
    std::copy_n(rgb.begin() + y * row, row, image.rgb.begin() + (height - 1 - y) * row);
  }
  return image;
}

std::string png_bytes(const Image& image) {
  std::string bytes;
  stbi_write_png_to_func(append_bytes, &bytes, image.width, image.height, 3, image.rgb.data(), 3 * image.width);
  return bytes;
}

std::string png_base64(const Image& image) {
  const std::string bytes = png_bytes(image);
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_file(path, png_bytes(image));
}

}  // namespace myotact::view
