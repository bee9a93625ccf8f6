#include "view/panels/recordings_panel.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "core/user_folder.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

std::vector<std::filesystem::path> newest_first(const std::filesystem::path& folder, const std::string& extension) {
  std::vector<std::pair<std::filesystem::file_time_type, std::filesystem::path>> found;
  std::error_code problem;  // of a folder or a file that is gone meanwhile: then it is not listed
  for (std::filesystem::directory_iterator at(folder, problem), end; !problem && at != end; at.increment(problem)) {
    std::error_code gone;
    const auto changed = at->last_write_time(gone);
    if (!gone && at->path().extension() == extension) found.emplace_back(changed, at->path());
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::filesystem::path> files;
  for (auto& [changed, file] : found) files.push_back(std::move(file));
  return files;
}

void RecordingsPanel::toggle() {
  open_ = !open_;
  if (open_) files_ = newest_first(user_data_folder() / "recordings", ".myorec");
}

void RecordingsPanel::draw(PanelContext& context) {
  if (!open_) return;
  if (ui::begin_dialog("keep.recordings_title", 30.0f, 18.0f, open_)) {
    if (files_.empty()) ui::paragraph(ui::tr("keep.no_recordings"));
    for (std::size_t i = 0; i < files_.size(); ++i) {
      if (ImGui::Selectable(files_[i].stem().c_str())) {
        context.asks.wish = SceneWish{context.facts.file, context.facts.tissue, {}, {}, files_[i]};
        open_ = false;
      }
      ui::note_control(fmt::format("keep.recording.{}", i).c_str(), files_[i].string());
    }
  }
  ImGui::End();
}

}  // namespace myotact::view
