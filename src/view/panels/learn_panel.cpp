#include "view/panels/learn_panel.h"

#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "learn/lesson_file.h"
#include "learn/lesson_results.h"
#include "view/panels/learn_task.h"
#include "view/panels/lesson_look.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

std::string points_text(double points) {
  return to_text(std::round(points * 100.0) / 100.0);
}

/// The frame of a part of the list, named by its lesson for who looks for it.
void title_line(const std::string& title, bool strong) {
  if (strong) ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_PlotHistogram));
  ui::paragraph(title);
  if (strong) ImGui::PopStyleColor();
}

}  // namespace

void LearnPanel::observe(PanelContext& context) {
  if (!open_) return;
  if (open_->specimen != &context.specimen) {  // another scene was opened: its names mean other parts
    open_.reset();
    return;
  }
  const learn::Part selected{context.view.selected_muscle, context.view.selected_bone};
  learn::LessonRun& run = open_->run;
  run.observe({context.specimen, context.frame, ImGui::GetTime(), selected});
  // Also after an undo. What has been answered may be read again.
  context.view.names_hidden = !run.finished() && !run.state().done && hides_names(run.step().task);
}

void LearnPanel::draw(PanelContext& context) {
  if (!open_) return draw_list(context);
  if (!open_->run.finished()) return draw_step(context);
  if (open_->shown) end_lesson_look(context.view);
  open_->shown.reset();  // to be shown again by who goes back
  draw_results(context);
}

void LearnPanel::draw_list(PanelContext& context) {
  if (!lessons_) lessons_ = learn::list_lessons();
  ui::paragraph(ui::tr("learn.intro"));
  if (!message_.empty()) ui::paragraph(message_);
  ImGui::Spacing();
  const std::size_t count = lessons_->size();
  for (std::size_t i = 0; i < count && !open_; ++i) draw_listed((*lessons_)[i], context);
  if (open_) return;
  ui::paragraph(ui::tr("learn.own", learn::own_lessons_folder().string()));
  if (ui::button("learn.refresh")) {
    lessons_.reset();
    message_.clear();
  }
}

void LearnPanel::draw_listed(const learn::ListedLesson& lesson, PanelContext& context) {
  ImGui::PushID(lesson.path.c_str());
  if (!lesson.complaint.empty()) {
    title_line(lesson.path.filename().string(), true);
    ui::paragraph(ui::tr("learn.broken", lesson.complaint));
    ImGui::PopID();
    return;
  }
  const bool here = lesson.head.scene == context.facts.name;
  ImGui::BeginDisabled(!here && context.news.opening);
  const bool pressed =
      ImGui::Button(fmt::format("{}###start", ui::tr(here ? "learn.start" : "learn.open_scene")).c_str());
  ui::note_control(fmt::format("learn.{}.{}", here ? "start" : "open_scene", lesson.head.key).c_str());
  ImGui::EndDisabled();
  ImGui::SameLine();
  const std::string about = ui::tr("learn.about", lesson.head.scene, lesson.head.steps);
  ImGui::TextUnformatted(ui::shortened(lesson.head.title, ImGui::GetContentRegionAvail().x).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\n%s", lesson.head.title.c_str(), about.c_str());
  ImGui::PopID();
  if (!pressed) return;
  if (here) return open(lesson, context);
  context.asks.wish = SceneWish{lesson.head.scene, "", {}};
}

void LearnPanel::open(const learn::ListedLesson& lesson, const PanelContext& context) {
  message_.clear();
  typed_.clear();
  try {
    open_ = std::make_unique<Open>(learn::load_lesson(lesson.path, context.specimen), context);
  } catch (const Error& error) {
    message_ = ui::tr("learn.broken", ui::retold(error.what()));
  }
}

void LearnPanel::close(ViewState& view) {
  open_.reset();
  message_.clear();
  end_lesson_look(view);
}

void LearnPanel::draw_step(PanelContext& context) {
  learn::LessonRun& run = open_->run;
  if (open_->shown != run.index()) {
    show_step(run.step(), context.view, context.scene);
    if (!run.step().view.empty()) context.asks.standard_view = run.step().view.c_str();
    context.asks.pointer_mode = pointer_mode_for(run.step().task);
    open_->shown = run.index();
    typed_.clear();
  }
  const std::size_t steps = run.lesson().steps.size();
  title_line(run.lesson().title, true);
  const std::string progress = ui::tr("learn.progress", run.index() + 1, steps, points_text(run.score()),
                                      points_text(learn::most_points(run.lesson())));
  draw_share("learn.progress", static_cast<double>(run.index() + 1) / static_cast<double>(steps), progress);
  // What is read and done scrolls; the buttons beneath it stay where they are.
  ImGui::BeginChild("step", ImVec2(0.0f, -ImGui::GetFrameHeightWithSpacing() - ImGui::GetStyle().ItemSpacing.y));
  title_line(run.step().title, true);
  ui::paragraph(run.step().text);
  ImGui::Spacing();
  draw_task(context, run, typed_);
  for (int h = 0; h < run.state().hints; ++h) {
    ui::paragraph(ui::tr("learn.hint_text", run.step().hints[static_cast<std::size_t>(h)]));
  }
  ImGui::EndChild();
  draw_steps_buttons(context.view);
}

/// Each has its place whatever the step, so that a second click never meets another one.
void LearnPanel::draw_steps_buttons(ViewState& view) {
  learn::LessonRun& run = open_->run;
  const auto enabled_button = [](bool enabled, const char* key) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ui::button(key);
    ImGui::EndDisabled();
    ImGui::SameLine();
    return pressed;
  };
  const bool hints_left = run.state().hints < static_cast<int>(run.step().hints.size());
  if (enabled_button(run.index() > 0, "learn.back")) run.go_back();
  if (enabled_button(hints_left && !run.state().done, "learn.hint")) run.ask_hint();
  const bool goes_on = run.state().done || std::holds_alternative<learn::ReadTask>(run.step().task);
  const bool ends = enabled_button(true, "learn.close");
  const char* next = ui::tr("learn.next");
  if (!goes_on) {
    ImGui::Dummy(ImVec2(ImGui::CalcTextSize(next).x + 2.0f * ImGui::GetStyle().FramePadding.x, 0.0f));
    ImGui::SameLine();
  }
  if (ui::button(goes_on ? "learn.next" : "learn.leave_out")) run.go_on();
  if (ends) close(view);
}

void LearnPanel::draw_results(PanelContext& context) {
  const learn::LessonRun& run = open_->run;
  title_line(run.lesson().title, true);
  ui::paragraph(ui::tr("learn.finished", points_text(run.score()), points_text(learn::most_points(run.lesson()))));
  ImGui::Spacing();
  for (std::size_t i = 0; i < run.states().size(); ++i) {
    const learn::Step& step = run.lesson().steps[i];
    if (std::holds_alternative<learn::ReadTask>(step.task)) continue;
    const double points = learn::points_of(step, run.states()[i]);
    ui::paragraph(ui::tr("learn.step_points", step.title, points_text(points), points_text(step.points)));
  }
  ImGui::Spacing();
  ui::paragraph(ui::tr("learn.save_text"));
  ui::input_text("learn.student", student_);
  if (ui::button("learn.save")) save_results();
  if (!message_.empty()) ui::paragraph(message_);
  ImGui::Spacing();
  if (ui::button("learn.back")) open_->run.go_back();
  ImGui::SameLine();
  if (ui::button("learn.close")) close(context.view);
}

void LearnPanel::save_results() {
  const std::string name = learn::results_file_name(student_, open_->lesson.key);
  const std::filesystem::path lessons = learn::own_lessons_folder();
  if (name.empty() || lessons.empty()) {
    message_ = ui::tr(name.empty() ? "learn.no_name" : "learn.no_home");
    return;
  }
  const std::filesystem::path file = lessons.parent_path() / "results" / name;
  try {
    make_writable_folder(file.parent_path());
    write_file(file, learn::results_csv(open_->run));
    message_ = ui::tr("learn.saved", file.string());
  } catch (const Error& error) {
    message_ = ui::tr("learn.not_saved", ui::retold(error.what()));
  }
}

}  // namespace myotact::view
