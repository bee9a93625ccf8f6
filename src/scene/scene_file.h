#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "core/overrides.h"
#include "core/vector.h"
#include "haptics/effects/texture_set.h"
#include "haptics/force_method.h"
#include "messages/scene_frame.h"
#include "scene/script.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// A level of co-contraction that shows something at this joint, ready to be chosen.
struct CoContractionPreset {
  std::string name;
  double common = 0.0, difference = 0.0;
};

/// Co-contraction of the muscles across a joint: `common` is the level of the weaker side, the other side balances it;
/// `difference` shifts the balance, positive towards flexion.
struct CoContraction {
  int joint = -1;
  std::vector<int> flexors, extensors;  // muscles that are driven
  double common = 0.0;                  // 0 .. 1
  double difference = 0.0;              // -1 .. 1
  bool hold_posture = false;            // trims the balance slowly until the joint is back at its starting angle
  std::vector<CoContractionPreset> presets;
};

inline constexpr std::size_t kMostTools = messages::kMostChosenTools;  // a person has two hands

struct ToolSettings {
  std::string device = "simulated";
  std::string hand = "right";
  haptics::ForceMethod method = haptics::ForceMethod::Proxy;
  messages::ToolShape shape = messages::ToolShape::Ball;
  double radius_m = 3e-3;
  double force_scale = 1.0;
  double force_limit = 0.5;                              // share of the device's peak force that is ever sent
  double static_friction = 0.3, dynamic_friction = 0.3;  // across the fibres
  double stribeck_m_s = 0.01;
  double along_over_across = 1.0;  // friction along the fibres over across them
  double viscous_Ns_m = 0.0;
  double stiffness_N_m = 800.0;
  double line_snap_N = 0.0;          // the most that a muscle line near the surface pulls a passing tool with
  haptics::TextureSettings texture;  // smooth where empty
};

struct JointSetting {
  double angle_rad = 0.0;
  bool locked = false;
};

/// A scene file (assets/scenes/README.md) with every name resolved against its specimen.
struct Scene {
  std::string name, title;
  std::string note;  // what a person should know about the scene's settings, shown with it
  std::filesystem::path specimen_folder;
  anatomy::Specimen specimen;
  simulation::SimulationSettings settings;
  std::vector<JointSetting> joints;  // one a joint of the specimen
  std::vector<double> activations;   // one a muscle
  std::optional<CoContraction> co_contraction;
  std::vector<ToolSettings> tools;   // 1 or 2; of two, one for each hand
  std::vector<ScriptAction> script;  // by time
  std::string source_text;           // the file as read, for recordings
};

/// Reads a built-in scene by name or a scene file by path. Throws Error NoInput (names the built-in ones) or BadData.
Scene load_scene(const std::string& name_or_path, const Overrides& overrides = {});

/// The same from text, for recordings; `file` is named in errors and relative specimen paths start at its folder.
Scene parse_scene(const std::string& text, const std::filesystem::path& file, const Overrides& overrides);

/// Left or right, of each tool.
std::vector<std::string> hands_of(const Scene& scene);

/// Of everything random: the vibration of textures, each tool its own.
void set_seed(Scene& scene, std::uint64_t seed);

/// Names of the scenes in assets/scenes.
std::vector<std::string> built_in_scenes();

}  // namespace myotact::scene
