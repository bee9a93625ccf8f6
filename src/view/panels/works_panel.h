#pragma once

#include <string>
#include <vector>

#include "view/panels/panel.h"

namespace myotact::view {

/// Saves the work under a name, and lists what was saved, newest first; a click opens it. A window over the others.
class WorksPanel {
 public:
  void toggle();
  /// Reads the list again where it is shown.
  void refresh();
  void draw(PanelContext& context);

 private:
  void draw_list(PanelContext& context);

  bool open_ = false;
  std::string name_;
  std::vector<ListedWork> works_;
};

}  // namespace myotact::view
