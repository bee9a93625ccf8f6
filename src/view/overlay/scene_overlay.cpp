#include "view/overlay/scene_overlay.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "view/overlay/seen_parts.h"
#include "view/render/tool_drawing.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

// Lengths in heights of the font.
constexpr float kMargin = 0.9f, kLabelGap = 0.25f, kPad = 0.3f, kDistance = 2.2f, kDot = 0.2f;
constexpr float kLegendWidth = 11.0f, kLegendHeight = 0.8f, kSwatch = 1.4f;
constexpr float kScaleLength = 9.0f;   // of the bar, at most
constexpr float kStripeScale = 0.35f;  // heights of the font a centimetre of stripe distance
constexpr float kLegibility = 0.82f;   // opacity of what lies under a text

ImVec2 to_im(const glm::vec2& v) {
  return {v.x, v.y};
}

ImU32 to_im(const glm::vec3& colour, float opacity = 1.0f) {
  return ImGui::GetColorU32(ImVec4(colour.r, colour.g, colour.b, opacity));
}

/// What the parts of the overlay share.
struct Sheet {
  const OverlaidScene& scene;
  const Area& area;
  ImDrawList& list;

  float em() const { return ImGui::GetFontSize(); }
  /// Black or white, whichever stands out from the background; both reach 10:1 on the backgrounds in use.
  glm::vec3 ink() const {
    const float light = glm::dot(scene.background, glm::vec3(0.2126f, 0.7152f, 0.0722f));
    return light > 0.4f ? glm::vec3(0.10f, 0.11f, 0.14f) : glm::vec3(0.94f);
  }
  void write(const glm::vec2& corner, const std::string& text, float opacity = 1.0f) const {
    list.AddText(to_im(corner), to_im(ink(), opacity), text.c_str());
  }
  glm::vec2 size_of(const std::string& text) const {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    return {size.x, size.y};
  }
  /// So that what is written can be read over anything.
  void paper(const glm::vec2& corner, const glm::vec2& size) const {
    list.AddRectFilled(to_im(corner), to_im(corner + size), to_im(scene.background, kLegibility), 0.25f * em());
  }
  glm::vec2 on_screen(const glm::vec2& place) const {
    return {area.x + area.width * place.x, area.y + area.height * place.y};
  }
};

/// One number for each part, for the placing of names.
int id_of(const Part& part) {
  return 2 * part.index + (part.kind == PartKind::Bone ? 1 : 0);
}

void draw_label(const Sheet& sheet, const LabelWish& wish, const PlacedLabel& placed, const std::string& text,
                bool chosen) {
  const float pad = kPad * sheet.em();
  const glm::vec2 corner = placed.corner;
  const glm::vec2 end(placed.on_left ? corner.x + wish.size.x : corner.x, corner.y + 0.5f * wish.size.y);
  sheet.list.AddLine(to_im(wish.anchor), to_im(end), to_im(sheet.ink(), 0.55f), std::max(1.0f, 0.07f * sheet.em()));
  sheet.list.AddCircleFilled(to_im(wish.anchor), kDot * sheet.em(), to_im(sheet.scene.background, 0.9f));
  sheet.list.AddCircleFilled(to_im(wish.anchor), 0.65f * kDot * sheet.em(), to_im(sheet.ink()));
  sheet.paper(corner, wish.size);
  if (chosen) {
    sheet.list.AddRect(to_im(corner), to_im(corner + wish.size), to_im(sheet.ink(), 0.7f), 0.25f * sheet.em());
  }
  sheet.write(corner + glm::vec2(pad, 0.5f * pad), text);
}

void draw_swatch(const Sheet& sheet, const glm::vec2& corner, const glm::vec2& size, const MuscleTint& tint) {
  sheet.list.AddRectFilled(to_im(corner), to_im(corner + size), to_im(tint.colour));
  if (tint.stripe_m > 0.0f) {
    const float step = std::max(3.0f, kStripeScale * sheet.em() * 100.0f * tint.stripe_m);
    for (float x = corner.x + 0.5f * step; x < corner.x + size.x; x += step) {
      sheet.list.AddLine(ImVec2(x, corner.y), ImVec2(x, corner.y + size.y), to_im(0.6f * tint.colour));
    }
  }
  sheet.list.AddRect(to_im(corner), to_im(corner + size), to_im(sheet.ink(), 0.45f));
}

/// As from a hand to its tool.
void draw_thread(const Sheet& sheet, const glm::vec2& corner) {
  const float em = sheet.em(), middle = corner.y + 0.5f * em;
  const ImU32 colour = to_im(glm::vec3(kThread), kThread.a);
  sheet.list.AddLine(ImVec2(corner.x, middle), ImVec2(corner.x + kSwatch * em, middle), colour, 0.1f * em);
  sheet.list.AddCircleFilled(ImVec2(corner.x + kDot * em, middle), kDot * em, colour);
}

void draw_scale_of_colours(const Sheet& sheet, const Legend& legend, const glm::vec2& corner) {
  const float em = sheet.em();
  const auto steps = legend.scale.size() - 1;
  const float step = kLegendWidth * em / static_cast<float>(steps);
  for (std::size_t i = 0; i < steps; ++i) {
    const glm::vec2 at(corner.x + step * static_cast<float>(i), corner.y);
    const ImU32 from = to_im(legend.scale[i]), to = to_im(legend.scale[i + 1]);
    sheet.list.AddRectFilledMultiColor(to_im(at), ImVec2(at.x + step, at.y + kLegendHeight * em), from, to, to, from);
  }
  sheet.list.AddRect(to_im(corner), ImVec2(corner.x + kLegendWidth * em, corner.y + kLegendHeight * em),
                     to_im(sheet.ink(), 0.45f));
  for (const float share : {0.0f, 0.5f, 1.0f}) {
    const double value = legend.lowest + static_cast<double>(share) * (legend.highest - legend.lowest);
    const std::string text = fmt::format("{:g}", std::round(1e3 * value) * 1e-3);
    const float x = corner.x + share * (kLegendWidth * em - sheet.size_of(text).x);
    sheet.write({x, corner.y + (kLegendHeight + 0.1f) * em}, text);
  }
}

/// At the bottom left. Returns how much of the area's height it takes.
float draw_legend(const Sheet& sheet, const Legend& legend) {
  const float em = sheet.em(), row = 1.35f * em, pad = 0.5f * em;
  const float scale_height = legend.scale.empty() ? 0.0f : (kLegendHeight + 1.5f) * em;
  float width = legend.scale.empty() ? 0.0f : kLegendWidth * em;
  for (const auto& entry : legend.entries) {
    width = std::max(width, (kSwatch + 0.5f) * em + sheet.size_of(ui::tr(entry.key)).x);
  }
  const std::string unit = *legend.unit_key == '\0' ? std::string() : fmt::format(" [{}]", ui::tr(legend.unit_key));
  const std::string title = ui::tr(legend.title_key) + unit;
  width = std::max(width, sheet.size_of(title).x);
  const float height = row + scale_height + row * static_cast<float>(legend.entries.size());
  const glm::vec2 corner(sheet.area.x + kMargin * em + pad,
                         sheet.area.y + sheet.area.height - kMargin * em - pad - height);
  if (corner.y < sheet.area.y) return 0.0f;  // no room for it
  sheet.paper(corner - pad, glm::vec2(width, height) + 2.0f * pad);
  sheet.write(corner, title);
  glm::vec2 at(corner.x, corner.y + row);
  if (!legend.scale.empty()) draw_scale_of_colours(sheet, legend, at);
  at.y += scale_height;
  for (const auto& entry : legend.entries) {
    entry.thread ? draw_thread(sheet, at) : draw_swatch(sheet, at, {kSwatch * em, em}, entry.tint);
    sheet.write({at.x + (kSwatch + 0.5f) * em, at.y}, ui::tr(entry.key));
    at.y += row;
  }
  return sheet.area.y + sheet.area.height - corner.y + pad;
}

/// At the bottom right: a length as it looks at the depth of the camera's target.
void draw_scale_bar(const Sheet& sheet) {
  const float em = sheet.em();
  const float metres_a_pixel =
      2.0f * sheet.scene.view.camera.distance_m * std::tan(0.5f * Camera::kFieldOfView_rad) / sheet.area.height;
  const double length_m = round_length_m(static_cast<double>(kScaleLength * em * metres_a_pixel));
  const float length = static_cast<float>(length_m) / metres_a_pixel;
  const glm::vec2 end(sheet.area.x + sheet.area.width - 2.0f * kMargin * em,
                      sheet.area.y + sheet.area.height - 2.0f * kMargin * em);
  const glm::vec2 start(end.x - length, end.y);
  const float tick = 0.3f * em, thick = std::max(1.5f, 0.12f * em);
  const ImU32 ink = to_im(sheet.ink());
  sheet.list.AddLine(to_im(start), to_im(end), ink, thick);
  for (const glm::vec2& at : {start, end}) {
    sheet.list.AddLine(ImVec2(at.x, at.y - tick), ImVec2(at.x, at.y + tick), ink, thick);
  }
  const std::string text = ui::tr("see.scale_mm", 1e3 * length_m);
  sheet.write({0.5f * (start.x + end.x - sheet.size_of(text).x), end.y - 1.5f * em}, text);
}

/// Anchors are found on a coarse grid: one that moves by no more than a few of its cells glides there.
void steady(std::vector<LabelWish>& wishes, const std::vector<LabelWish>& before, float reach) {
  constexpr float kGlide = 0.25f;  // of the way, a picture
  for (LabelWish& wish : wishes) {
    const auto last = std::find_if(before.begin(), before.end(), [&](const auto& w) { return w.id == wish.id; });
    if (last == before.end() || glm::distance(last->anchor, wish.anchor) > reach) continue;
    wish.anchor = glm::mix(last->anchor, wish.anchor, kGlide);
  }
}

/// Both names stand one below the other.
std::string label_text(const OverlaidScene& scene, const Part& part) {
  const std::string name = name_of(scene.specimen, part, scene.view);
  if (scene.view.names != NameStyle::Both) return name;
  const std::string english = name_of(scene.specimen, part, NameStyle::English);
  const std::string latin = name_of(scene.specimen, part, NameStyle::Latin);
  return english == latin ? name : english + "\n" + latin;
}

/// What would be named, with `texts`.
std::vector<LabelWish> wishes_of(const Sheet& sheet, const SeenLimb& limb, std::vector<std::string>& texts) {
  const glm::vec2 pad(2.0f * kPad * sheet.em(), kPad * sheet.em());
  std::vector<LabelWish> wishes;
  for (const SeenPart& seen : limb.parts) {
    const bool chosen = seen.part == selected_part(sheet.scene.view) || seen.part == sheet.scene.hovered;
    if (!sheet.scene.view.labels && !chosen) continue;
    texts.push_back(label_text(sheet.scene, seen.part));
    wishes.push_back({id_of(seen.part), sheet.on_screen(seen.place), sheet.size_of(texts.back()) + pad,
                      sheet.area.x + sheet.area.width * seen.middle, chosen ? 2.0f : seen.share});
  }
  return wishes;
}

/// `below`: height at the area's bottom that is left free. `placed` and `before`: in the last picture; then in this
/// one.
void draw_labels(const Sheet& sheet, float below, std::vector<PlacedLabel>& placed, std::vector<LabelWish>& before) {
  const ViewState& view = sheet.scene.view;
  const Part selected = selected_part(view);
  const bool any = view.labels || selected || sheet.scene.hovered;
  if (!any) {
    placed.clear();
    before.clear();
    return;
  }
  const float em = sheet.em();
  const SeenLimb limb = seen_parts(sheet.scene.specimen, sheet.scene.frame, view, sheet.scene.superficial,
                                   sheet.area.width / sheet.area.height);
  std::vector<std::string> texts;
  std::vector<LabelWish> wishes = wishes_of(sheet, limb, texts);
  steady(wishes, before, em);
  LabelArea room;
  room.lowest = glm::vec2(sheet.area.x, sheet.area.y) + kMargin * em;
  room.highest = glm::vec2(sheet.area.x + sheet.area.width, sheet.area.y + sheet.area.height - below) - kMargin * em;
  room.subject_left = sheet.area.x + limb.left * sheet.area.width - kDistance * em;
  room.subject_right = sheet.area.x + limb.right * sheet.area.width + kDistance * em;
  room.gap = kLabelGap * em;
  placed = place_labels(wishes, room, placed);
  for (const PlacedLabel& label : placed) {
    const auto wish = std::find_if(wishes.begin(), wishes.end(), [&](const auto& w) { return w.id == label.id; });
    const bool chosen = label.id == id_of(selected) && selected;
    draw_label(sheet, *wish, label, texts[static_cast<std::size_t>(wish - wishes.begin())], chosen && view.labels);
  }
  before = std::move(wishes);
}

}  // namespace

double round_length_m(double longest_m) {
  const double decade = std::pow(10.0, std::floor(std::log10(longest_m)));
  for (const double times : {5.0, 2.0}) {
    if (times * decade <= longest_m) return times * decade;
  }
  return decade;
}

void SceneOverlay::draw(const OverlaidScene& scene, const Area& area, ImDrawList& list) {
  if (area.empty()) return;
  const Sheet sheet{scene, area, list};
  list.PushClipRect(ImVec2(area.x, area.y), ImVec2(area.x + area.width, area.y + area.height));
  Legend legend = legend_of(scene.specimen, scene.view);
  if (scene.tools_lag) legend.entries.push_back({"see.thread", {}, true});
  const float legend_height = scene.legend ? draw_legend(sheet, legend) : 0.0f;
  if (!scene.view.names_hidden) draw_labels(sheet, legend_height, placed_, wishes_);
  draw_scale_bar(sheet);
  list.PopClipRect();
}

}  // namespace myotact::view
