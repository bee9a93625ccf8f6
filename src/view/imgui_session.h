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

  /// Start of a picture's panels; their end draws them over what has been drawn.
  void begin();
  void end();
};

}  // namespace myotact::view
