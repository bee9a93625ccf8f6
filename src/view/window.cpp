#include "view/window.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "core/data_folder.h"
#include "messages/device.h"
#include "view/description.h"
#include "view/glfw_window.h"
#include "view/history.h"
#include "view/imgui_session.h"
#include "view/key_bindings.h"
#include "view/layout.h"
#include "view/limb_bounds.h"
#include "view/offscreen.h"
#include "view/panels/demonstrate_panel.h"
#include "view/panels/feel_panel.h"
#include "view/panels/find_panel.h"
#include "view/panels/learn_panel.h"
#include "view/panels/part_menu.h"
#include "view/panels/plots_panel.h"
#include "view/panels/see_panel.h"
#include "view/panels/status_bar.h"
#include "view/panels/timeline_panel.h"
#include "view/panels/toolbar.h"
#include "view/part_actions.h"
#include "view/pointer.h"
#include "view/scene_overlay.h"
#include "view/scene_renderer.h"
#include "view/ui/controls.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

const char* view_of(KeyAction action) {
  constexpr std::array kViews = {std::pair{KeyAction::Lateral, "lateral"}, std::pair{KeyAction::Medial, "medial"},
                                 std::pair{KeyAction::Cranial, "cranial"}, std::pair{KeyAction::Caudal, "caudal"},
                                 std::pair{KeyAction::Dorsal, "dorsal"},   std::pair{KeyAction::Palmar, "palmar"}};
  const auto* found =
      std::find_if(kViews.begin(), kViews.end(), [&](const auto& view) { return view.first == action; });
  return found == kViews.end() ? nullptr : found->second;
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
  ImGui::SetNextWindowPos(ImVec2(0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y),
                          ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::Begin(fmt::format("{}###help", ui::tr("help.title")).c_str(), &open, ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2)) {
    for (const KeyBinding& binding : key_bindings()) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(name_of(binding).c_str());
      ImGui::TableNextColumn();
      ui::text(binding.what);
    }
    ImGui::EndTable();
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

  float scene_aspect() const { return layout.scene.empty() ? 1.0f : layout.scene.width / layout.scene.height; }

  /// Turns there within a quarter of a second.
  void look(const Camera& camera) { turn = {state.view.camera, camera, 0.0f}; }

  void look(const char* name, const messages::SceneFrame& frame) {
    const ViewBox box = bounds_of(*specimen, frame);
    if (const auto camera = standard_view(name, specimen->side != "right", box, scene_aspect())) look(*camera);
  }

  void look_at_selection(const messages::SceneFrame& frame) {
    const Part part = selected_part(state.view);
    const ViewBox box = part ? bounds_of(*specimen, frame, part) : bounds_of(*specimen, frame);
    look(framed(state.view.camera, box, scene_aspect()));
  }

  void go_on_turning() {
    if (turn.share >= 1.0f) return;
    constexpr float kTime_s = 0.25f;
    turn.share = std::min(1.0f, turn.share + ImGui::GetIO().DeltaTime / kTime_s);
    state.view.camera = between(turn.from, turn.to, turn.share);
  }

  void restore(const WorkState& earlier) {
    state = earlier;
    controls.scene = earlier.scene;
    turn.share = 1.0f;
  }

  void act(KeyAction action, PanelContext& context) {
    const Part part = selected_part(state.view);
    switch (action) {
      case KeyAction::Help:
        context.asks.help = true;
        return;
      case KeyAction::PauseOrPlay:
        controls.paused = !controls.paused;
        return;
      case KeyAction::StepBack:
        return timeline.step(-1);
      case KeyAction::Step:
        if (timeline.looks_back()) return timeline.step(1);
        controls.paused = true;
        ++controls.steps;
        return;
      case KeyAction::Reset:
        ++controls.resets;
        return;
      case KeyAction::Look:
        return pointer.set_mode(PointerMode::Look);
      case KeyAction::Touch:
        return pointer.set_mode(PointerMode::Touch);
      case KeyAction::Pull:
        return pointer.set_mode(PointerMode::Pull);
      case KeyAction::FrameSelection:
        context.asks.frame_selection = true;
        return;
      case KeyAction::FrameAll:
        context.asks.standard_view = "lateral";
        return;
      case KeyAction::Search:
        return find.focus();
      case KeyAction::Hide:
        if (part) look_of(state.view, part).hidden = true;
        return;
      case KeyAction::Isolate:
        if (part) isolate(state.view, part);
        return;
      case KeyAction::ShowAll:
        return show_all(state.view);
      case KeyAction::Labels:
        state.view.labels = !state.view.labels;
        return;
      case KeyAction::Undo:
        context.asks.undo = true;
        return;
      case KeyAction::Redo:
        context.asks.redo = true;
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
      case KeyAction::FullScreen:
        return window.toggle_full_screen();
      case KeyAction::GrabLine:
      case KeyAction::GrabBone:
        return;  // held: read in hold_buttons()
      default:
        context.asks.standard_view = view_of(action);
    }
  }

  /// Keys that are typed into a text, or that move the control with the keyboard's focus, mean that alone; a stop goes
  /// before anything else.
  void handle_keys(PanelContext& context) {
    const ImGuiIO& io = ImGui::GetIO();
    for (const GlfwWindow::KeyPress& press : window.take_presses()) {
      const auto& all = key_bindings();
      const auto binding = std::find_if(all.begin(), all.end(), [&](const KeyBinding& known) {
        return known.key == press.key && known.mods == press.mods;
      });
      if (binding == all.end()) continue;
      const bool plain = binding->mods == 0 && binding->key < GLFW_KEY_F1;
      const bool taken = io.WantTextInput || (plain && io.NavVisible);
      if (!taken || press.key == GLFW_KEY_ESCAPE) act(binding->action, context);
    }
  }

  void hold_buttons() {
    controls.hand_buttons = 0;
    if (ImGui::GetIO().WantTextInput) return;
    for (const KeyBinding& binding : key_bindings()) {
      if (!is_held(binding.action) || !window.is_down(binding.key)) continue;
      controls.hand_buttons |=
          binding.action == KeyAction::GrabLine ? messages::kGrabButton : messages::kGrabBoneButton;
    }
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
    tab("tasks.see", [&] { draw_see_panel(context); });
    tab("tasks.demonstrate", [&] { demonstrate.draw(context); });
    tab("tasks.learn", [&] { learn.draw(context); });
    tab("tasks.plots", [&] { plots.draw(context); });
    ImGui::EndTabBar();
  }

  void obey(const WindowAsks& asks, const messages::SceneFrame& frame) {
    if (asks.pointer_mode) pointer.set_mode(*asks.pointer_mode);
    if (asks.standard_view != nullptr) look(asks.standard_view, frame);
    if (asks.frame_selection) look_at_selection(frame);
    if (asks.help) help = !help;
    if (asks.undo) restore(history.undo());
    if (asks.redo) restore(history.redo());
  }

  /// `seen`: of the frame that is drawn, which is a past one while the person looks back.
  void draw_panels(PanelContext& context, PanelContext& seen) {
    plots.add(context);
    learn.observe(context);
    in_area("toolbar", layout.toolbar, [&] {
      draw_toolbar(context, pointer, {history.can_undo(), history.can_redo()});
    });
    in_area("find", layout.find, [&] { find.draw(context); });
    in_area("tasks", layout.tasks, [&] { draw_tasks(context); });
    in_area("timeline", layout.timeline, [&] { timeline.draw(context); });
    in_area("status", layout.status, [&] { draw_status_bar(context); });
    if (help) draw_help(help);
    hold_buttons();
    handle_keys(context);
    if (!timeline.looks_back() || pointer.mode() == PointerMode::Look) {  // the past cannot be touched
      pointer.update(seen, layout.scene, renderer.superficial());
    }
    menu.draw(context);
    hovered = pointer.hovered() ? pointer.hovered() : find.hovered();
    obey(context.asks, context.frame);
    go_on_turning();
    state.scene = controls.scene;
    history.note(state, ImGui::IsAnyItemActive() || ImGui::IsAnyMouseDown() || turn.share < 1.0f);
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
    extras.hovered = hovered;
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
      state.view.camera =
          standard_view("lateral", specimen->side != "right", bounds_of(*specimen, frame), scene_aspect()).value();
      history = History(state);
    }
    WindowAsks asks;
    const messages::SceneFrame& shown = timeline.choose(frame);
    PanelContext context{*specimen, frame, facts, readings, part_facts, hovered, state.view, controls, asks};
    PanelContext seen{*specimen, shown, facts, readings, part_facts, hovered, state.view, controls, asks};
    draw_panels(context, seen);
    overlay.draw({*specimen, shown, state.view, renderer.superficial(), {}, SceneExtras{}.background}, layout.scene,
                 *ImGui::GetBackgroundDrawList());
    timeline.draw_banner(layout.scene);
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(window.get(), &width, &height);
    draw_scene(shown, width, height);
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
  anatomy::FactsByKey part_facts = anatomy::load_part_facts(data_folder() / "assets" / "canine" / "names.json");
  Part hovered;
  Pointer pointer;
  struct Turn {
    Camera from, to;
    float share = 1.0f;  // of the way; 1: there
  };
  Turn turn;
  PartMenu menu;
  FindPanel find;
  FeelPanel feel;
  DemonstratePanel demonstrate;
  LearnPanel learn;
  TimelinePanel timeline;
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
  Impl& now = *impl_;
  WindowAsks none;
  const PanelContext context{*now.specimen, frame,          now.facts,    now.readings, now.part_facts,
                             now.hovered,   now.state.view, now.controls, none};
  return view::describe(context, now.layout);
}

const ViewControls& Window::draw(const messages::SceneFrame& frame) {
  impl_->draw(frame);
  return impl_->controls;
}

}  // namespace myotact::view
