#include "view/panels/see_panel.h"

#include <array>

#include "view/ui/controls.h"

namespace myotact::view {

namespace {

/// As in MuscleColour.
constexpr std::array kColours = {"see.kind",         "see.activation",      "see.tension", "see.stretch",
                                 "see.volume_error", "see.stiffness_share", "see.pressure"};
constexpr std::array kNames = {"see.english", "see.latin", "see.both"};  // as in NameStyle
/// From which side a section cuts: in pairs, one an axis x, y, z of the world; the first of each lies towards its end.
constexpr std::array kSides = {"see.cranial", "see.caudal", "see.lateral", "see.medial", "see.dorsal", "see.ventral"};

void draw_opacity(const char* key, float& opacity) {
  double percent = 100.0 * static_cast<double>(opacity);
  if (ui::slider(key, percent, {0.0f, 100.0f}, "%.0f %%")) opacity = static_cast<float>(0.01 * percent);
}

void draw_section(SectionPlane& section, bool left_limb) {
  ui::checkbox("see.section", section.on);
  if (!section.on) return;
  // The world's y points left: lateral on a left limb, medial on a right one.
  const auto mirrored = [&](int axis) { return axis == 1 && !left_limb; };
  int side = 2 * section.axis + (section.flipped != mirrored(section.axis) ? 1 : 0);
  double depth_percent = 100.0 * static_cast<double>(section.flipped ? section.share : 1.0f - section.share);
  const bool turned = ui::choice("see.section_side", side, kSides);
  const bool moved = ui::slider("see.section_depth", depth_percent, {0.0f, 100.0f}, "%.0f %%");
  if (!turned && !moved) return;
  section.axis = side / 2;
  section.flipped = (side % 2 == 1) != mirrored(section.axis);
  const auto depth = static_cast<float>(0.01 * depth_percent);
  section.share = section.flipped ? depth : 1.0f - depth;
}

}  // namespace

void draw_see_panel(PanelContext& context) {
  ViewState& view = context.view;
  ui::heading("see.colours");
  int colour = static_cast<int>(view.colour);
  if (ui::choice("see.colour", colour, kColours)) view.colour = static_cast<MuscleColour>(colour);
  ui::heading("see.layers");
  draw_opacity("see.superficial", view.layers.superficial);
  draw_opacity("see.deep", view.layers.deep);
  draw_opacity("see.bones", view.layers.bones);
  ui::heading("see.marks");
  if (!view.names_hidden) {
    ui::checkbox("see.labels", view.labels);
    int names = static_cast<int>(view.names);
    if (ui::choice("see.names", names, kNames)) view.names = static_cast<NameStyle>(names);
  }
  ui::checkbox("see.lines", view.lines);
  ui::checkbox("see.fibres", view.fibres);
  ui::checkbox("see.attachments", view.attachments);
  draw_section(view.section, context.specimen.side != "right");
}

}  // namespace myotact::view
