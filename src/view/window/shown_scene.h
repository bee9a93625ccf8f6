#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anatomy/part_facts.h"
#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/input/key_bindings.h"
#include "view/overlay/scene_overlay.h"
#include "view/panels/bookmark_list.h"
#include "view/panels/demonstrate_panel.h"
#include "view/panels/feel_panel.h"
#include "view/panels/find_panel.h"
#include "view/panels/learn_panel.h"
#include "view/panels/news_strip.h"
#include "view/panels/part_menu.h"
#include "view/panels/plots_panel.h"
#include "view/panels/recordings_panel.h"
#include "view/panels/replay_panel.h"
#include "view/panels/settings_panel.h"
#include "view/panels/start_page.h"
#include "view/panels/timeline_panel.h"
#include "view/panels/tour.h"
#include "view/panels/works_panel.h"
#include "view/pictures/filming.h"
#include "view/render/scene_renderer.h"
#include "view/session/settings.h"
#include "view/state/history.h"
#include "view/ui/layout.h"
#include "view/window/first_steps.h"
#include "view/window/glfw_window.h"
#include "view/window/pointer.h"
#include "view/window/window.h"

namespace myotact::view {

/// The scene that a window shows, with its panels and all that a person did to it. Another scene is another one.
class ShownScene {
 public:
  ShownScene(const anatomy::Specimen& specimen, const WindowSettings& settings);
  /// Keeps a note that is still being typed.
  ~ShownScene() { keep_marks(); }
  ShownScene(const ShownScene&) = delete;
  ShownScene& operator=(const ShownScene&) = delete;

  /// Writes what is unsaved of the person's marks; without a window any more, a failure goes to the standard error too.
  void keep_marks();
  /// The page of what the program is for, as far as somebody is in it; or what was chosen there.
  void begin_with(const StartPage& page) { start_ = page; }
  void begin_with(const StartChoice& choice);
  /// A newcomer who was led in another scene is led on from where he was.
  void lead_on(const ShownScene& before) {
    first_steps_ = before.first_steps_;
    first_steps_.enter_another_scene();
  }
  /// The same scene from its start: what was set and shown stays.
  void take_over(const ShownScene& before);

  /// Panels, keys and mouse. Between ImGui's NewFrame and Render.
  void draw_panels(const messages::SceneFrame& now, GlfwWindow& window);
  /// The limb, into a framebuffer of that size.
  void draw_limb(int width, int height);

  /// Of everything written and clicked on.
  double scale() const;
  const SceneFacts& facts() const { return facts_; }
  const ViewControls& controls() const { return controls_; }
  SceneControls& controls_of_scene() { return scene_; }
  /// The largest force that the last picture shows, as a share of what its device gives at most.
  double share_of_force() const;
  std::string description(const messages::SceneFrame& now);

  JointReadings readings;
  Settings settings;
  SessionNews news;
  std::string message;            // to be read by the person; empty: none
  std::optional<SceneWish> wish;  // of the person
  /// By a device, for the time since the last picture.
  void push(const std::array<double, 3>& cap);
  /// Saves the picture that the person asked for, and those of a film, from the framebuffer [pixels]; message states
  /// where.
  void take_picture(int width, int height);

 private:
  bool replays() const { return facts_.replay_s > 0.0; }
  PanelContext context_of(const messages::SceneFrame& frame, WindowAsks& asks);
  float scene_aspect() const { return layout_.scene.empty() ? 1.0f : layout_.scene.width / layout_.scene.height; }
  void look(const Camera& camera);
  void look(const char* name, const messages::SceneFrame& frame);
  void look_at_selection(const messages::SceneFrame& frame);
  void go_on_turning();
  void restore(const WorkState& earlier);
  void note_changes(const SceneState& before);
  bool act_on_part(KeyAction action);
  bool act_on_play(KeyAction action);
  void act(KeyAction action, WindowAsks& asks, GlfwWindow& window);
  void handle_keys(WindowAsks& asks, GlfwWindow& window);
  bool act_on_comfort(KeyAction action, WindowAsks& asks);
  void add_co_contraction(double step);
  void set_big_type(bool on);
  void hold_buttons(const GlfwWindow& window);
  void draw_areas(PanelContext& context);
  void draw_fold_handles();
  Area news_room(const PanelContext& context) const;
  void guide(PanelContext& context);
  void begin_or_end_recording();
  void draw_tasks(PanelContext& context);
  void lead_replay();
  Viewport viewport(int width, int height) const;
  void take_marks(const WindowAsks& asks);
  void report_missing(const std::vector<std::string>& parts);
  void save(const std::string& name);
  void open(const std::filesystem::path& file);
  void begin_with(const SavedWork& work);
  void obey(const WindowAsks& asks, const messages::SceneFrame& frame);
  void go_on(const messages::Moment& to, const messages::SceneFrame& now);

  /// From the present to an earlier moment, from which it went on.
  struct Turn {
    messages::Moment from, to;
  };
  /// On the way from one view to another.
  struct Transition {
    Camera from, to;
    float share = 1.0f;  // 1: there
  };

  const anatomy::Specimen* specimen_;
  SceneFacts facts_;
  anatomy::FactsByKey part_facts_;
  SceneRenderer renderer_;
  SceneOverlay overlay_;
  Layout layout_;
  WorkState state_;
  History history_;
  std::vector<Turn> turns_;                      // those that can be undone or done again
  const messages::SceneFrame* shown_ = nullptr;  // now, or an earlier one
  ViewControls controls_;
  SceneControls scene_;
  bool scene_changes_ = false;  // by the person, and not noted yet: a slider is held
  bool restored_ = false;       // by undo or redo, in this picture
  Part hovered_;
  Transition transition_;
  Pointer pointer_;
  PartMenu menu_;
  FindPanel find_;
  FeelPanel feel_;
  DemonstratePanel demonstrate_;
  LearnPanel learn_;
  PlotsPanel plots_;
  TimelinePanel timeline_;
  ReplayPanel replay_;  // in its place where a recording is played
  RecordingsPanel recordings_;
  std::optional<KeyAction> picture_wish_;  // Screenshot or SceneScreenshot
  Filming filming_;
  NewsStrip news_strip_;
  SettingsPanel settings_panel_;
  FirstSteps first_steps_;
  StartPage start_;
  Tour tour_;
  bool tour_on_ = false;
  std::vector<KeyBinding> keys_;  // as the person chose them
  std::string open_task_;         // tab to be opened; empty: none
  int area_step_ = 0;             // to the area that the keyboard goes to; 0: it stays
  SidePanels sides_;
  bool big_type_ = false;        // for a class in front of a projector
  std::string language_ = "en";  // that names are in as the view was set up
  bool help_ = false;
  bool demonstrates_ = false;  // that panel is open, or was when the panels were folded
  WorksPanel works_;
  BookmarkList bookmarks_;
  Marks marks_;
  bool marks_unsaved_ = false;
  std::optional<SavedWork> work_;  // to begin with at the next picture
};

}  // namespace myotact::view
