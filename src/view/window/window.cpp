#include "view/window/window.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "core/error.h"
#include "view/panels/start_page.h"
#include "view/pictures/window_pictures.h"
#include "view/session/settings.h"
#include "view/sound/speaker.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"
#include "view/window/glfw_window.h"
#include "view/window/imgui_session.h"
#include "view/window/shown_scene.h"

namespace myotact::view {

namespace {

/// While there is no scene yet.
void draw_waiting(const std::string& message) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 0.5f * display.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::Begin("waiting", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(message.empty() ? ui::tr("window.preparing") : message.c_str());
  ImGui::End();
}

}  // namespace

struct Window::Impl {
  Impl(const WindowSize& size, bool offers_start)
      : window("Myotact", size.width, size.height),
        imgui(window.get()),
        settings(settings_or_defaults(settings_file(), settings_message)) {
    apply(settings);
    if (offers_start) start.open();
    if (!imgui.has_font() && settings_message.empty()) settings_message = ui::tr("comfort.no_font");
  }

  void draw(const messages::SceneFrame& frame) {
    glfwPollEvents();
    imgui.set_scale(static_cast<float>(scene ? scene->scale() : settings.scale));
    imgui.begin();
    ui::begin_controls();
    if (scene) {
      scene->draw_panels(frame, window);
      sound_force();
    } else {
      const ImVec2 display = ImGui::GetIO().DisplaySize;
      if (const auto choice = start.draw({0.0f, 0.0f, display.x, display.y}, settings, settings_message))
        chosen = choice;
      if (!start.is_open()) draw_waiting(message);
    }
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window.get(), &width, &height);
    glViewport(0, 0, width, height);
    const ImVec4& panel = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg);  // panels draw no ground of their own
    glClearColor(panel.x, panel.y, panel.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    if (scene) scene->draw_limb(width, height);
    imgui.end();
    if (scene) scene->take_picture(width, height);
    if (screenshot) save_framebuffer(*std::exchange(screenshot, std::nullopt), {0, 0, width, height});
    glfwSwapBuffers(window.get());
  }

  void sound_force() {
    if (!scene->settings.tone) return speaker.reset();
    try {
      if (!speaker) speaker.emplace();
      speaker->play(scene->share_of_force());
    } catch (const Error& failure) {
      scene->settings.tone = false;
      scene->message = ui::tr("comfort.no_sound", ui::retold(failure.what()));
    }
  }

  GlfwWindow window;
  ImGuiSession imgui;
  std::string settings_message;       // until a scene can show it
  Settings settings;                  // that the first scene starts with
  std::unique_ptr<ShownScene> scene;  // none before the first one is open
  std::string message;                // while there is none
  StartPage start;                    // while there is none
  std::optional<StartChoice> chosen;  // on it
  std::optional<Speaker> speaker;     // while the person wants the tone
  std::optional<std::filesystem::path> screenshot;
};

Window::Window(const WindowSize& size, bool offers_start) : impl_(std::make_unique<Impl>(size, offers_start)) {}

Window::~Window() = default;

void Window::open(const anatomy::Specimen& specimen, const WindowSettings& settings) {
  if (impl_->scene) impl_->scene->keep_marks();  // before they are read again
  auto opened = std::make_unique<ShownScene>(specimen, settings);
  if (impl_->scene) opened->lead_on(*impl_->scene);
  if (impl_->scene && impl_->scene->facts().name == settings.facts.name) opened->take_over(*impl_->scene);
  opened->settings = impl_->scene ? impl_->scene->settings : impl_->settings;
  if (!impl_->settings_message.empty()) opened->message = std::exchange(impl_->settings_message, {});
  if (!impl_->scene) opened->begin_with(impl_->start);
  if (impl_->chosen) opened->begin_with(*std::exchange(impl_->chosen, std::nullopt));
  impl_->scene = std::move(opened);
  glfwSetWindowTitle(impl_->window.get(), settings.facts.title.c_str());
}

void Window::set_readings(const JointReadings& readings) {
  if (impl_->scene) impl_->scene->readings = readings;
}

void Window::set_news(const SessionNews& news) {
  if (impl_->scene) impl_->scene->news = news;
}

void Window::push_view(const std::array<double, 3>& cap) {
  if (impl_->scene) impl_->scene->push(cap);
}

void Window::show_message(const std::string& message) {
  (impl_->scene ? impl_->scene->message : impl_->message) = ui::retold(message);
}

std::optional<SceneWish> Window::take_wish() {
  return impl_->scene ? std::exchange(impl_->scene->wish, {}) : std::nullopt;
}

std::vector<messages::Command> Window::take_commands() {
  return impl_->scene ? impl_->scene->controls_of_scene().take_commands() : std::vector<messages::Command>{};
}

std::optional<bool> Window::take_forces_on() {
  return impl_->scene ? impl_->scene->controls_of_scene().take_forces_on() : std::nullopt;
}

bool Window::should_close() const {
  return glfwWindowShouldClose(impl_->window.get()) == GLFW_TRUE;
}

void Window::save_next_picture(const std::filesystem::path& path) {
  impl_->screenshot = path;
}

std::string Window::describe(const messages::SceneFrame& frame) {
  return impl_->scene ? impl_->scene->description(frame) : "";
}

const ViewControls& Window::draw(const messages::SceneFrame& frame) {
  static const ViewControls kNothing;
  impl_->draw(frame);
  return impl_->scene ? impl_->scene->controls() : kNothing;
}

}  // namespace myotact::view
