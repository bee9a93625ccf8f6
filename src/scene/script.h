#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "anatomy/specimen.h"
#include "core/json_reader.h"
#include "core/vector.h"
#include "messages/command.h"

namespace myotact::scene {

// What a script can ask for; assets/scenes/README.md lists the same with examples. Positions in the world frame W.
// Muscles and joints are controlled by the same commands as in a window.

using messages::Activate, messages::CoContract, messages::HoldPosture, messages::Shove, messages::TestShove;

struct MoveHand {  // to a point of the world
  Vec3 to_m = Vec3::Zero();
};
struct TouchMuscle {  // approach the skin from outside at a place along the muscle line and press
  int muscle = -1;
  double at = 0.5;            // along the line, 0 origin .. 1 insertion
  Vec3 from = Vec3::UnitY();  // direction out of the muscle from which the hand comes
  double depth_m = 4e-3;      // of the device below the resting skin
};
struct SlideOnMuscle {  // move along the muscle just touched, pressing
  double to = 0.5;
  double depth_m = 4e-3;
};
struct GrabLine {  // approach a muscle's line, take it, and drag it
  int muscle = -1;
  double at = 0.5;
  Vec3 from = Vec3::UnitX();
  Vec3 drag_m = Vec3::Zero();
};
struct GrabBone {  // approach a bone from outside, take it where the hand meets it, and drag it
  int bone = -1;
  Vec3 from = Vec3::UnitX();   // direction out of the bone's middle from which the hand comes
  Vec3 drag_m = Vec3::Zero();  // zero: hold still
};
struct ReleaseHand {};  // let go and lift off by 40 mm
struct TakePicture {
  std::string view = "lateral";
};

using Action = std::variant<MoveHand, TouchMuscle, SlideOnMuscle, GrabLine, GrabBone, ReleaseHand, Activate, CoContract,
                            HoldPosture, Shove, TestShove, TakePicture>;

/// True for what a hand does; the rest is done to the limb or the picture.
bool moves_hand(const Action& action);

struct ScriptAction {
  double start_s = 0.0;
  double duration_s = 0.0;  // 0: at once
  Action what;
  std::size_t tool = 0;  // whose hand, where it moves one

  double end_s() const { return start_s + duration_s; }
};

/// Reads a scene's `script` list. `hands`: left or right, of each tool. Throws Error BadData (unknown muscle, wrong
/// type, a hand without a tool, overlapping actions of one hand).
std::vector<ScriptAction> read_script(const JsonValue& list, const anatomy::Specimen& specimen,
                                      const std::vector<std::string>& hands);

/// Index of the named part; throws Error BadData naming the nearest one.
int require_muscle(const JsonValue& name, const anatomy::Specimen& specimen);
int require_bone(const JsonValue& name, const anatomy::Specimen& specimen);
int require_joint(const JsonValue& name, const anatomy::Specimen& specimen);

}  // namespace myotact::scene
