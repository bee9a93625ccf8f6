#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "view/pictures/film.h"
#include "view/render/scene_renderer.h"

namespace myotact::view {

/// The film that a person takes of the scene. The drawing thread.
class Filming {
 public:
  bool on() const { return film_ != nullptr && !ending_; }
  /// Begins a film in the person's folder "films", or ends the one that is being taken.
  void begin_or_end(const std::string& scene_name);
  /// Takes the picture that is due, if any, from the framebuffer; a sentence when the film has ended: where it is, or
  /// what went wrong. Before the buffers are swapped.
  std::optional<std::string> take(const Viewport& box);

 private:
  std::string wanted_;  // name of the scene whose film is to begin with the next picture; empty: none
  std::unique_ptr<Film> film_;
  std::chrono::steady_clock::time_point since_;
  bool ending_ = false;
  bool resized_ = false;  // which ended it
};

}  // namespace myotact::view
