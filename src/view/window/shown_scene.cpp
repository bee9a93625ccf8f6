#include "view/window/shown_scene.h"

#include <algorithm>
#include <utility>

#include <imgui.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/user_folder.h"
#include "view/input/area_focus.h"
#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"
#include "view/panels/class_panel.h"
#include "view/panels/device_part.h"
#include "view/panels/help.h"
#include "view/panels/see_panel.h"
#include "view/panels/status_bar.h"
#include "view/panels/toolbar.h"
#include "view/pictures/window_pictures.h"
#include "view/state/moment.h"
#include "view/ui/controls.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"
#include "view/ui/theme.h"
#include "view/window/description.h"

namespace myotact::view {

namespace {

/// An ImGui window over one area; draws nothing into an empty one. Its ground is what the window was cleared to, which
/// costs a software renderer a tenth of what blending does.
template <typename Draw>
void in_area(const char* id, const Area& area, const Draw& draw) {
  if (area.empty()) return;
  ImGui::SetNextWindowPos(ImVec2(area.x, area.y));
  ImGui::SetNextWindowSize(ImVec2(area.width, area.height));
  ImGui::Begin(id, nullptr,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoBackground);
  draw();
  ImGui::End();
}

}  // namespace

ShownScene::ShownScene(const anatomy::Specimen& specimen, const WindowSettings& settings)
    : specimen_(&specimen),
      facts_(settings.facts),
      part_facts_(anatomy::load_part_facts(data_folder() / "assets" / "canine" / "names.json")),
      renderer_(specimen),
      state_{start_view(specimen, 1.0f), scene_state_of(settings.start)},
      history_(state_),
      scene_(settings.start),
      feel_(specimen),
      work_(settings.work) {
  controls_.hand_world_m = settings.hand_start_world_m;
  marks_ = marks_or_none(marks_file(specimen.name), message);
}

void ShownScene::take_over(const ShownScene& before) {
  state_ = before.state_;
  history_ = before.history_;
  const ViewControls start = controls_;
  controls_ = before.controls_;
  controls_.hand_world_m = start.hand_world_m;
  scene_.restore(state_.scene);  // from where the scene begins
  demonstrate_.keep(before.demonstrate_.kept());
  pointer_ = before.pointer_;
  message = before.message;
  layout_ = before.layout_;
  big_type_ = before.big_type_;
  sides_ = before.sides_;
  first_steps_ = before.first_steps_;
  language_ = before.language_;
  tour_ = before.tour_;
  tour_on_ = before.tour_on_;
}

void ShownScene::begin_with(const StartChoice& choice) {
  if (choice.purpose == Purpose::Join) {
    wish = SceneWish{};
    wish->to_join = choice.to_join;
    return;
  }
  sides_.tasks = true;
  open_task_ = choice.purpose == Purpose::Teach    ? "tasks.demonstrate"
               : choice.purpose == Purpose::Lesson ? "tasks.learn"
                                                   : "tasks.feel";
  if (choice.purpose != Purpose::Touch) return;
  first_steps_ = {};
  settings.tour_done = false;
}

/// Turns there within a quarter of a second.
void ShownScene::look(const Camera& camera) {
  transition_ = {state_.view.camera, camera, 0.0f};
}

void ShownScene::look(const char* name, const messages::SceneFrame& frame) {
  const ViewBox box = bounds_of(*specimen_, frame);
  if (const auto camera = standard_view(name, specimen_->side != "right", box, scene_aspect())) look(*camera);
}

void ShownScene::look_at_selection(const messages::SceneFrame& frame) {
  const Part part = selected_part(state_.view);
  const ViewBox box = part ? bounds_of(*specimen_, frame, part) : bounds_of(*specimen_, frame);
  look(framed(state_.view.camera, box, scene_aspect()));
}

void ShownScene::go_on_turning() {
  if (transition_.share >= 1.0f) return;
  constexpr float kTime_s = 0.25f;
  transition_.share = std::min(1.0f, transition_.share + ImGui::GetIO().DeltaTime / kTime_s);
  state_.view.camera = between(transition_.from, transition_.to, transition_.share);
}

void ShownScene::push(const std::array<double, 3>& cap) {
  if (cap == std::array<double, 3>{}) return;
  transition_.share = 1.0f;
  push_view(state_.view.camera, cap, ImGui::GetIO().DeltaTime);
}

/// The posture comes before the settings, which go on from there.
void ShownScene::restore(const WorkState& earlier) {
  if (earlier.turns < state_.turns) scene_.push(messages::GoOn{turns_[earlier.turns].from});
  if (earlier.turns > state_.turns) scene_.push(messages::GoOn{turns_[earlier.turns - 1].to});
  for (const messages::Order& order : orders_between(state_.scene, earlier.scene)) scene_.push(order);
  state_ = earlier;
  restored_ = true;
  transition_.share = 1.0f;
}

/// Undo takes the posture back too, as it was when the person went away from it.
void ShownScene::go_on(const messages::Moment& to, const messages::SceneFrame& now) {
  const auto from = moment_of(now);
  if (!from) return;
  turns_.resize(state_.turns);  // what was undone is given up
  turns_.push_back({*from, to});
  state_.turns = turns_.size();
  scene_.push(messages::GoOn{to});
  message = ui::tr("keep.went_on");
}

/// `before`: what was set when the picture began. What the script or others changed is no step of the person's.
void ShownScene::note_changes(const SceneState& before) {
  const SceneState now = scene_state_of(scene_.state());
  const bool busy = ImGui::IsAnyItemActive() || ImGui::IsAnyMouseDown() || transition_.share < 1.0f;
  if (!std::exchange(restored_, false) && now != before) {
    if (!std::exchange(scene_changes_, true)) history_.begin_from(before);
    state_.scene = now;
  }
  history_.note(state_, busy);
  scene_changes_ = scene_changes_ && busy;
}

void ShownScene::draw_tasks(PanelContext& context) {
  constexpr float kTabPadding_em = 0.27f;  // so narrow that all tabs are read whole in any language
  const ImVec2 padding(kTabPadding_em * ImGui::GetFontSize(), ImGui::GetStyle().FramePadding.y);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
  const bool open_bar = ImGui::BeginTabBar("tasks");
  ImGui::PopStyleVar();
  if (!open_bar) return;
  const std::string wanted = std::exchange(open_task_, {});
  const auto tab = [&](const char* key, const auto& draw) {
    const ImGuiTabItemFlags flags = key == wanted ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, padding);
    const bool open = ImGui::BeginTabItem(fmt::format("{}###{}", ui::tr(key), key).c_str(), nullptr, flags);
    ImGui::PopStyleVar();
    ui::note_control(key, open ? "on" : "off");
    if (!open) return;
    ImGui::BeginChild(key);
    draw();
    ImGui::EndChild();
    ImGui::EndTabItem();
  };
  tab("tasks.feel", [&] { feel_.draw(context); });
  tab("tasks.see", [&] {
    draw_see_panel(context);
    bookmarks_.draw(context);
  });
  demonstrates_ = false;
  tab("tasks.demonstrate", [&] {
    demonstrates_ = true;
    demonstrate_.draw(context);
  });
  tab("tasks.learn", [&] { learn_.draw(context); });
  tab("tasks.plots", [&] { plots_.draw(context); });
  tab("tasks.settings", [&] { settings_panel_.draw(settings, message); });
  ImGui::EndTabBar();
}

void ShownScene::obey(const WindowAsks& asks, const messages::SceneFrame& frame) {
  if (asks.standard_view != nullptr) look(asks.standard_view, frame);
  if (asks.frame_selection) look_at_selection(frame);
  if (asks.help) help_ = !help_;
  if (asks.start) start_.open();
  if (asks.big_type) set_big_type(!big_type_);
  if (asks.co_contraction_step != 0.0) add_co_contraction(asks.co_contraction_step);
  if (asks.undo) restore(history_.undo());
  if (asks.redo) restore(history_.redo());
  if (asks.pointer_mode) pointer_.set_mode(*asks.pointer_mode);
  if (asks.record && !replays()) begin_or_end_recording();
  if (asks.recordings) recordings_.toggle();
  if (asks.film) filming_.begin_or_end(facts_.name);
  if (asks.wish) wish = asks.wish;
  if (asks.write_note) {
    sides_.find = true;
    find_.focus_note();
  }
  take_marks(asks);
  if (asks.turn_to) look(*asks.turn_to);
  if (asks.works) works_.toggle();
  if (asks.save_work) save(*asks.save_work);
  if (asks.open_work) open(*asks.open_work);
  if (!asks.message.empty()) message = asks.message;
}

void ShownScene::begin_or_end_recording() {
  if (scene_.state().recording) {
    scene_.push(messages::EndRecording{});
    message = ui::tr("keep.recording_ends");
    return;
  }
  try {
    const std::filesystem::path file = new_user_path("recordings", facts_.name, ".myorec");
    wish = SceneWish{facts_.file, facts_.tissue, file};
    message = ui::tr("keep.recording_begins", file.string());
  } catch (const Error& failure) {
    message = ui::retold(failure.what());
  }
}

void ShownScene::draw_areas(PanelContext& context) {
  in_area("toolbar", layout_.toolbar, [&] {
    draw_toolbar(context, {pointer_.mode(), pointer_.free_orbit, history_.can_undo(), history_.can_redo()});
  });
  in_area("find", layout_.find, [&] { find_.draw(context); });
  in_area("tasks", layout_.tasks, [&] { draw_tasks(context); });
  in_area("timeline", layout_.timeline, [&] { replays() ? replay_.draw(context) : timeline_.draw(context); });
  if (!replays()) timeline_.draw_go_on(context, layout_.scene);
  draw_fold_handles();
  recordings_.draw(context);
  if (big_type_) draw_class_panel(context, layout_.scene);
  in_area("status", layout_.status, [&] { draw_status_bar(context); });
  news_strip_.draw(context, news_room(context), message);
  if (help_ && draw_help(help_, keys_, settings.mouse)) {
    tour_on_ = true;
    sides_ = {};
    help_ = false;
    if (big_type_) set_big_type(false);
  }
  works_.draw(context);
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float below_toolbar = layout_.toolbar.height;  // what stops the forces stays in reach
  const Area whole{0.0f, below_toolbar, display.x, display.y - below_toolbar};
  if (const auto choice = start_.draw(whole, settings, message)) begin_with(*choice);
  if (!start_.is_open() && !start_.was_declined() && !help_) guide(context);
}

/// Between the handles that fold the panels, so that a sentence leaves the limb alone; below a banner.
Area ShownScene::news_room(const PanelContext& context) const {
  constexpr float kHandle_em = 1.8f, kBanner_em = 2.2f;
  const float em = ImGui::GetFontSize();
  const bool banner = timeline_.looks_back() || replays() || is_clutched(context);
  Area room = layout_.scene;
  if (room.empty()) return room;
  room.x += kHandle_em * em;
  room.width = std::max(room.width - 2.0f * kHandle_em * em, em);
  room.y += banner ? kBanner_em * em : 0.0f;
  return room;
}

void ShownScene::guide(PanelContext& context) {
  if (tour_on_) {
    if (!layout_.tasks.empty() && tour_.draw()) tour_on_ = false;
    return;
  }
  const bool can_press = !replays() && !facts_.is_served && !big_type_ && !context.specimen.muscles.empty();
  if (settings.tour_done || layout_.scene.empty() || !can_press) return;
  if (!first_steps_.draw(context, layout_.scene, renderer_.superficial())) return;
  first_steps_ = {};  // to begin anew when they are asked for
  settings.tour_done = true;
  keep(settings, message);
}

PanelContext ShownScene::context_of(const messages::SceneFrame& frame, WindowAsks& asks) {
  return {*specimen_, frame,         facts_,      readings,  news,   part_facts_, marks_,
          hovered_,   filming_.on(), state_.view, controls_, scene_, asks};
}

void ShownScene::draw_panels(const messages::SceneFrame& now, GlfwWindow& window) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const bool first = layout_.scene.empty();
  layout_ = layout_of(display.x, display.y, ImGui::GetFontSize(), big_type_ ? SidePanels{false, false} : sides_);
  keys_ = bindings_with(settings.keys);
  if (big_type_) ui::apply_theme(ui::Theme::Contrast);  // settings that changed have set theirs
  if (std::exchange(language_, ui::language()) != ui::language()) {
    // Anatomy speaks Latin where it does not speak English; there are no other names.
    state_.view.names = ui::language() == "en" ? NameStyle::English : NameStyle::Latin;
  }
  if (first) {
    state_.view.camera = framed(state_.view.camera, bounds_of(*specimen_, now), scene_aspect());
    history_ = History(state_);
  }
  scene_.hear(now, ImGui::GetTime());
  const SceneState before = scene_state_of(scene_.state());
  if (work_) begin_with(*std::exchange(work_, std::nullopt));
  const messages::SceneFrame& shown = replays() ? replay_.choose(now, facts_.replay_s, scene_) : timeline_.choose(now);
  shown_ = &shown;
  WindowAsks asks;
  PanelContext present = context_of(replays() ? shown : now, asks);
  PanelContext seen = context_of(shown, asks);  // a past frame while the person looks back
  plots_.add(present);
  demonstrate_.observe(present);
  feel_.add(present.frame);
  learn_.observe(present);
  pointer_.free_orbit = settings.free_orbit;
  pointer_.preset = settings.mouse;
  if (area_step_ != 0) focus_next_area(layout_, std::exchange(area_step_, 0));
  hold_buttons(window);
  draw_areas(present);
  if (asks.free_orbit) {
    settings.free_orbit = *asks.free_orbit;
    keep(settings, message);
  }
  handle_keys(asks, window);
  if (!(timeline_.looks_back() || replays()) || pointer_.mode() == PointerMode::Look) {  // the past cannot be touched
    pointer_.update(seen, layout_.scene, renderer_.superficial());
  } else {
    pointer_.rest(present);
  }
  menu_.draw(present);
  hovered_ = pointer_.hovered() ? pointer_.hovered() : find_.hovered();
  obey(asks, shown);
  if (asks.go_on) go_on(*asks.go_on, now);
  go_on_turning();
  note_changes(before);
  if (replays()) lead_replay();
  controls_.view_axes_world = axes_of(state_.view.camera);
  ViewState named = state_.view;
  named.labels = named.labels || big_type_;
  const bool tools_lag = std::count(facts_.shows_force_only.begin(), facts_.shows_force_only.end(), true) > 0 &&
                         (controls_.hand_moves || !news.devices.empty());
  const int opposed = demonstrates_ || big_type_ ? facts_.joint : -1;
  overlay_.draw({*specimen_, shown, named, renderer_.superficial(), {}, SceneExtras{}.background, opposed, tools_lag},
                layout_.scene, *ImGui::GetBackgroundDrawList());
  timeline_.draw_past_banner(layout_.scene);
  if (replays()) draw_banner(layout_.scene, ui::tr("keep.replaying"));
  if (is_clutched(present) && !timeline_.looks_back()) draw_banner(layout_.scene, ui::tr("devices.clutched"));
}

/// Only the window knows which moment of a recording it shows.
void ShownScene::lead_replay() {
  for (const messages::Command& command : scene_.asked()) replay_.obey(command.order);
  controls_.replay_to_s = replay_.place_s();
}

/// The scene's area is given in the window's pixels from the top, the framebuffer's from below.
Viewport ShownScene::viewport(int width, int height) const {
  const Area& area = layout_.scene;
  const float scale = static_cast<float>(width) / std::max(ImGui::GetIO().DisplaySize.x, 1.0f);
  const auto pixels = [&](float length) { return static_cast<int>(length * scale); };
  return {pixels(area.x), height - pixels(area.y + area.height), pixels(area.width), pixels(area.height)};
}

void ShownScene::draw_limb(int width, int height) {
  if (layout_.scene.empty() || shown_ == nullptr) return;
  SceneExtras extras;
  extras.joint = facts_.joint;
  extras.hovered = hovered_;
  extras.pressures_Pa = feel_.map().peaks_Pa();
  extras.shows_force_only = facts_.shows_force_only;
  renderer_.draw(*shown_, state_.view, viewport(width, height), extras);
}

void ShownScene::take_picture(int width, int height) {
  if (const auto saved = filming_.take(viewport(width, height))) message = *saved;
  if (!picture_wish_ || width <= 0 || height <= 0) return;  // of a minimised window: when it is seen again
  const bool alone = *picture_wish_ == KeyAction::SceneScreenshot && !layout_.scene.empty();
  message = save_picture_for_person(facts_.name, alone ? viewport(width, height) : Viewport{0, 0, width, height});
  picture_wish_.reset();
}

std::string ShownScene::description(const messages::SceneFrame& now) {
  WindowAsks none;
  return describe(context_of((timeline_.looks_back() || replays()) && shown_ != nullptr ? *shown_ : now, none), layout_,
                  {timeline_.looks_back(), transition_.share < 1.0f, now.time_s});
}

}  // namespace myotact::view
