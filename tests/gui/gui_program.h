#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/types.h>

namespace myotact::testing {

/// A child process, ended (SIGTERM, after five seconds SIGKILL) when it goes out of scope.
class Child {
 public:
  /// `log`: for its standard output and error. Throws when it cannot be started.
  Child(const std::string& command, const std::filesystem::path& log);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t id() const { return id_; }
  bool running();
  /// Its exit status, or 128 + signal; -1 when it still runs after that time.
  int wait(double seconds);

 private:
  pid_t id_ = -1;
  int status_ = -1;
  bool ended_ = false;
};

/// Skips, and says what to install, where the tools of these tests are missing.
class GuiTest : public ::testing::Test {
 protected:
  void SetUp() override;
};

/// The program's window on a virtual display of its own, with a home of its own, driven by a real pointer and real
/// keys. It says what it shows by --report-state; controls are found by their keys.
class GuiProgram {
 public:
  /// `name`: of the folder that keeps its pictures and logs. Waits until the first pictures are drawn.
  /// The display has 1280 x 800 pixels. Throws when there is no window after two minutes.
  /// `program`: in place of myotact, with the same arguments.
  GuiProgram(const std::string& name, const std::string& arguments, const std::string& environment = "",
             const std::string& program = MYOTACT_PROGRAM);

  /// What it shows now: of the newest report.
  nlohmann::json state() const;
  /// Waits until what was put in has been drawn, however slow the machine is.
  void let_draw() const;
  /// Waits until what it shows meets the condition; false when it does not within the time.
  bool wait_until(const std::function<bool(const nlohmann::json&)>& condition, double seconds = 60.0) const;
  std::string value_of(const std::string& control) const;  // "" where it is not shown
  bool shows(const std::string& control) const;
  /// x, y, width, height [pixels]; throws when it is not shown within half a minute.
  std::array<double, 4> box_of(const std::string& control) const;

  void resize(int width, int height);  // the window
  void hide(), show();
  void drag_window(int x, int y);  // its corner on the screen [pixels]
  void move_to(double x, double y);
  void press(int button = 1), release(int button = 1);
  void click_at(double x, double y, int button = 1);
  /// The middle of a control; throws when it is not shown within half a minute.
  void click(const std::string& control, int button = 1);
  void double_click(const std::string& control);
  /// Along a slider, from its left end; shares 0 .. 1 of its track.
  void drag_slider(const std::string& control, double from, double to);
  void key(const std::string& keys);  // as xdotool names them: "ctrl+z"
  void tap(const std::string& key);   // so shortly that it does not repeat
  void key_down(const std::string&key), key_up(const std::string&key);
  void type(const std::string& text);

  /// A picture of the display, kept as NAME.png in the folder of this program's pictures.
  std::filesystem::path screenshot(const std::string& name) const;
  /// Places of a part on the screen [pixels]; throws when it is not on the screen.
  std::array<double, 2> place_of(const std::string& kind, const std::string& part) const;

  Child& program() { return *program_; }
  Child& display() { return *display_; }
  const std::filesystem::path& folder() const { return folder_; }
  std::string log() const;

 private:
  void xdotool(const std::string& arguments) const;

  std::filesystem::path folder_;
  std::string display_name_;
  std::unique_ptr<Child> display_, program_;
};

/// Different colours in a part of a picture: a blank one has one. `box`: x, y, width, height.
int colours_in(const std::filesystem::path& picture, const std::array<int, 4>& box);

/// Mean difference of two pictures of any size, both brought to 160 x 100: 0 .. 1.
double picture_difference(const std::filesystem::path& a, const std::filesystem::path& b);

void pause_s(double seconds);

}  // namespace myotact::testing
