#include "app/picture.h"

#include <spdlog/spdlog.h>

#include "core/error.h"
#include "view/limb_bounds.h"
#include "view/offscreen.h"

namespace myotact::app {

namespace {

constexpr int kWidth = 900, kHeight = 1200;

}  // namespace

void write_picture(const scene::Scene& scene, const simulation::Simulation& simulation,
                   const std::vector<messages::ToolFrame>& tools, const std::string& view,
                   const std::filesystem::path& path) {
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  frame.tools = tools;
  constexpr float kAspect = static_cast<float>(kWidth) / static_cast<float>(kHeight);
  view::ViewState look = view::start_view(scene.specimen, kAspect);
  const auto camera =
      view::standard_view(view, scene.specimen.side != "right", view::bounds_of(scene.specimen, frame), kAspect);
  look.camera = camera.value_or(look.camera);
  try {
    view::OffscreenRenderer renderer(scene.specimen, kWidth, kHeight);
    view::write_png(path, renderer.render_with_text(frame, look));
  } catch (const Error& failure) {
    if (failure.status() != ExitStatus::Unavailable) throw;
    spdlog::warn("{}", failure.what());
  }
}

}  // namespace myotact::app
