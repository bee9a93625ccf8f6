#pragma once

struct ImDrawList;
struct ImGuiContext;

namespace myotact::view {

/// Dear ImGui without a window, on the current OpenGL context: what it draws goes into the bound framebuffer. A context
/// of its own: one that is current otherwise is so again after each call.
class HeadlessImGui {
 public:
  /// `font_px`: height of the font.
  HeadlessImGui(int width, int height, float font_px);
  ~HeadlessImGui();
  HeadlessImGui(const HeadlessImGui&) = delete;
  HeadlessImGui& operator=(const HeadlessImGui&) = delete;

  /// `paint(list)`: draws into an ImGui draw list over the whole picture.
  template <typename Paint>
  void draw(const Paint& paint) {
    begin();
    paint(*list());
    end();
  }

 private:
  void begin();
  static ImDrawList* list();
  void end();

  ImGuiContext* context_ = nullptr;
  ImGuiContext* other_ = nullptr;  // current before begin()
};

}  // namespace myotact::view
