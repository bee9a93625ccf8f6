#include "view/panels/plots_panel.h"

#include <array>

#include <fmt/format.h>
#include <imgui.h>

#include "core/error.h"
#include "core/file.h"
#include "core/user_folder.h"
#include "view/charts/plot.h"
#include "view/look/part_actions.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

/// Of the force on the hand, as the feel panel calls them.
struct NamedPart {
  const char* text;
  const char* column;
};
constexpr std::array<NamedPart, PlotRecord::kForceParts> kParts = {{{"feel.part.contact", "contact"},
                                                                    {"feel.part.friction", "friction"},
                                                                    {"feel.part.texture", "texture"},
                                                                    {"feel.part.line", "line"},
                                                                    {"feel.part.bone", "bone"},
                                                                    {"feel.part.tether", "tether"},
                                                                    {"feel.part.damping", "damping"},
                                                                    {"feel.part.limits", "limits"}}};

/// What there is to be shown now, in the order of the panel. Ranges: small enough to see rest, large enough that noise
/// does not fill a plot.
std::vector<PlotSheet> sheets_of(const PanelContext& context) {
  std::vector<PlotSheet> sheets;
  const auto joint = static_cast<std::size_t>(context.facts.joint);
  if (joint < context.specimen.joints.size()) {
    const std::string key = context.specimen.joints[joint].key;
    sheets.push_back({"plots.angle", 4.0, {{"", key + "_angle_deg", PlotRecord::Angle_deg}}});
    sheets.push_back({"plots.stiffness", 1.0, {{"", key + "_stiffness_Nm_rad", PlotRecord::Stiffness_Nm_rad}}});
    sheets.push_back({"plots.torque", 0.5, {{"", key + "_torque_Nm", PlotRecord::Torque_Nm}}});
  }
  sheets.push_back({"plots.force", 1.0, {{"", "tool_force_N", PlotRecord::Force_N}}});
  PlotSheet parts{"plots.parts", 0.5, {}};
  for (std::size_t p = 0; p < kParts.size(); ++p) {
    parts.curves.push_back(
        {ui::tr(kParts[p].text), fmt::format("tool_{}_N", kParts[p].column), PlotRecord::FirstPart_N + p});
  }
  sheets.push_back(parts);
  PlotSheet tensions{"plots.tension", 10.0, {}};
  for (const int muscle : context.view.plotted_muscles) {
    const Part part{PartKind::Muscle, muscle};
    tensions.curves.push_back({name_of(context.specimen, part, context.view),
                               key_of(context.specimen, part) + "_tension_N", PlotRecord::tension_column(muscle)});
  }
  if (!tensions.curves.empty()) sheets.push_back(tensions);
  return sheets;
}

}  // namespace

void PlotsPanel::add(const PanelContext& context) {
  record_.add(context.specimen, context.frame, static_cast<std::size_t>(context.facts.joint));
}

void PlotsPanel::save_csv(const PanelContext& context, const std::vector<PlotSheet>& sheets) {
  try {
    const auto path = new_user_path("exports", context.facts.name, ".csv");
    write_file(path, csv_of(shown(), sheets, shown().first_within(window_s_)));
    message_ = ui::tr("plots.saved", path.string());
  } catch (const Error& error) {
    message_ = ui::tr("plots.not_saved", ui::retold(error.what()));
  }
}

void PlotsPanel::save_svg(const PanelContext& context, const std::vector<PlotSheet>& sheets) {
  try {
    std::string saved;
    for (const PlotSheet& sheet : sheets) {
      const std::string what = sheet.key.substr(sheet.key.find('.') + 1);
      const auto path = new_user_path("exports", context.facts.name + "_" + what, ".svg");
      write_file(path, svg_of(shown(), sheet, shown().first_within(window_s_),
                              {context.facts.title, ui::tr(sheet.key.c_str()), ui::tr("plots.time")}));
      saved = path.parent_path().string();
    }
    message_ = ui::tr("plots.saved", saved);
  } catch (const Error& error) {
    message_ = ui::tr("plots.not_saved", ui::retold(error.what()));
  }
}

void PlotsPanel::draw_buttons(const PanelContext& context, const std::vector<PlotSheet>& sheets) {
  if (ui::toggle_button("plots.hold", held_.has_value())) {
    if (held_) {
      held_.reset();
    } else {
      held_ = record_;
    }
  }
  ImGui::SameLine();
  if (ui::button("plots.csv")) save_csv(context, sheets);
  ImGui::SameLine();
  if (ui::button("plots.svg")) save_svg(context, sheets);
  ImGui::SetNextItemWidth(10.0f * ImGui::GetFontSize());
  constexpr float kShortest_s = 2.0f;
  ui::slider("plots.window", window_s_, {kShortest_s, static_cast<float>(PlotRecord::kKept_s)}, "%.0f s");
  if (!message_.empty()) ui::paragraph(message_);
}

void PlotsPanel::draw(const PanelContext& context) {
  const std::vector<PlotSheet> sheets = sheets_of(context);
  draw_buttons(context, sheets);
  if (shown().size() == 0) return;
  const PlotSpan span{shown().first_within(window_s_), window_s_, 5.0f * ImGui::GetFontSize()};
  for (const PlotSheet& sheet : sheets) draw_plot(shown(), sheet, span);
  if (context.view.plotted_muscles.empty()) ui::paragraph(ui::tr("plots.how_tension"));
}

}  // namespace myotact::view
