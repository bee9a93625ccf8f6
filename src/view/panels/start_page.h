#pragma once

#include <optional>
#include <string>

#include "view/panels/panel.h"
#include "view/session/settings.h"
#include "view/ui/layout.h"

namespace myotact::view {

/// What somebody comes for.
enum class Purpose { Touch, Teach, Lesson, Join };

struct StartChoice {
  Purpose purpose = Purpose::Touch;
  ClassToJoin to_join = {};  // where it is Join
};

/// What the program is for, each a large button with a sentence: for those who start it without saying what they want.
class StartPage {
 public:
  /// In the middle of `area`. A choice closes it. The language may be chosen as well, and is kept in `settings`;
  /// `message` states why it cannot be.
  std::optional<StartChoice> draw(const Area& area, Settings& settings, std::string& message);

  bool is_open() const { return open_; }
  /// Who closed it without a choice wants neither to be led.
  bool was_declined() const { return declined_; }
  void open() { *this = StartPage(), open_ = true; }

 private:
  enum class Side { Purposes, Prepare, Join };

  std::optional<StartChoice> draw_purposes();
  void draw_preparing();
  std::optional<StartChoice> draw_joining();

  bool open_ = false, declined_ = false;
  Side side_ = Side::Purposes;
  ClassToJoin to_join_;
};

}  // namespace myotact::view
