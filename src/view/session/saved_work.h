#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "view/session/marks.h"
#include "view/session/saved_view.h"
#include "view/state/scene_state.h"

namespace myotact::view {

/// What a person saves and opens again: the scene, how it is looked at, what is set of it, and the person's marks. Not
/// where joints and tissue are: the scene begins as it always does.
struct SavedWork {
  std::string scene;     // by which it is opened: a name, or an absolute path
  std::string tissue;    // "fem", "line" ...; empty: as the scene says
  std::string specimen;  // its name
  SavedView view;
  SceneState state;
  Marks marks;
  KeptStates kept = {};

  bool operator==(const SavedWork&) const = default;
};

/// Throws Error BadData, also where its scene is neither among those that have names nor a file that is there, or what
/// reading throws.
SavedWork read_work(const std::filesystem::path& file, const std::vector<std::string>& scenes);
/// From text; `file` is named in errors. Whether the scene is there is not looked at.
SavedWork parse_work(const std::string& text, const std::string& file);
std::string work_text(const SavedWork& work);

/// Writes it into the person's own folder, as DATA/works/NAME_TIME.json; an empty `name`: the scene's. Returns the
/// file. Throws Error InputOutput.
std::filesystem::path save_work(const SavedWork& work, const std::string& name);

/// A saved work in a list.
struct ListedWork {
  std::filesystem::path file;
  std::string name, time;  // "biceps", "2026-03-01 14:05"; of a file of another name: that name, and no time
};
/// Where they lie; empty without a home.
std::filesystem::path works_folder();
/// Of the person's own folder, newest first; none where it is not there.
std::vector<ListedWork> list_works();

}  // namespace myotact::view
