#include "app/picture.h"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "view/look/limb_bounds.h"
#include "view/look/part.h"
#include "view/look/start_view.h"
#include "view/overlay/seen_parts.h"
#include "view/pictures/contact_sheet.h"
#include "view/pictures/offscreen.h"

namespace myotact::app {

namespace {

/// Of the picture's width, for the limb when names stand at its sides.
constexpr float kShareBesideNames = 0.62f;
constexpr int kSheetWidth_px = 240, kSheetHeight_px = 320;  // of a picture on a sheet

/// What a poster shows.
struct Shown {
  const scene::Scene& scene;
  const messages::SceneFrame& frame;
  view::ViewState look;
};

/// Both columns of a poster's names, in heights of the text.
float columns_of_names(Shown shown, const std::string& side) {
  constexpr float kCharacter = 0.5f;        // mean width of a character over the height of the text
  constexpr float kRoomBesideNames = 4.0f;  // what view::SceneOverlay leaves free, and a little
  const anatomy::Specimen& specimen = shown.scene.specimen;
  std::size_t longest = 0;
  const auto measure = [&](const view::Part& part, view::NameStyle style) {
    longest = std::max(longest, view::name_of(specimen, part, style).size());
  };
  // What is seen of a limb hardly hangs on the picture's shape.
  shown.look.camera = view::camera_of(side, specimen, view::bounds_of(specimen, shown.frame), 1.0f);
  for (const view::SeenPart& seen : view::seen_parts(specimen, shown.frame, shown.look, {}, 1.0f).parts) {
    if (shown.look.names != view::NameStyle::Latin) measure(seen.part, view::NameStyle::English);
    if (shown.look.names != view::NameStyle::English) measure(seen.part, view::NameStyle::Latin);
  }
  return 2.0f * (kCharacter * static_cast<float>(longest) + kRoomBesideNames);
}

/// How a poster's width is shared between limb and names.
struct PosterLayout {
  float text_px = 0.0f;
  float limb_share = 0.0f;
};

/// The names are the smaller the narrower the picture: they take little more than half of its width at most, and the
/// limb the rest.
PosterLayout layout_of_poster(const Shown& shown, const PictureWish& wish) {
  constexpr float kMostForNames = 0.55f, kLeastForLimb = 0.3f, kSmallest_px = 8.0f;
  const float columns = columns_of_names(shown, wish.view), width = static_cast<float>(wish.size.width);
  const float text_px = std::max(kSmallest_px, std::min(view::suitable_text_px(wish.size.width, wish.size.height),
                                                        kMostForNames * width / columns));
  return {text_px, std::max(kLeastForLimb, 1.0f - columns * text_px / width)};
}

/// Colours of activation say nothing of a limb at rest.
bool legend_explains(const messages::SceneFrame& frame, const view::ViewState& look) {
  constexpr double kSeen = 0.05;  // less tints no muscle visibly
  const auto active = [](double activation) { return activation > kSeen; };
  return look.attachments || look.colour != view::MuscleColour::Activation ||
         std::any_of(frame.activations.begin(), frame.activations.end(), active);
}

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
  const float share = wish.poster ? layout_of_poster({scene, frame, look}, wish).limb_share : kShareBesideNames;
  const float limb_aspect = look.labels ? share * aspect : aspect;
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
  write_picture(scene, frame, wish, path);
}

void write_picture(const scene::Scene& scene, const messages::SceneFrame& frame, const PictureWish& wish,
                   const std::filesystem::path& path) {
  view::SceneExtras extras;
  extras.joint = watched_joint(scene);
  const view::ViewState look = look_of(scene, frame, wish);
  extras.legend = !wish.poster || legend_explains(frame, look);
  const float text_px = wish.poster ? layout_of_poster({scene, frame, look}, wish).text_px
                                    : view::suitable_text_px(wish.size.width, wish.size.height);
  view::OffscreenRenderer renderer(scene.specimen, wish.size.width, wish.size.height, text_px);
  view::write_png(path, renderer.render_with_text(frame, look, extras));
}

void write_sheet(const scene::Scene& scene, const std::vector<std::string>& show, const std::filesystem::path& path) {
  simulation::Simulation simulation(scene.specimen, scene.settings);
  std::vector<messages::SceneFrame> rows;
  for (const std::vector<double>& angles_rad : poses_of_sheet(scene)) {
    if (!simulation.settle(angles_rad, {})) {
      spdlog::warn("{}: muscles do not come to rest in the pose of row {}; it shows how far they came", path.string(),
                   rows.size() + 1);
    }
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
