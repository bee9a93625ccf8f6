#include "view/panels/bookmark_list.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "core/text.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

std::string shortened(const std::string& name) {
  return name.substr(0, bytes_of_characters(name, kLongestName));
}

/// What the buttons of a row and the gaps before them take, in this language [pixels].
float buttons_width() {
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = 0.0f;
  for (const char* key : {"session.rename", "session.delete"}) {
    width += style.ItemSpacing.x + ImGui::CalcTextSize(ui::tr(key)).x + 2.0f * style.FramePadding.x;
  }
  return width;
}

void add(PanelContext& context, Bookmark bookmark) {
  std::vector<Bookmark> bookmarks = context.marks.bookmarks;
  if (add_bookmark(bookmarks, std::move(bookmark))) {
    context.asks.bookmarks = std::move(bookmarks);
  } else {
    context.asks.message = ui::tr("session.too_many_bookmarks", kMostBookmarks);
  }
}

/// Rotates the view there; everything but the camera is shown at once.
void turn_to(PanelContext& context, const SavedView& saved) {
  const Camera camera = context.view.camera;
  const std::vector<std::string> missing = show(saved, context.specimen, context.view);
  context.asks.turn_to = std::exchange(context.view.camera, camera);
  if (!missing.empty()) context.asks.message = ui::tr("session.parts_missing", missing.size(), join(missing));
}

}  // namespace

void BookmarkList::draw_renaming(PanelContext& context, std::size_t row) {
  if (!std::exchange(renaming_->focused, true)) ImGui::SetKeyboardFocusHere();
  ui::input_text("session.new_name", renaming_->name);
  if (!ImGui::IsItemDeactivated()) return;
  const std::string name = shortened(renaming_->name);
  renaming_.reset();
  std::vector<Bookmark> bookmarks = context.marks.bookmarks;
  if (name.empty() || name == bookmarks[row].name) return;
  Bookmark renamed = std::move(bookmarks[row]);
  bookmarks.erase(bookmarks.begin() + static_cast<std::ptrdiff_t>(row));
  renamed.name = name;
  add_bookmark(bookmarks, std::move(renamed));  // which gives it a name of its own
  std::rotate(bookmarks.begin() + static_cast<std::ptrdiff_t>(row), bookmarks.end() - 1, bookmarks.end());
  context.asks.bookmarks = std::move(bookmarks);
}

void BookmarkList::draw_row(PanelContext& context, std::size_t row) {
  const Bookmark& bookmark = context.marks.bookmarks[row];
  const float names = std::max(ImGui::GetContentRegionAvail().x - buttons_width(), 1.0f);
  const std::string label = fmt::format("{}###bookmark", bookmark.name);
  ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, ImVec2(0.0f, 0.5f));
  if (ImGui::Selectable(label.c_str(), false, 0, ImVec2(names, ImGui::GetFrameHeight()))) {
    turn_to(context, bookmark.view);
  }
  ImGui::PopStyleVar();
  ui::note_control(fmt::format("session.bookmark.{}", row).c_str(), bookmark.name);
  ImGui::SameLine();
  if (ui::button("session.rename")) renaming_ = Renaming{row, bookmark.name};
  ImGui::SameLine();
  if (!ui::button("session.delete")) return;
  deleted_ = bookmark;
  std::vector<Bookmark> others = context.marks.bookmarks;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(row));
  context.asks.bookmarks = std::move(others);
}

void BookmarkList::draw(PanelContext& context) {
  ui::heading("session.bookmarks");
  const auto& bookmarks = context.marks.bookmarks;
  if (renaming_ && renaming_->row >= bookmarks.size()) renaming_.reset();
  for (std::size_t row = 0; row < bookmarks.size(); ++row) {
    ImGui::PushID(static_cast<int>(row));
    renaming_ && renaming_->row == row ? draw_renaming(context, row) : draw_row(context, row);
    ImGui::PopID();
  }
  constexpr float kName_em = 14.0f;
  ImGui::SetNextItemWidth(kName_em * ImGui::GetFontSize());
  ui::input_text("session.bookmark_name", new_name_);
  const bool entered = ui::is_entered();
  ImGui::SameLine();
  if (ui::button("session.bookmark_add") || entered) {
    const std::string name = new_name_.empty() ? ui::tr("session.bookmark_unnamed", bookmarks.size() + 1) : new_name_;
    add(context, {shortened(name), saved_view(context.view, context.specimen)});
    new_name_.clear();
  }
  if (deleted_ && ui::button("session.bring_back")) {
    add(context, *deleted_);
    deleted_.reset();
  }
}

}  // namespace myotact::view
