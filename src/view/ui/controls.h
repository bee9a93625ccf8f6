#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

// The controls of the window. Each is named by the key of its text, which is also its identity: the language may change
// while it is held. "KEY.tip", where there is such a text, is shown when the pointer rests on it. All can be reached
// and moved by keyboard. Call between ImGui's NewFrame and Render.

namespace myotact::view::ui {

bool button(const char* key);
/// Its icon alone, of what everybody knows; its text, or its tip, is shown when the pointer rests on it. Where the font
/// has no icon, a button with its text.
bool icon_button(const char* key);
/// A small arrow; its text is shown when the pointer rests on it.
bool arrow_button(const char* key, bool to_right);
/// True for as long as it is pressed.
bool hold_button(const char* key);
/// Looks pressed while `on`.
bool toggle_button(const char* key, bool on);
bool checkbox(const char* key, bool& value);
bool menu_item(const char* key, bool ticked = false);
struct Range {
  float lowest = 0.0f, highest = 1.0f;
};
/// `format`: of the number, with its unit, e.g. "%.1f N".
bool slider(const char* key, double& value, const Range& range, const char* format = "%.2f");
/// One of several; `option_keys`: keys of their texts.
bool choice(const char* key, int& value, std::span<const char* const> option_keys);
/// A line of text to be typed; true at every change.
bool input_text(const char* key, std::string& value);

/// The line of text just drawn was ended with Enter, that of the number pad too.
bool is_entered();

/// A control is being dragged or pressed.
bool is_held();

void text(const char* key);
/// The text, or its beginning and three points, so that it is no wider [pixels].
std::string shortened(const std::string& text, float width);
/// Any text, broken at the panel's edge.
void paragraph(const std::string& text);
void heading(const char* key);
/// A thin bar of the panel's width, filled to `share` (0 .. 1), under its label: text on the bar itself would not
/// stand out from every colour. Its colour is ImGuiCol_PlotHistogram.
void bar(double share, const std::string& text);

/// A window of its own that first stands in the middle, `width_em` x `height_em` font heights large; end it with
/// ImGui::End(), whatever is returned. False: it is folded, and needs no content. `open`: becomes false when the person
/// closes it.
bool begin_dialog(const char* title_key, float width_em, float height_em, bool& open);

/// Enters the control just drawn into the list below, for controls that are made by hand.
void note_control(const char* key, const std::string& value = "");

/// Where a control was in the last picture, so that tour, tests and other programs find it.
struct ControlPlace {
  std::string key, value;
  float x = 0.0f, y = 0.0f, width = 0.0f, height = 0.0f;  // pixels of the window, from its top left corner
  bool focused = false;                                   // by the keyboard
};                                                        // of a slider: its track
const std::vector<ControlPlace>& controls_of_last_picture();
/// The one of this key, until the next picture; null: it was not shown.
const ControlPlace* find_control(std::string_view key);
/// As note_control(), for what is drawn where no control of ImGui is.
void note_place(const ControlPlace& place);
/// At the start of each picture.
void begin_controls();

}  // namespace myotact::view::ui
