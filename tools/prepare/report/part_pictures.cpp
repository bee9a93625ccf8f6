#include "prepare/report/part_pictures.h"

#include <algorithm>

#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"
#include "view/pictures/offscreen.h"

namespace myotact::prepare {

namespace {

struct Size {
  int width = 0, height = 0;
};
constexpr Size kLimbSize{520, 700};
constexpr Size kPartSize{300, 300};
/// Radius of a mark, as a part of the diagonal of what is seen.
constexpr float kMarkShare = 0.014f;

glm::vec3 to_glm(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

glm::vec4 colour_of(MarkKind kind) {
  const std::string html = std::find_if(mark_colours().begin(), mark_colours().end(), [&](const MarkColour& colour) {
                             return colour.kind == kind;
                           })->html;
  const auto part = [&](std::size_t at) {
    return static_cast<float>(std::stoi(html.substr(at, 2), nullptr, 16)) / 255.0f;
  };
  return {part(1), part(3), part(5), 1.0f};
}

/// The specimen as it lies in the file.
messages::SceneFrame frame_of(const anatomy::Specimen& specimen) {
  messages::SceneFrame frame;
  frame.body_poses.assign(specimen.bodies.size(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    auto& skin = frame.skins_world_m.emplace_back();
    for (const Vec3& p : muscle.skin.positions_m) {
      skin.push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
    }
  }
  for (const anatomy::MuscleLine& line : specimen.lines) {
    auto& points = frame.lines_world_m.emplace_back();
    for (const anatomy::LinePoint& point : line.points) points.push_back(to_array(point.position_m));
  }
  return frame;
}

PicturePair draw(const anatomy::Specimen& specimen, const Size& size, const std::vector<ReportMark>& marks) {
  const view::ViewBox box = view::bounds_of(specimen);
  std::vector<view::SceneMark> balls;
  const float radius_m = kMarkShare * glm::length(box.highest_m - box.lowest_m);
  for (const ReportMark& mark : marks) balls.push_back({to_glm(mark.place_m), radius_m, colour_of(mark.kind)});
  view::OffscreenRenderer renderer(specimen, size.width, size.height);
  const messages::SceneFrame frame = frame_of(specimen);
  const auto from = [&](const char* side) {
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    view::ViewState look = view::start_view(specimen, aspect);
    look.camera = view::standard_view(side, specimen.side != "right", box, aspect).value_or(look.camera);
    view::SceneExtras extras;
    extras.marks = balls;
    return view::png_base64(renderer.render(frame, look, extras));
  };
  return {from("lateral"), from("medial")};
}

}  // namespace

const std::vector<MarkColour>& mark_colours() {
  // Okabe and Ito's: distinguishable with any colour vision.
  static const std::vector<MarkColour> colours = {{MarkKind::Repair, "#E69F00", "repaired"},
                                                  {MarkKind::Overlap, "#D55E00", "deepest overlap that is left"},
                                                  {MarkKind::Tet, "#CC79A7", "flattest tetrahedron"},
                                                  {MarkKind::Origin, "#56B4E9", "origin"},
                                                  {MarkKind::Insertion, "#009E73", "insertion"}};
  return colours;
}

PicturePair picture_of_limb(const anatomy::Specimen& specimen) {
  return draw(specimen, kLimbSize, {});
}

PicturePair picture_of_bone(const anatomy::Specimen& specimen, std::size_t bone, const std::vector<ReportMark>& marks) {
  anatomy::Specimen alone;
  alone.side = specimen.side;
  alone.bodies = specimen.bodies;
  alone.bones = {specimen.bones[bone]};
  return draw(alone, kPartSize, marks);
}

PicturePair picture_of_muscle(const anatomy::Specimen& specimen, std::size_t muscle,
                              const std::vector<ReportMark>& marks) {
  anatomy::Specimen alone;
  alone.side = specimen.side;
  alone.bodies = specimen.bodies;
  alone.muscles = {specimen.muscles[muscle]};
  for (const anatomy::MuscleLine& line : specimen.lines) {
    if (line.muscle == static_cast<int>(muscle)) alone.lines = {line};
  }
  return draw(alone, kPartSize, marks);
}

}  // namespace myotact::prepare
