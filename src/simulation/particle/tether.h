#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "core/pose.h"
#include "messages/local_model.h"
#include "messages/tool_state.h"
#include "simulation/particle/particle.h"

namespace myotact::simulation {

/// A particle between a cube at x1 and the hand at x2 (particle.h); several hands have a spring each. Mass, stiffness
/// and scale were not published. With the hand's spring as stiff as the cube's the particle swings at w = sqrt(100 N/m
/// / 0.2 kg) = 22 rad/s, 3.6 Hz: at h = 0.01 s an explicit step then gains 2.5 % of amplitude, a factor 11 a second, an
/// implicit one loses as much.
struct ParticleSettings {
  double mass_kg = 0.2;              // > 0
  double cube_stiffness_N_m = 50.0;  // k1
  bool circling = false;             // the cube, else it stands at the origin
  double unit_m = 0.02;              // of a unit of length: a circle of 80 mm, within a desktop device's reach
  Integration integration = Integration::Implicit;  // of the particle; Explicit gains energy
};

/// 3.3 N of a desktop device, of which a scene sends half by default, is 33 mm of this spring: with the particle
/// half-way to the cube, the hand goes 66 mm from it, as far as such a device reaches.
inline constexpr double kParticleTether_N_m = 50.0;  // k2
/// Here the spring alone goes as far: 1.65 N at 55 mm.
inline constexpr double kSpringTether_N_m = 30.0;

/// A spring between the hand and the particle, or, where there is none, the origin.
struct TetherSettings {
  double stiffness_N_m = kSpringTether_N_m;  // > 0
  std::optional<ParticleSettings> particle;  // none: the anchor stands at the origin
};

/// Centre of the cube in the world `time_s` after the start; the origin unless it circles. It circles as published: at
/// radius 2 in the plane z = 0, at the angle (t / 180) pi / 50 with t in milliseconds, once in 18 s.
Vec3 cube_centre_m(const ParticleSettings& particle, double time_s);

/// Where cube, particle and the spring's anchor are at the start: there a hand feels nothing. World.
Vec3 tether_start_m(const TetherSettings& settings);

/// The scenes of the original research system: nothing but one spring is felt. With a particle the bodies `cube` and
/// `particle` move with what they are named for. Single caller.
class Tether {
 public:
  /// Throws Error BadData when the specimen has muscles, joints or not the bodies. The specimen need not outlive
  /// this.
  Tether(const TetherSettings& settings, const anatomy::Specimen& specimen);

  /// The particle at rest in the cube's centre, the cube at its start.
  void restart();
  /// `tools`: their newest states; one that is not in a hand (sequence 0), or has no position, does not pull.
  void step(std::span<const messages::ToolState> tools, double dt_s);

  /// Stiffness, and the particle (or the origin) as the anchor; no tether once the particle is lost.
  messages::LocalTether local() const;
  Pose body_pose(int body) const;  // X_WL; the unit pose for all but the cube and a particle that is not lost
  /// Ends of each spring, as they are drawn: cube to particle, then particle to each hand.
  std::vector<std::array<std::array<double, 3>, 2>> springs_world_m() const;
  /// The particle is farther than it can be drawn, and felt no more until restart(): explicit integration does that.
  bool lost() const { return lost_; }
  std::array<double, 6> state() const;  // position and velocity, for hashes

 private:
  Vec3 cube_m() const;
  ParticleSprings springs() const;

  TetherSettings settings_;
  Vec3 cube_rest_m_ = Vec3::Zero(), particle_rest_m_ = Vec3::Zero();  // centres at the file pose
  int cube_body_ = -1, particle_body_ = -1;
  double time_s_ = 0.0;  // since restart()
  ParticleState state_;
  std::vector<Vec3> hands_m_;  // of the last step
  bool lost_ = false;
};

}  // namespace myotact::simulation
