#pragma once

#include <string>
#include <vector>

#include "anatomy/name_search.h"
#include "view/panels/panel.h"

namespace myotact::view {

/// At the left: a search by any name, the bones and muscles by region and function, and what is known of the one that
/// is selected. A click selects, a double click isolates, a right click opens the part's menu.
class FindPanel {
 public:
  void draw(PanelContext& context);
  /// The pointer of the keyboard goes to the search.
  void focus() { focus_ = true; }
  /// The pointer of the keyboard goes to the note of the selected part.
  void focus_note() { focus_note_ = true; }
  /// Over which row the pointer rests.
  const Part& hovered() const { return hovered_; }

 private:
  void draw_row(PanelContext& context, const Part& part);
  void select_first(PanelContext& context);
  void offer_scenes(PanelContext& context) const;
  void draw_results(PanelContext& context);
  void draw_tree(PanelContext& context);
  void draw_region(PanelContext& context, const std::string& region);

  std::string text_;
  bool focus_ = false, focus_note_ = false;
  Part hovered_;
};

/// What is known of the selected part. `write`: the keyboard goes to its note.
void draw_part_card(PanelContext& context, bool write);

}  // namespace myotact::view
