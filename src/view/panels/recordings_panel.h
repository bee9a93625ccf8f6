#pragma once

#include <filesystem>
#include <vector>

#include "view/panels/panel.h"

namespace myotact::view {

/// The person's recordings, newest first; a click plays one. A window over the others.
class RecordingsPanel {
 public:
  void toggle();
  void draw(PanelContext& context);

 private:
  bool open_ = false;
  std::vector<std::filesystem::path> files_;
};

/// Files of that extension in a folder, newest first by their time of change; none where the folder is not there.
std::vector<std::filesystem::path> newest_first(const std::filesystem::path& folder, const std::string& extension);

}  // namespace myotact::view
