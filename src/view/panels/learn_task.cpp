#include "view/panels/learn_task.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "view/panels/lesson_look.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

struct Scribe {
  PanelContext& context;
  learn::LessonRun& run;
  std::string& typed;

  std::string name(const learn::Part& part) const {
    return name_of(context.specimen, part_of(part), context.view.names);
  }
  const learn::TaskState& state() const { return run.state(); }
};

std::string joint_name(const Scribe& s, int joint) {
  return s.context.specimen.joints[static_cast<std::size_t>(joint)].key;
}

void draw_time_held(double held_s, double hold_s) {
  draw_share("learn.held", held_s / hold_s, ui::tr("learn.held", std::min(held_s, hold_s), hold_s));
}

/// One button an option, each by its name.
void draw_options(const Scribe& s, const std::vector<learn::Part>& options) {
  for (std::size_t i = 0; i < options.size(); ++i) {
    const std::string key = fmt::format("learn.option.{}", learn::key_of(s.context.specimen, options[i]));
    const bool chosen = ImGui::Button(fmt::format("{}###{}", s.name(options[i]), key).c_str(), ImVec2(-1.0f, 0.0f));
    ui::note_control(key.c_str());
    if (chosen) s.run.choose(i);
  }
}

/// A bar of force with the band that is asked for on it.
void draw_band(double force_N, const learn::PressTask& task) {
  const double most_N = 1.6 * task.high_N;
  const float height = 1.4f * ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const auto x_of = [&](double newtons) {
    return corner.x + width * static_cast<float>(std::clamp(newtons / most_N, 0.0, 1.0));
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const auto box = [&](double from_N, double to_N, float inset, ImGuiCol colour) {
    list.AddRectFilled(ImVec2(x_of(from_N), corner.y + inset), ImVec2(x_of(to_N), corner.y + height - inset),
                       ImGui::GetColorU32(colour));
  };
  box(0.0, most_N, 0.0f, ImGuiCol_FrameBg);
  box(task.low_N, task.high_N, 0.0f, ImGuiCol_HeaderActive);
  box(0.0, force_N, 0.35f * height, ImGuiCol_PlotHistogram);
  for (const double edge_N : {task.low_N, task.high_N}) {
    list.AddLine(ImVec2(x_of(edge_N), corner.y), ImVec2(x_of(edge_N), corner.y + height),
                 ImGui::GetColorU32(ImGuiCol_Text), 2.0f);
  }
  ImGui::Dummy(ImVec2(width, height));
  ui::note_control("learn.band", fmt::format("{:.2f}", force_N));
  const char* where = force_N < task.low_N    ? "learn.press.more"
                      : force_N > task.high_N ? "learn.press.less"
                                              : "learn.press.good";
  ui::paragraph(ui::tr("learn.press.force", force_N, task.low_N, task.high_N, ui::tr(where)));
}

/// Shows it where the tool is on another muscle than the one asked for.
void draw_place(const Scribe& s, int messages::ToolFrame::*what, int wanted, const char* key) {
  for (const messages::ToolFrame& tool : s.context.frame.tools) {
    if (tool.*what >= 0 && tool.*what != wanted) ui::paragraph(ui::tr(key, s.name({tool.*what, -1})));
  }
}

void draw(const Scribe&, const learn::ReadTask&) {}

void draw(const Scribe& s, const learn::FindTask&) {
  if (!s.state().done) ui::paragraph(ui::tr("learn.find"));
}

void draw(const Scribe& s, const learn::TouchTask& task) {
  if (s.state().done) return;
  ui::paragraph(ui::tr("learn.touch"));
  draw_place(s, &messages::ToolFrame::touched_muscle, task.part.muscle, "learn.on_other");
}

void draw(const Scribe& s, const learn::NameTask& task) {
  if (s.state().done) return;
  if (!task.options.empty()) return draw_options(s, task.options);
  ui::input_text("learn.typed", s.typed);
  const bool entered = ui::is_entered();
  if ((ui::button("learn.answer") || entered) && !s.typed.empty()) s.run.type(s.typed);
}

void draw(const Scribe& s, const learn::PressTask& task) {
  if (s.state().done) return;
  ui::paragraph(ui::tr("learn.press", s.name({task.muscle, -1})));
  draw_band(s.state().force_N, task);
  draw_time_held(s.state().held_s, task.hold_s);
  draw_place(s, &messages::ToolFrame::touched_muscle, task.muscle, "learn.on_other");
}

void draw_explanation(const Scribe& s, const learn::PredictTask& task) {
  const double moment_arm_mm = 1e3 * s.state().moment_arm_m;
  const std::string muscle = s.name({task.muscle, -1}), joint = joint_name(s, task.joint);
  ui::paragraph(ui::tr(moment_arm_mm > 0.0 ? "learn.predict.flexes" : "learn.predict.extends", muscle,
                       std::abs(moment_arm_mm), joint));
}

void draw(const Scribe& s, const learn::PredictTask& task) {
  const learn::TaskState& state = s.state();
  if (!state.predicted) {
    ui::paragraph(ui::tr("learn.predict", s.name({task.muscle, -1}), joint_name(s, task.joint)));
    if (ui::button("learn.flexion")) s.run.predict(learn::Motion::Flexion);
    ImGui::SameLine();
    if (ui::button("learn.extension")) s.run.predict(learn::Motion::Extension);
    return;
  }
  const bool flexion = *state.predicted == learn::Motion::Flexion;
  ui::paragraph(ui::tr("learn.predicted", ui::tr(flexion ? "learn.flexion" : "learn.extension")));
  if (state.done) return draw_explanation(s, task);
  ui::paragraph(ui::tr("learn.pull", s.name({task.muscle, -1})));
  draw_share("learn.turned", std::abs(state.turned_rad) / task.turn_rad,
             ui::tr("learn.turned", kDegrees * state.turned_rad));
  draw_place(s, &messages::ToolFrame::grabbed_line, task.muscle, "learn.holds_other");
}

void draw(const Scribe& s, const learn::StiffenTask& task) {
  const learn::TaskState& state = s.state();
  double common = s.context.scene.state().common;
  if (ui::slider("learn.common", common, {0.0f, 1.0f})) s.context.scene.push(messages::CoContract{common, 0.0});
  if (state.done) return;
  const double wanted = task.factor * state.lowest_Nm_rad;
  if (wanted <= 0.0) return;  // it has not come to rest yet
  draw_share("learn.stiffness", state.stiffness_Nm_rad / wanted,
             ui::tr("learn.stiffness", state.stiffness_Nm_rad, wanted));
  const bool strayed = std::abs(state.turned_rad) > task.within_rad;
  ui::paragraph(ui::tr(strayed ? "learn.strayed" : "learn.stays", kDegrees * std::abs(state.turned_rad),
                       kDegrees * task.within_rad));
  draw_time_held(state.held_s, task.hold_s);
}

void draw(const Scribe& s, const learn::IdentifyTask& task) {
  if (s.state().done) return;
  const bool on_it = s.state().touched && s.state().held_s > 0.0;
  ui::paragraph(ui::tr(on_it ? "learn.identify.found" : s.state().touched ? "learn.identify.left" : "learn.identify"));
  draw_options(s, task.options);
}

/// What a wrong answer was, where it was a part of the specimen.
std::string wrong_text(const Scribe& s) {
  const anatomy::Specimen& specimen = s.context.specimen;
  const std::string& key = s.state().answer;
  learn::Part part{anatomy::find_muscle(specimen, key), -1};
  for (std::size_t b = 0; part.muscle < 0 && b < specimen.bones.size(); ++b) {
    if (specimen.bones[b].key == key) part.bone = static_cast<int>(b);
  }
  return part == learn::Part{} ? ui::tr("learn.wrong") : ui::tr("learn.wrong_part", s.name(part));
}

void draw_feedback(const Scribe& s) {
  const learn::TaskState& state = s.state();
  std::string text;
  if (state.feedback == learn::Feedback::Right) text = ui::tr("learn.right");
  if (state.feedback == learn::Feedback::TouchFirst) text = ui::tr("learn.touch_first");
  if (state.feedback == learn::Feedback::Wrong) {
    const bool predicted = std::holds_alternative<learn::PredictTask>(s.run.step().task);
    text = predicted ? ui::tr("learn.wrong_prediction") : wrong_text(s);
  }
  if (text.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
  ui::paragraph(text);
  ImGui::PopStyleColor();
}

}  // namespace

void draw_share(const char* key, double share, const std::string& text) {
  ui::bar(share, text);
  ui::note_control(key, fmt::format("{:.3f}", share));
}

void draw_task(PanelContext& context, learn::LessonRun& run, std::string& typed) {
  const Scribe scribe{context, run, typed};
  std::visit([&](const auto& task) { draw(scribe, task); }, run.step().task);
  draw_feedback(scribe);
}

}  // namespace myotact::view
