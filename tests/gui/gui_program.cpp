#include "gui/gui_program.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace myotact::testing {

namespace {

using Clock = std::chrono::steady_clock;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string output_of(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("no shell: " + command);
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), got);
  ::pclose(pipe);
  return output;
}

/// Until the condition holds or the time is over; true when it held.
bool wait_for(const std::function<bool()>& condition, double seconds) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (Clock::now() > end) return false;
    pause_s(0.01);
  }
  return true;
}

}  // namespace

void pause_s(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

Child::Child(const std::string& command, const std::filesystem::path& log) {
  const std::string run = "exec " + command;
  id_ = ::fork();
  if (id_ < 0) throw std::runtime_error("no process: " + command);
  if (id_ > 0) return;
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  ::execl("/bin/sh", "sh", "-c", run.c_str(), static_cast<char*>(nullptr));
  ::_exit(127);
}

Child::~Child() {
  if (!running()) return;
  ::kill(id_, SIGTERM);
  if (wait(5.0) >= 0) return;
  ::kill(id_, SIGKILL);
  wait(5.0);
}

bool Child::running() {
  if (ended_) return false;
  int status = 0;
  if (::waitpid(id_, &status, WNOHANG) == 0) return true;
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  ended_ = true;
  return false;
}

int Child::wait(double seconds) {
  return wait_for([this] { return !running(); }, seconds) ? status_ : -1;
}

void GuiTest::SetUp() {
  std::string missing;
  for (const char* tool : {"Xvfb", "xdotool", "import", "convert", "compare"}) {
    if (std::system(("command -v " + std::string(tool) + " >/dev/null").c_str()) != 0)
      missing += std::string(" ") + tool;
  }
  if (!missing.empty()) GTEST_SKIP() << "not installed:" << missing << " (packages xvfb, xdotool, imagemagick)";
}

GuiProgram::GuiProgram(const std::string& name, const std::string& arguments, const std::string& environment,
                       const std::string& program)
    : folder_(std::filesystem::path(MYOTACT_GUI_PICTURES) / name) {
  std::filesystem::remove_all(folder_);
  std::filesystem::create_directories(folder_ / "home");
  display_ =
      std::make_unique<Child>("Xvfb -displayfd 1 -screen 0 1280x800x24 -nolisten tcp 2>/dev/null", folder_ / "display");
  if (!wait_for([&] { return text_of(folder_ / "display").find('\n') != std::string::npos; }, 30.0)) {
    throw std::runtime_error("no virtual display");
  }
  const std::string number = text_of(folder_ / "display");
  display_name_ = ":" + number.substr(0, number.find('\n'));
  const std::string home = (folder_ / "home").string();
  std::filesystem::create_directories(folder_ / "home/config/myotact");
  std::ofstream(folder_ / "home/config/myotact/settings.json") << R"({"schema": 1, "tour_done": true})";
  program_ = std::make_unique<Child>(
      "env DISPLAY=" + display_name_ + " HOME=" + home + " XDG_CONFIG_HOME=" + home + "/config XDG_DATA_HOME=" + home +
          "/data XDG_STATE_HOME=" + home + "/state " + environment + " " + program + " view " + arguments + " --out " +
          (folder_ / "out").string() + " --report-state " + (folder_ / "state.json").string(),
      folder_ / "log");
  const bool drawn = wait_for([&] { return !program_->running() || !state().is_null(); }, 120.0);
  if (!drawn || !program_->running()) throw std::runtime_error("no window: " + log());
  xdotool("search --name Myotact windowmove 0 0 windowfocus");
  pause_s(0.5);
}

std::string GuiProgram::log() const {
  return text_of(folder_ / "log");
}

nlohmann::json GuiProgram::state() const {
  const std::string text = text_of(folder_ / "state.json");
  return text.empty() ? nlohmann::json() : nlohmann::json::parse(text);
}

bool GuiProgram::wait_until(const std::function<bool(const nlohmann::json&)>& condition, double seconds) const {
  return wait_for([&] { return condition(state()); }, seconds);
}

void GuiProgram::let_draw() const {
  // The picture of the next report may have taken its input before; those after it have not. A pointer and its button
  // are taken in one after the other, each with a picture.
  constexpr int kPictures = 3;
  const auto picture = [this] {
    const nlohmann::json now = state();
    return now.is_null() ? 0 : now["picture"].get<int>();
  };
  const int before = picture();
  wait_for([&] { return picture() > before; }, 30.0);
  const int next = picture();
  wait_for([&] { return picture() >= next + kPictures; }, 30.0);
}

std::string GuiProgram::value_of(const std::string& control) const {
  const nlohmann::json now = state();
  for (const auto& shown : now["controls"]) {
    if (shown["key"] == control) return shown["value"];
  }
  return "";
}

bool GuiProgram::shows(const std::string& control) const {
  const nlohmann::json now = state();
  for (const auto& shown : now["controls"]) {
    if (shown["key"] == control) return true;
  }
  return false;
}

std::array<double, 4> GuiProgram::box_of(const std::string& control) const {
  constexpr int kMostMoves = 10;  // a page whose text has changed takes some pictures to find its size
  if (!wait_for([&] { return shows(control); }, 30.0)) throw std::runtime_error("no control " + control);
  const auto box_now = [&] {
    const nlohmann::json now = state();
    for (const auto& shown : now["controls"]) {
      if (shown["key"] == control) return shown["box"].get<std::array<double, 4>>();
    }
    throw std::runtime_error("the control is gone: " + control);
  };
  std::array<double, 4> box = box_now();
  for (int move = 0; move < kMostMoves; ++move) {
    let_draw();
    if (const auto before = std::exchange(box, box_now()); before == box) break;
  }
  return box;
}

std::array<double, 2> GuiProgram::place_of(const std::string& kind, const std::string& part) const {
  return state().at("places").at(kind).at(part);
}

void GuiProgram::xdotool(const std::string& arguments) const {
  const std::string command = "DISPLAY=" + display_name_ + " xdotool " + arguments + " >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
}

void GuiProgram::resize(int width, int height) {
  xdotool("search --name Myotact windowsize " + std::to_string(width) + " " + std::to_string(height));
  pause_s(0.5);
}

void GuiProgram::hide() {
  xdotool("search --name Myotact windowunmap");
}

void GuiProgram::show() {
  xdotool("search --name Myotact windowmap");
}

void GuiProgram::drag_window(int x, int y) {
  xdotool("search --name Myotact windowmove " + std::to_string(x) + " " + std::to_string(y));
}

void GuiProgram::move_to(double x, double y) {
  xdotool("mousemove " + std::to_string(static_cast<int>(x)) + " " + std::to_string(static_cast<int>(y)));
  let_draw();
}

void GuiProgram::press(int button) {
  xdotool("mousedown " + std::to_string(button));
  let_draw();
}

void GuiProgram::release(int button) {
  xdotool("mouseup " + std::to_string(button));
  let_draw();
}

void GuiProgram::click_at(double x, double y, int button) {
  move_to(x, y);
  press(button);
  release(button);
}

void GuiProgram::click(const std::string& control, int button) {
  const auto box = box_of(control);
  click_at(box[0] + 0.5 * box[2], box[1] + 0.5 * box[3], button);
}

void GuiProgram::double_click(const std::string& control) {
  const auto box = box_of(control);
  move_to(box[0] + 0.5 * box[2], box[1] + 0.5 * box[3]);
  xdotool("click --repeat 2 --delay 220 1");
  let_draw();
}

void GuiProgram::drag_slider(const std::string& control, double from, double to) {
  const auto box = box_of(control);
  const auto x_of = [&](double share) { return box[0] + box[2] * share; };
  const double y = box[1] + 0.5 * box[3];
  move_to(x_of(from), y);
  press();
  for (int i = 1; i <= 4; ++i) move_to(x_of(from + 0.25 * i * (to - from)), y);
  release();
}

void GuiProgram::key(const std::string& keys) {
  key_down(keys);  // for as long as a finger does, so that a slow picture sees it
  key_up(keys);
}

void GuiProgram::tap(const std::string& key) {
  xdotool("keydown " + key);
  pause_s(0.08);  // ImGui repeats after 0.2 s
  xdotool("keyup " + key);
  let_draw();
}

void GuiProgram::key_down(const std::string& key) {
  xdotool("keydown " + key);
  let_draw();
}

void GuiProgram::key_up(const std::string& key) {
  xdotool("keyup " + key);
  let_draw();
}

void GuiProgram::type(const std::string& text) {
  xdotool("type --delay 120 '" + text + "'");
  let_draw();
}

std::filesystem::path GuiProgram::screenshot(const std::string& name) const {
  const std::filesystem::path picture = folder_ / (name + ".png");
  const std::string command = "DISPLAY=" + display_name_ + " import -window root " + picture.string();
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  return picture;
}

int colours_in(const std::filesystem::path& picture, const std::array<int, 4>& box) {
  std::ostringstream crop;
  crop << box[2] << "x" << box[3] << "+" << box[0] << "+" << box[1];
  return std::stoi(output_of("convert " + picture.string() + " -crop " + crop.str() + " -format %k info:"));
}

double picture_difference(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto small = [](const std::filesystem::path& picture) {
    return " \\( " + picture.string() + " -resize '160x100!' -alpha off \\)";
  };
  return std::stod(output_of("convert" + small(a) + small(b) +
                             " -compose difference -composite -colorspace Gray -format '%[fx:mean]' info:"));
}

}  // namespace myotact::testing
