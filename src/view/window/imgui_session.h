#pragma once

struct GLFWwindow;

namespace myotact::view {

/// Dear ImGui on a window: context, font, theme, back ends. Within the life of the window.
class ImGuiSession {
 public:
  explicit ImGuiSession(GLFWwindow* window);
  ~ImGuiSession();
  ImGuiSession(const ImGuiSession&) = delete;
  ImGuiSession& operator=(const ImGuiSession&) = delete;

  /// Of everything written and clicked on, beside what the display itself asks for. Before begin(); draws the letters
  /// anew where it changed.
  void set_scale(float scale);
  /// The font of the interface is installed.
  bool has_font() const { return has_font_; }
  /// Start of a picture's panels; their end draws them over what has been drawn.
  void begin();
  void end();

 private:
  GLFWwindow* window_;
  bool has_font_ = false;
  float drawn_scale_ = 0.0f;  // of the letters as they are
};

}  // namespace myotact::view
