#include "view/panels/find_panel.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "view/charts/colour_map.h"
#include "view/look/part_actions.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

/// Everything of the specimen, muscles first.
std::vector<Part> all_parts(const anatomy::Specimen& specimen) {
  std::vector<Part> parts;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) parts.push_back({PartKind::Muscle, static_cast<int>(m)});
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) parts.push_back({PartKind::Bone, static_cast<int>(b)});
  return parts;
}

/// Different texts in the order in which they come first.
void add_once(std::vector<std::string>& texts, const std::string& text) {
  if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
}

/// Words of the facts file in the language of the window, as they are where there is no translation.
std::string in_language(const char* what, const std::string& word) {
  const std::string key = fmt::format("{}.{}", what, word);
  return ui::has_text(key) ? ui::tr(key) : word;
}

/// Facts are English in their file; "fact." and the fact is the key of its translation.
void fact(const char* key, const std::string& text) {
  if (text.empty()) return;
  ImGui::TextDisabled("%s", ui::tr(key));
  const std::string translated = "fact." + text;
  ui::paragraph(ui::has_text(translated) ? ui::tr(translated) : text);
}

/// How strong it is, and what it does now.
void draw_mechanics(const PanelContext& context, const Part& part) {
  const auto m = static_cast<std::size_t>(part.index);
  const anatomy::Muscle& muscle = context.specimen.muscles[m];
  const bool estimated = !muscle.estimated.empty();
  ui::paragraph(ui::tr(estimated ? "card.mechanics_estimated" : "card.mechanics", muscle.peak_force_N,
                       1e3 * muscle.optimal_fibre_m));
  if (m >= context.frame.activations.size()) return;
  const glm::vec3 c = red_yellow(context.frame.activations[m]);
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImVec4(c.r, c.g, c.b, 1.0f));
  const std::string now = ui::tr("card.now", 100.0 * context.frame.activations[m], context.frame.tensions_N[m]);
  ui::bar(context.frame.activations[m], now);
  ImGui::PopStyleColor();
}

/// Takes away what is beyond the longest note, as it is typed or pasted.
int cut_note(ImGuiInputTextCallbackData* data) {
  const std::string_view text(data->Buf, static_cast<std::size_t>(data->BufTextLen));
  const auto most = static_cast<int>(bytes_of_characters(text, kLongestNote));
  if (most < data->BufTextLen) data->DeleteChars(most, data->BufTextLen - most);
  return 0;
}

/// The person's own lines about a part. `write`: the keyboard goes there.
void draw_note(PanelContext& context, const std::string& part, bool write) {
  constexpr float kLines = 2.0f;  // more scroll
  const auto& notes = context.marks.notes;
  const auto kept = notes.find(part);
  std::string text = kept == notes.end() ? std::string() : kept->second;
  ImGui::TextDisabled("%s", ui::tr("card.note"));
  ImGui::PushID(part.c_str());  // what is being typed stays with its part
  if (write) ImGui::SetKeyboardFocusHere();
  const ImVec2 size(-1.0f, kLines * ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().FramePadding.y);
  if (ImGui::InputTextMultiline("##note", &text, size, ImGuiInputTextFlags_CallbackEdit, cut_note)) {
    context.asks.note = PartNote{part, text};
  }
  ui::note_control("card.note", text);
  ImGui::PopID();
}

/// A turned-down corner on the row just drawn, and the note while the pointer rests on it.
void mark_note(const PanelContext& context, const std::string& part) {
  const auto note = context.marks.notes.find(part);
  if (note == context.marks.notes.end()) return;
  const float em = ImGui::GetFontSize();
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x, top = ImGui::GetItemRectMin().y;
  ImGui::GetWindowDrawList()->AddTriangleFilled(ImVec2(right - 0.5f * em, top), ImVec2(right, top),
                                                ImVec2(right, top + 0.5f * em),
                                                ImGui::GetColorU32(ImGuiCol_PlotHistogram));
  ui::note_control(fmt::format("find.noted.{}", part).c_str(), note->second);
  if (!ImGui::IsItemHovered()) return;
  constexpr float kWidth_em = 22.0f;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(kWidth_em * em);
  ImGui::TextUnformatted(note->second.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

/// A name that fits: heads of one muscle differ in what stands behind the comma, so that stays longest.
std::string fitting(const std::string& name, float width) {
  if (ImGui::CalcTextSize(name.c_str()).x <= width) return name;
  constexpr std::string_view kMusculus = "Musculus ";
  const std::string brief = name.starts_with(kMusculus) ? "M. " + name.substr(kMusculus.size()) : name;
  const std::size_t comma = brief.find(", ");
  if (comma == std::string::npos || ImGui::CalcTextSize(brief.c_str()).x <= width) return ui::shortened(brief, width);
  const std::string head = brief.substr(comma + 1);
  return ui::shortened(brief.substr(0, comma), 0.97f * (width - ImGui::CalcTextSize(head.c_str()).x)) + head;
}

}  // namespace

void FindPanel::draw_row(PanelContext& context, const Part& part) {
  ViewState& view = context.view;
  const std::string& key = key_of(context.specimen, part);
  const PartLook& look = look_of(view, part);
  ImGui::PushID(key.c_str());
  const ImVec4 colour = ImGui::GetStyleColorVec4(look.hidden || look.faded ? ImGuiCol_TextDisabled : ImGuiCol_Text);
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  bool shown = !look.hidden;
  if (ImGui::Checkbox("##shown", &shown)) look_of(view, part).hidden = !shown;
  ui::note_control(fmt::format("find.shown.{}", key).c_str(), shown ? "on" : "off");
  ImGui::SameLine();
  const bool selected = selected_part(view) == part;
  const std::string name = name_of(context.specimen, part, view);
  const std::string fits = fitting(name, ImGui::GetContentRegionAvail().x);
  if (ImGui::Selectable(fmt::format("{}###name", fits).c_str(), selected, ImGuiSelectableFlags_AllowDoubleClick)) {
    ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ? isolate(view, part) : select(view, part);
  }
  ui::note_control(fmt::format("find.{}", key).c_str(), selected ? "selected" : "");
  if (ImGui::IsItemHovered()) hovered_ = part;
  if (ImGui::IsItemHovered() && fits != name) ImGui::SetTooltip("%s", name.c_str());
  if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) context.asks.menu_of = part;
  mark_note(context, key);
  ImGui::PopStyleColor();
  ImGui::PopID();
}

void FindPanel::select_first(PanelContext& context) {
  const auto found = anatomy::find_parts(context.specimen, context.part_facts, text_);
  if (found.empty()) return;
  select(context.view, {found.front().bone ? PartKind::Bone : PartKind::Muscle, found.front().index});
}

/// Who looks for the stifle in the elbow looks for another scene.
void FindPanel::offer_scenes(PanelContext& context) const {
  constexpr std::size_t kTyped = 3;  // letters: fewer are in too many names
  if (text_.size() < kTyped) return;
  const auto lowered = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  const std::string wanted = lowered(text_);
  for (const std::string& scene : context.facts.scenes) {
    const bool named = scene.starts_with(wanted) || lowered(ui::tr(scene)).find(wanted) != std::string::npos;
    if (scene == context.facts.name || !named) continue;
    if (ImGui::Button(ui::tr("find.open_scene", ui::tr(scene)).c_str())) {
      context.asks.wish = SceneWish{scene, context.facts.tissue, {}};
    }
    ui::note_control("find.open_scene", scene);
  }
}

void FindPanel::draw_results(PanelContext& context) {
  const auto found = anatomy::find_parts(context.specimen, context.part_facts, text_);
  if (found.empty()) ui::paragraph(ui::tr("find.nothing", text_));
  offer_scenes(context);
  for (const anatomy::FoundPart& part : found) {
    draw_row(context, {part.bone ? PartKind::Bone : PartKind::Muscle, part.index});
  }
}

void FindPanel::draw_region(PanelContext& context, const std::string& region) {
  const auto facts = [&](const Part& part) -> const anatomy::PartFacts& {
    return anatomy::facts_of(context.part_facts, key_of(context.specimen, part));
  };
  std::vector<Part> here;
  std::vector<std::string> functions;  // of bones, and of muscles that none is known of: none
  for (const Part& part : all_parts(context.specimen)) {
    if (facts(part).region != region) continue;
    here.push_back(part);
    add_once(functions, facts(part).function);
  }
  const auto draw_group = [&](const std::string& heading, const std::string& function, PartKind kind) {
    const auto belongs = [&](const Part& part) { return facts(part).function == function && part.kind == kind; };
    if (std::none_of(here.begin(), here.end(), belongs)) return;
    ImGui::TextDisabled("%s", heading.c_str());
    for (const Part& part : here) {
      if (belongs(part)) draw_row(context, part);
    }
  };
  for (const std::string& function : functions) {
    const std::string muscles = function.empty() ? ui::tr("find.other_muscles") : in_language("function", function);
    draw_group(muscles, function, PartKind::Muscle);
    draw_group(ui::tr("find.bones"), function, PartKind::Bone);
  }
}

void FindPanel::draw_tree(PanelContext& context) {
  std::vector<std::string> regions;
  for (const Part& part : all_parts(context.specimen)) {
    add_once(regions, anatomy::facts_of(context.part_facts, key_of(context.specimen, part)).region);
  }
  for (const std::string& region : regions) {
    const std::string name = region.empty() ? ui::tr("find.elsewhere") : in_language("region", region);
    const bool open =
        ImGui::CollapsingHeader(fmt::format("{}###{}", name, region).c_str(), ImGuiTreeNodeFlags_DefaultOpen);
    ui::note_control(fmt::format("find.region.{}", region).c_str(), open ? "open" : "closed");
    if (open) draw_region(context, region);
  }
}

void FindPanel::draw(PanelContext& context) {
  hovered_ = {};
  if (context.view.names_hidden) return ui::paragraph(ui::tr("learn.names_hidden"));
  ImGui::SetNextItemWidth(-1.0f);
  if (focus_) ImGui::SetKeyboardFocusHere();
  focus_ = false;
  ui::input_text("find.search", text_);
  if (ui::is_entered() && !text_.empty()) select_first(context);
  const bool card = static_cast<bool>(selected_part(context.view));
  constexpr float kCard = 0.42f;  // of the panel's height
  const float below = card ? kCard * ImGui::GetWindowHeight() : 0.0f;
  ImGui::BeginChild("parts", ImVec2(0.0f, -below));
  text_.empty() ? draw_tree(context) : draw_results(context);
  ImGui::EndChild();
  if (!card) return;
  ImGui::BeginChild("card", ImVec2(0.0f, 0.0f), true);
  draw_part_card(context, std::exchange(focus_note_, false));
  ImGui::EndChild();
}

void draw_part_card(PanelContext& context, bool write) {
  const Part part = selected_part(context.view);
  const std::string& key = key_of(context.specimen, part);
  const anatomy::PartFacts& facts = anatomy::facts_of(context.part_facts, key);
  ViewState both = context.view;
  both.names = NameStyle::Both;
  ui::paragraph(name_of(context.specimen, part, both));
  draw_note(context, key, write);  // first: below the facts it would be out of sight
  ImGui::Separator();
  fact("card.origin", facts.origin);
  fact("card.insertion", facts.insertion);
  fact("card.action", facts.action);
  fact("card.innervation", facts.innervation);
  if (part.kind == PartKind::Muscle) draw_mechanics(context, part);
}

}  // namespace myotact::view
