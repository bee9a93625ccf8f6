#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "messages/scene_frame.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"
#include "view/look/show_options.h"

namespace myotact::app {

/// What is to be drawn of a scene, as asked for on the command line.
struct PictureWish {
  std::string view = "lateral";   // camera_of()
  std::vector<std::string> show;  // apply_show_options()
  view::PictureSize size;
  bool poster = false;  // no name stands over the limb, and no legend where there is nothing that it explains
};

/// How the scene is looked at. Throws as check_picture().
view::ViewState look_of(const scene::Scene& scene, const messages::SceneFrame& frame, const PictureWish& wish);

/// Throws Error Usage when the wish cannot be met for this scene: before hours of simulation, not after.
void check_picture(const scene::Scene& scene, const PictureWish& wish);

/// Draws a frame of the scene, as the one below.
void write_picture(const scene::Scene& scene, const messages::SceneFrame& frame, const PictureWish& wish,
                   const std::filesystem::path& path);

/// Draws the scene as it is now: the limb as it stands fills the picture. Throws Error InputOutput when the file cannot
/// be written, Unavailable without any OpenGL.
void write_picture(const scene::Scene& scene, const simulation::Simulation& simulation,
                   const std::vector<messages::ToolFrame>& tools, const PictureWish& wish,
                   const std::filesystem::path& path);

/// Small pictures of the limb on one (view/pictures/contact_sheet.h): in the scene's own pose, and with each joint at
/// the lowest and the highest angle of its range while the others keep theirs; a row each, from cranial, caudal,
/// lateral and medial. Everything at rest, nothing active. Throws as write_picture(), and as
/// view::draw_contact_sheet().
void write_sheet(const scene::Scene& scene, const std::vector<std::string>& show, const std::filesystem::path& path);

/// The joint that is watched: co-contracted, else the first that rotates.
int watched_joint(const scene::Scene& scene);

}  // namespace myotact::app
