#pragma once

#include <cstdint>
#include <vector>

#include "core/vector.h"
#include "scene/script.h"
#include "simulation/simulation.h"

namespace myotact::scene {

/// Where the hand wants the stylus at one instant.
struct HandTarget {
  Vec3 position_world_m = Vec3::Zero();
  std::uint32_t buttons = 0;
};

/// Turns the hand actions of a script into a smooth path. Each action is laid out once, when it starts, on the tissue
/// as it is then; the hand moves with minimum jerk (Flash and Hogan 1985), and at constant speed while it slides.
class ScriptedHand {
 public:
  ScriptedHand(const anatomy::Specimen& specimen, const Vec3& start_world_m);

  /// Lays out a hand action; actions that do not move the hand are ignored. Not real-time safe.
  void begin(const ScriptAction& action, const simulation::Simulation& simulation);

  /// Any thread that also calls begin().
  HandTarget target(double time_s) const;

 private:
  struct Waypoint {
    double time_s;
    Vec3 position_world_m;
    std::uint32_t buttons;        // from this waypoint on
    bool arrives_moving = false;  // constant speed up to here
  };

  void lay_out(const ScriptAction& action, const MoveHand& what);
  void lay_out(const ScriptAction& action, const TouchMuscle& what, const simulation::Simulation& simulation);
  void lay_out(const ScriptAction& action, const SlideOnMuscle& what, const simulation::Simulation& simulation);
  void lay_out(const ScriptAction& action, const GrabLine& what, const simulation::Simulation& simulation);
  void lay_out(const ScriptAction& action, const GrabBone& what, const simulation::Simulation& simulation);
  void lay_out(const ScriptAction& action, const ReleaseHand& what);
  /// Comes to `grip` along `from_`, presses the buttons there, drags and stays.
  void grab(const ScriptAction& action, const Vec3& grip, const Vec3& drag_m, std::uint32_t button);
  /// The outermost point of the muscle's skin beyond its line, seen along `from`.
  Vec3 skin_point(const simulation::Simulation& simulation, int muscle, double at, const Vec3& from) const;
  /// The outermost point of the bone beyond its middle, seen along `from`.
  Vec3 bone_point(const simulation::Simulation& simulation, int bone, const Vec3& from) const;

  const anatomy::Specimen* specimen_;
  std::vector<Waypoint> path_;  // rising in time, never empty
  int touched_muscle_ = -1;
  double touched_at_ = 0.5;
  Vec3 from_ = Vec3::UnitY();
};

/// Point at a fraction of a polyline's length [m]. `points` holds at least one point.
Vec3 point_at_fraction(const std::vector<Vec3>& points, double fraction);

}  // namespace myotact::scene
