#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "anatomy/specimen.h"
#include "messages/scene_frame.h"
#include "view/look/camera.h"
#include "view/look/show_options.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// A film once round the limb, which begins again where it ends.
struct Turntable {
  const anatomy::Specimen& specimen;
  const messages::SceneFrame& frame;
  ViewState look;    // its camera states where the way begins and how high it runs
  PictureSize size;  // both sides even
  double seconds = 0.0;
};

/// One camera a picture, evenly round the box and all equally far from its middle, so far that each has the whole box
/// in its picture. The last one stands a step before the first.
std::vector<Camera> cameras_round(const Camera& start, const ViewBox& box, float aspect, int pictures);

/// The size of a film. Throws Error Usage for one that video does not take: an odd side, or one beyond 4096 pixels.
void check_film_size(const PictureSize& size);

/// ffmpeg, which makes films. Throws Error Unavailable, with the remedy, where it is not installed.
std::filesystem::path ffmpeg_for_films();

/// `go_on(done, all)` is asked after each picture. False: it said no, and nothing stays. Throws as VideoFile,
/// ffmpeg_for_films() and OffscreenRenderer.
bool write_turntable(const Turntable& turntable, const std::filesystem::path& video,
                     const std::function<bool(int, int)>& go_on);

}  // namespace myotact::view
