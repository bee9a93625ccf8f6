#pragma once

#include <optional>
#include <string>

#include "view/panels/panel.h"

namespace myotact::view {

/// The person's bookmarks of this specimen: a click rotates the view there, and undo back. Each can be renamed and
/// deleted; the one deleted last can be had back.
class BookmarkList {
 public:
  void draw(PanelContext& context);

 private:
  void draw_row(PanelContext& context, std::size_t row);
  void draw_renaming(PanelContext& context, std::size_t row);

  struct Renaming {
    std::size_t row = 0;
    std::string name;
    bool focused = false;  // has the keyboard been given to it?
  };

  std::string new_name_;
  std::optional<Renaming> renaming_;
  std::optional<Bookmark> deleted_;
};

}  // namespace myotact::view
