#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"
#include "view/window/shown_scene.h"

// What a person saves and opens again: works, bookmarks, notes.

namespace myotact::view {

namespace {

/// By which a scene is opened from any folder: a built-in name stays one, a path becomes absolute.
std::string lasting_name(const SceneFacts& facts) {
  const bool built_in = std::find(facts.scenes.begin(), facts.scenes.end(), facts.file) != facts.scenes.end();
  return built_in ? facts.file : std::filesystem::absolute(facts.file).lexically_normal().string();
}

}  // namespace

/// In memory at each letter, on the disk when the typing ends.
void ShownScene::take_marks(const WindowAsks& asks) {
  if (asks.note) {
    if (asks.note->text.empty()) {
      marks_.notes.erase(asks.note->part);
    } else {
      marks_.notes[asks.note->part] = asks.note->text;
    }
    marks_unsaved_ = true;
  }
  if (asks.bookmarks) {
    marks_.bookmarks = *asks.bookmarks;
    marks_unsaved_ = true;
  }
  if (!ui::is_held()) keep_marks();
}

void ShownScene::keep_marks() {
  if (!marks_unsaved_) return;
  marks_unsaved_ = false;
  try {
    write_marks(marks_, specimen_->name, marks_file(specimen_->name));
  } catch (const std::exception& failure) {  // the window may be gone, and its message with it
    message = ui::tr("session.marks_not_kept", ui::retold(failure.what()));
    std::fprintf(stderr, "myotact: %s\n", message.c_str());
  }
}

void ShownScene::report_missing(const std::vector<std::string>& parts) {
  constexpr std::size_t kMost = 5;  // more would not fit the line that messages have
  if (parts.empty()) return;
  const std::vector<std::string> first(parts.begin(),
                                       parts.begin() + static_cast<std::ptrdiff_t>(std::min(parts.size(), kMost)));
  message = fmt::format("{} {}", message, ui::tr("session.parts_missing", parts.size(), join(first)));
}

void ShownScene::save(const std::string& name) {
  SavedWork work{lasting_name(facts_),           facts_.tissue, specimen_->name,    saved_view(state_.view, *specimen_),
                 scene_state_of(scene_.state()), marks_,        demonstrate_.kept()};
  if (transition_.share < 1.0f) work.view.look.camera = transition_.to;
  try {
    message = ui::tr("session.saved", save_work(work, name).string());
  } catch (const Error& failure) {
    message = ui::tr("session.not_saved", ui::retold(failure.what()));
  }
  works_.refresh();
}

void ShownScene::open(const std::filesystem::path& file) {
  try {
    const SavedWork work = read_work(file, facts_.scenes);
    if (work.scene == lasting_name(facts_) && work.tissue == facts_.tissue) {
      begin_with(work);
    } else {
      wish = SceneWish{work.scene, work.tissue, {}, work};
    }
  } catch (const Error& failure) {
    message = ui::tr("session.not_opened", ui::retold(failure.what()));
  }
}

void ShownScene::begin_with(const SavedWork& work) {
  message = ui::tr("session.opened");
  report_missing(show(work.view, *specimen_, state_.view));
  scene_.restore(work.state);
  if (work.kept != KeptStates{}) demonstrate_.keep(work.kept);  // else the person's own stay
  transition_.share = 1.0f;
  timeline_.back_to_now();
  const JoinedMarks both = joined(marks_, work.marks);
  if (both.differing_notes > 0) {
    message = fmt::format("{} {}", message, ui::tr("session.own_notes_stay", both.differing_notes));
  }
  if (both.marks == marks_) return;
  marks_ = both.marks;
  marks_unsaved_ = true;
  keep_marks();
}

}  // namespace myotact::view
