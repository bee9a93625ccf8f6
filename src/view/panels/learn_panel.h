#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "learn/lesson_list.h"
#include "learn/lesson_run.h"
#include "view/panels/panel.h"

namespace myotact::view {

/// Lessons and quizzes: the list of them, then one step after the other, then what came of it.
class LearnPanel {
 public:
  /// Every picture, drawn or not, so that a task goes on while the person looks at another panel.
  void observe(PanelContext& context);
  void draw(PanelContext& context);

 private:
  /// A lesson under way; refers to the specimen of the scene that is open.
  struct Open {
    Open(learn::Lesson read, const PanelContext& context)
        : lesson(std::move(read)), run(lesson, context.specimen, context.part_facts), specimen(&context.specimen) {}
    learn::Lesson lesson;
    learn::LessonRun run;
    const anatomy::Specimen* specimen;
    std::optional<std::size_t> shown;  // step whose look is on the screen
  };

  void draw_list(PanelContext& context);
  void draw_listed(const learn::ListedLesson& lesson, PanelContext& context);
  void draw_step(PanelContext& context);
  void draw_steps_buttons(ViewState& view);
  void draw_results(PanelContext& context);
  void open(const learn::ListedLesson& lesson, const PanelContext& context);
  void close(ViewState& view);
  void save_results();

  std::optional<std::vector<learn::ListedLesson>> lessons_;  // none: to be read
  std::unique_ptr<Open> open_;
  std::string typed_;    // answer under way
  std::string student_;  // for the results' file
  std::string message_;  // what went wrong, or where the results are
};

}  // namespace myotact::view
