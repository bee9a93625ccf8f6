#include "view/window.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "messages/device.h"
#include "view/description.h"
#include "view/glfw_window.h"
#include "view/history.h"
#include "view/imgui_session.h"
#include "view/key_bindings.h"
#include "view/layout.h"
#include "view/offscreen.h"
#include "view/panels/demonstrate_panel.h"
#include "view/panels/feel_panel.h"
#include "view/panels/find_panel.h"
#include "view/panels/learn_panel.h"
#include "view/panels/plots_panel.h"
#include "view/panels/status_bar.h"
#include "view/panels/toolbar.h"
#include "view/pointer.h"
#include "view/scene_overlay.h"
#include "view/scene_renderer.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

const char* view_of(KeyAction action) {
  switch (action) {
    case KeyAction::Lateral:
      return "lateral";
    case KeyAction::Medial:
      return "medial";
    case KeyAction::Cranial:
      return "cranial";
    case KeyAction::Caudal:
      return "caudal";
    case KeyAction::Dorsal:
      return "dorsal";
    case KeyAction::Palmar:
      return "palmar";
    default:
      return nullptr;
  }
}

/// An ImGui window over one area; draws nothing into an empty one.
template <typename Draw>
void in_area(const char* id, const Area& area, const Draw& draw) {
  if (area.empty()) return;
  ImGui::SetNextWindowPos(ImVec2(area.x, area.y));
  ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBringToFrontOnFocus);
  draw();
  ImGui::End();
}

void draw_help(bool& open) {
  ImGui::Begin(fmt::format("{}###help", ui::tr("help.title")).c_str(), &open, ImGuiWindowFlags_AlwaysAutoResize);
  for (const KeyBinding& binding : key_bindings()) {
    ImGui::Text("%-10s %s", std::string(binding.name).c_str(), std::string(binding.what).c_str());
  }
  ImGui::Separator();
  ui::text("help.mouse");
  ImGui::End();
}

}  // namespace

struct Window::Impl {
  Impl(const anatomy::Specimen& given, const WindowSettings& settings)
      : specimen(&given),
        facts(settings.facts),
        window(settings.facts.title.c_str(), settings.width, settings.height),
        imgui(window.get()),
        renderer(given),
        state{start_view(given, 1.0f), settings.start},
        history(state) {
    controls.hand_world_m = settings.hand_start_world_m;
    controls.scene = settings.start;
  }

  void look(const char* name) {
    const float aspect = layout.scene.empty() ? 1.0f : layout.scene.width / layout.scene.height;
    Camera& camera = state.view.camera;
    camera = standard_view(name, specimen->side != "right", bounds_of(*specimen), aspect).value_or(camera);
  }

  void restore(const WorkState& earlier) {
    state = earlier;
    controls.scene = earlier.scene;
  }

  void act(KeyAction action) {
    switch (action) {
      case KeyAction::Help:
        help = !help;
        return;
      case KeyAction::PauseOrPlay:
        controls.paused = !controls.paused;
        return;
      case KeyAction::Step:
        ++controls.steps;
        return;
      case KeyAction::Reset:
        ++controls.resets;
        return;
      case KeyAction::FrameAll:
        look("lateral");
        return;
      case KeyAction::StopForces:
        ++controls.stops;
        return;
      case KeyAction::EnableForces:
        ++controls.arms;
        return;
      case KeyAction::Screenshot:
        screenshot = "myotact.png";
        return;
      case KeyAction::GrabLine:
      case KeyAction::GrabBone:
        return;  // held: read in hold_buttons()
      default:
        look(view_of(action));
        return;
    }
  }

  void handle_keys() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool taken = io.WantTextInput || io.NavVisible;  // typed, or meant for the control with the focus
    for (const KeyBinding& binding : key_bindings()) {
      if (taken && binding.action != KeyAction::StopForces) continue;  // a stop goes before anything else
      if (ImGui::IsKeyPressed(binding.key, false)) act(binding.action);
    }
  }

  bool is_down(KeyAction action) const {
    return std::any_of(key_bindings().begin(), key_bindings().end(), [&](const KeyBinding& binding) {
      return binding.action == action && glfwGetKey(window.get(), binding.key) == GLFW_PRESS;
    });
  }

  void hold_buttons() {
    controls.hand_buttons = 0;
    if (is_down(KeyAction::GrabLine)) controls.hand_buttons |= messages::kGrabButton;
    if (is_down(KeyAction::GrabBone)) controls.hand_buttons |= messages::kGrabBoneButton;
  }

  void draw_tasks(PanelContext& context) {
    if (!ImGui::BeginTabBar("tasks")) return;
    const auto tab = [](const char* key, const auto& draw) {
      const bool open = ImGui::BeginTabItem(fmt::format("{}###{}", ui::tr(key), key).c_str());
      ui::note_control(key, open ? "on" : "off");
      if (!open) return;
      draw();
      ImGui::EndTabItem();
    };
    tab("tasks.feel", [&] { feel.draw(context); });
    tab("tasks.demonstrate", [&] { demonstrate.draw(context); });
    tab("tasks.learn",
        [&] { learn.draw(context, layout.scene.empty() ? 1.0f : layout.scene.width / layout.scene.height); });
    tab("tasks.plots", [&] { plots.draw(); });
    ImGui::EndTabBar();
  }

  void obey(const ToolbarAsks& asks) {
    if (asks.standard_view != nullptr) look(asks.standard_view);
    if (asks.help) help = !help;
    if (asks.undo) restore(history.undo());
    if (asks.redo) restore(history.redo());
  }

  void draw_panels(PanelContext& context) {
    plots.add(context);
    learn.observe(context);
    ToolbarAsks asks;
    in_area("toolbar", layout.toolbar, [&] { asks = draw_toolbar(context, history.can_undo(), history.can_redo()); });
    in_area("find", layout.find, [&] { find.draw(context); });
    in_area("tasks", layout.tasks, [&] { draw_tasks(context); });
    in_area("status", layout.status, [&] { draw_status_bar(context); });
    if (help) draw_help(help);
    handle_keys();
    hold_buttons();
    move_by_pointer(layout.scene, state.view, controls);
    obey(asks);
    state.scene = controls.scene;
    history.note(state, ImGui::IsAnyItemActive() || ImGui::IsAnyMouseDown());
  }

  /// The scene's area is given in the window's pixels from the top, the framebuffer's from below.
  void draw_scene(const messages::SceneFrame& frame, int width, int height) {
    glViewport(0, 0, width, height);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    const Area& area = layout.scene;
    if (area.empty()) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float scale = static_cast<float>(width) / std::max(display.x, 1.0f);
    const auto pixels = [&](float length) { return static_cast<int>(length * scale); };
    SceneExtras extras;
    extras.joint = facts.joint;
    renderer.draw(frame, state.view,
                  {pixels(area.x), height - pixels(area.y + area.height), pixels(area.width), pixels(area.height)},
                  extras);
  }

  /// Read before the buffers are swapped: afterwards their content is undefined.
  void save_picture(int width, int height) {
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    write_png(*screenshot, flipped(width, height, pixels));
    screenshot.reset();
  }

  void draw(const messages::SceneFrame& frame) {
    glfwPollEvents();
    imgui.begin();
    ui::begin_controls();
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const bool first = layout.scene.empty();
    layout = layout_of(display.x, display.y, ImGui::GetFontSize());
    if (first) {
      look("lateral");
      history = History(state);
    }
    PanelContext context{*specimen, frame, facts, readings, state.view, controls};
    draw_panels(context);
    overlay.draw(*specimen, frame, state.view, renderer.superficial(), layout.scene, {{}, SceneExtras{}.background},
                 *ImGui::GetBackgroundDrawList());
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window.get(), &width, &height);
    draw_scene(frame, width, height);
    imgui.end();
    if (screenshot) save_picture(width, height);
    glfwSwapBuffers(window.get());
  }

  const anatomy::Specimen* specimen;
  SceneFacts facts;
  GlfwWindow window;
  ImGuiSession imgui;
  SceneRenderer renderer;
  SceneOverlay overlay;
  Layout layout;
  WorkState state;
  History history;
  JointReadings readings;
  ViewControls controls;
  FindPanel find;
  FeelPanel feel;
  DemonstratePanel demonstrate;
  LearnPanel learn;
  PlotsPanel plots;
  bool help = false;
  std::optional<std::filesystem::path> screenshot;
};

Window::Window(const anatomy::Specimen& specimen, const WindowSettings& settings)
    : impl_(std::make_unique<Impl>(specimen, settings)) {}

Window::~Window() = default;

void Window::set_readings(const JointReadings& readings) {
  impl_->readings = readings;
}

bool Window::should_close() const {
  return glfwWindowShouldClose(impl_->window.get()) == GLFW_TRUE;
}

void Window::save_next_picture(const std::filesystem::path& path) {
  impl_->screenshot = path;
}

std::string Window::describe(const messages::SceneFrame& frame) {
  const PanelContext context{*impl_->specimen,  frame,          impl_->facts, impl_->readings,
                             impl_->state.view, impl_->controls};
  return view::describe(context, impl_->layout);
}

const ViewControls& Window::draw(const messages::SceneFrame& frame) {
  impl_->draw(frame);
  return impl_->controls;
}

}  // namespace myotact::view
