#include "app/picture.h"

#include <algorithm>

#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"
#include "view/pictures/offscreen.h"

namespace myotact::app {

namespace {

/// Of the picture's width, for the limb when names stand at its sides.
constexpr float kShareBesideNames = 0.62f;

view::ViewState look_of(const scene::Scene& scene, const messages::SceneFrame& frame, const PictureWish& wish) {
  const float aspect = static_cast<float>(wish.size.width) / static_cast<float>(wish.size.height);
  view::ViewState look = view::start_view(scene.specimen, aspect);
  view::apply_show_options(wish.show, scene.specimen, look);
  const float limb_aspect = look.labels ? kShareBesideNames * aspect : aspect;
  look.camera = view::camera_of(wish.view, scene.specimen, view::bounds_of(scene.specimen, frame), limb_aspect);
  return look;
}

}  // namespace

void check_picture(const scene::Scene& scene, const PictureWish& wish) {
  look_of(scene, {}, wish);
}

void write_picture(const scene::Scene& scene, const simulation::Simulation& simulation,
                   const std::vector<messages::ToolFrame>& tools, const PictureWish& wish,
                   const std::filesystem::path& path) {
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  frame.tools = tools;
  view::SceneExtras extras;
  extras.joint = watched_joint(scene);
  view::OffscreenRenderer renderer(scene.specimen, wish.size.width, wish.size.height);
  view::write_png(path, renderer.render_with_text(frame, look_of(scene, frame, wish), extras));
}

int watched_joint(const scene::Scene& scene) {
  if (scene.co_contraction) return scene.co_contraction->joint;
  const auto& joints = scene.specimen.joints;
  const auto rotates = [](const anatomy::Joint& joint) { return !joint.axes.empty(); };
  const auto found = std::find_if(joints.begin(), joints.end(), rotates);
  return found == joints.end() ? 0 : static_cast<int>(found - joints.begin());
}

}  // namespace myotact::app
