#include "app/touch_map_page.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/fidelity_style.h"
#include "core/at.h"
#include "core/text.h"
#include "measure/fidelity/touch_map_report.h"
#include "view/look/limb_bounds.h"
#include "view/look/show_options.h"
#include "view/look/start_view.h"

namespace myotact::app {

namespace {

using measure::Grade;

constexpr std::array kSides = {"lateral", "medial", "cranial", "caudal"};
constexpr int kWidth_px = 520, kHeight_px = 760;
constexpr float kMarkRadius_m = 2.5e-3f;  // about that of the tool
constexpr float kFacing = 0.15f;          // cosine from which a place is seen from a side

struct GradeColour {
  Grade grade;
  const char* html;
  glm::vec4 colour;
};
/// Okabe and Ito's: distinguishable with any colour vision.
constexpr std::array kGradeColours = {GradeColour{Grade::Good, "#009E73", {0.0f, 0.62f, 0.451f, 1.0f}},
                                      GradeColour{Grade::Fair, "#F0E442", {0.941f, 0.894f, 0.259f, 1.0f}},
                                      GradeColour{Grade::Poor, "#D55E00", {0.835f, 0.369f, 0.0f, 1.0f}},
                                      GradeColour{Grade::Unknown, "#999999", {0.6f, 0.6f, 0.6f, 1.0f}}};

const GradeColour& colour_of(Grade grade) {
  return *std::find_if(kGradeColours.begin(), kGradeColours.end(),
                       [&](const GradeColour& colour) { return colour.grade == grade; });
}

glm::vec3 to_glm(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::vector<view::SceneMark> marks_towards(const measure::TouchMap& map, const glm::vec3& forward) {
  std::vector<view::SceneMark> marks;
  for (const measure::TouchedPlace& touched : map.places) {
    if (glm::dot(to_glm(touched.place.normal), forward) > -kFacing) continue;
    const Grade grade = measure::worst_grade(measure::grade(touched));
    marks.push_back({to_glm(touched.place.position_m), kMarkRadius_m, colour_of(grade).colour});
  }
  return marks;
}

std::string pictures_part(const std::vector<TouchPicture>& pictures) {
  if (pictures.empty()) return "<p>Without OpenGL there are no pictures; install libegl1 and libgl1-mesa-dri.</p>\n";
  std::string html = "<p>";
  for (const GradeColour& colour : kGradeColours)
    html += fmt::format(R"(<span style="color:{}">&#9679;</span> {} &nbsp; )", colour.html,
                        measure::grade_text(colour.grade));
  html += "</p>\n<div>";
  for (const TouchPicture& picture : pictures)
    html += fmt::format(R"(<img alt="{0}" title="{0}" width="{1}" src="data:image/png;base64,{2}"> )", picture.side,
                        kWidth_px / 2, view::png_base64(picture.image));
  return html + "</div>\n";
}

std::string number(double value, double scale) {
  return std::isfinite(value) ? fmt::format("{:.1f}", scale * value) : "&ndash;";
}

std::string muscle_table(const measure::TouchMap& map) {
  std::string html =
      "<h2>Muscles</h2>\n<table><tr><th></th><th class=\"number\">good</th><th class=\"number\">fair</th>"
      "<th class=\"number\">poor</th><th class=\"number\">median difference %</th><th class=\"number\">worst %</th>"
      "<th class=\"number\">largest swing mN</th></tr>\n";
  for (const measure::MuscleTouch& row : measure::by_muscle(map)) {
    html += fmt::format("<tr><td>{}</td>", escape_markup(map.muscles[at(row.muscle)]));
    if (row.good + row.fair + row.poor + row.unknown == 0) {
      html += "<td colspan=\"6\">lies under others</td></tr>\n";
      continue;
    }
    for (const int count : {row.good, row.fair, row.poor}) html += fmt::format(R"(<td class="number">{}</td>)", count);
    for (const std::string& text :
         {number(row.median_error_share, 100.0), number(row.worst_error_share, 100.0), number(row.worst_swing_N, 1e3)})
      html += fmt::format(R"(<td class="number">{}</td>)", text);
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string place_table(const measure::TouchMap& map) {
  std::string html =
      "<h2>Places that are not good</h2>\n<table><tr><th></th><th>where [mm]</th><th>verdict</th>"
      "<th class=\"number\">difference %</th><th class=\"number\">gain</th><th class=\"number\">swing mN</th>"
      "<th class=\"number\">largest step mN</th><th class=\"number\">most force N</th></tr>\n";
  for (const measure::TouchedPlace& touched : map.places) {
    const Grade grade = measure::worst_grade(measure::grade(touched));
    if (grade == Grade::Good) continue;
    const Vec3 mm = 1e3 * touched.place.position_m;
    html += fmt::format("<tr><td>{}</td><td>{:.0f}, {:.0f}, {:.0f}</td><td>{}</td>",
                        escape_markup(map.muscles[at(touched.place.muscle)]), mm.x(), mm.y(), mm.z(), graded(grade));
    for (const std::string& text :
         {number(touched.error_share, 100.0), number(touched.gain, 1.0), number(touched.held_swing_N, 1e3),
          number(touched.largest_step_N, 1e3), number(touched.felt_peak_N, 1.0)})
      html += fmt::format(R"(<td class="number">{}</td>)", text);
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

}  // namespace

std::vector<TouchPicture> touch_pictures(const anatomy::Specimen& specimen, const measure::TouchMap& map) {
  const float aspect = static_cast<float>(kWidth_px) / static_cast<float>(kHeight_px);
  view::OffscreenRenderer renderer(specimen, kWidth_px, kHeight_px);
  view::ViewState look = view::start_view(specimen, aspect);
  look.lines = false;
  std::vector<TouchPicture> pictures;
  for (const char* side : kSides) {
    look.camera = view::camera_of(side, specimen, view::bounds_of(specimen, map.frame), aspect);
    const std::vector<view::SceneMark> marks = marks_towards(map, look.camera.forward_world());
    view::SceneExtras extras;
    extras.marks = marks;
    pictures.push_back({side, renderer.render(map.frame, look, extras)});
  }
  return pictures;
}

std::string touch_map_page(const measure::TouchMap& map, const std::vector<TouchPicture>& pictures) {
  std::string html = kFidelityHead;
  html +=
      fmt::format("<h1>How true touch is: {}</h1>\n<p>{}; device: {}.</p>\n<p>{}.{}</p>\n", escape_markup(map.scene),
                  escape_markup(map.title), escape_markup(map.device), measure::verdict_text(map),
                  map.complete ? "" : " Interrupted: the places after these were not touched.");
  html += fmt::format(
      "<p>At {} random places of every muscle, where a hand can come to them, it presses 4 mm deep, holds for a "
      "second, "
      "strokes 5 mm along the muscle and 5 mm across, and lifts off.</p>\n<ul>",
      map.asked);
  for (const measure::GradedFigure& figure : measure::grade(measure::TouchedPlace{}))
    html += fmt::format("<li>{} [{}]: good to {:g}, fair to {:g} ({})</li>", escape_markup(figure.name),
                        escape_markup(figure.unit), figure.good, figure.fair, escape_markup(figure.source));
  html += "</ul>\n";
  return html + pictures_part(pictures) + muscle_table(map) + place_table(map) + "</body></html>\n";
}

}  // namespace myotact::app
