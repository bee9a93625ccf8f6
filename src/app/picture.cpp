#include "app/picture.h"

#include <algorithm>

#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"
#include "view/pictures/contact_sheet.h"
#include "view/pictures/offscreen.h"

namespace myotact::app {

namespace {

/// Of the picture's width, for the limb when names stand at its sides.
constexpr float kShareBesideNames = 0.62f;
constexpr int kSheetWidth_px = 240, kSheetHeight_px = 320;  // of a picture on a sheet

/// One pose a row: angles, one a joint.
std::vector<std::vector<double>> poses_of_sheet(const scene::Scene& scene) {
  std::vector<double> own_rad;
  for (const scene::JointSetting& joint : scene.joints) own_rad.push_back(joint.angle_rad);
  std::vector<std::vector<double>> poses{own_rad};
  for (std::size_t j = 0; j < scene.specimen.joints.size(); ++j) {
    const anatomy::Joint& joint = scene.specimen.joints[j];
    if (joint.axes.empty() || joint.range_rad.empty()) continue;
    for (const double angle_rad : {joint.range_rad.front().first, joint.range_rad.front().second}) {
      poses.push_back(own_rad);
      poses.back()[j] = angle_rad;
    }
  }
  return poses;
}

}  // namespace

view::ViewState look_of(const scene::Scene& scene, const messages::SceneFrame& frame, const PictureWish& wish) {
  const float aspect = static_cast<float>(wish.size.width) / static_cast<float>(wish.size.height);
  view::ViewState look = view::start_view(scene.specimen, aspect);
  view::apply_show_options(wish.show, scene.specimen, look);
  const float limb_aspect = look.labels ? kShareBesideNames * aspect : aspect;
  look.camera = view::camera_of(wish.view, scene.specimen, view::bounds_of(scene.specimen, frame), limb_aspect);
  return look;
}

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

void write_sheet(const scene::Scene& scene, const std::vector<std::string>& show, const std::filesystem::path& path) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  std::vector<messages::SceneFrame> rows;
  for (const std::vector<double>& angles_rad : poses_of_sheet(scene)) {
    simulation.settle(angles_rad, {});
    simulation.write_frame(rows.emplace_back());
  }
  const std::vector<std::string> sides{"cranial", "caudal", "lateral", "medial"};
  const view::ContactSheet sheet{rows, sides, {kSheetWidth_px, kSheetHeight_px}};
  view::ViewState look = view::start_view(scene.specimen, 1.0f);
  look.lines = false;
  view::apply_show_options(show, scene.specimen, look);
  view::SceneExtras extras;
  extras.joint = watched_joint(scene);
  view::write_png(path, view::draw_contact_sheet(scene.specimen, sheet, look, extras));
}

int watched_joint(const scene::Scene& scene) {
  if (scene.co_contraction) return scene.co_contraction->joint;
  const auto& joints = scene.specimen.joints;
  const auto rotates = [](const anatomy::Joint& joint) { return !joint.axes.empty(); };
  const auto found = std::find_if(joints.begin(), joints.end(), rotates);
  return found == joints.end() ? 0 : static_cast<int>(found - joints.begin());
}

}  // namespace myotact::app
