#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "messages/control_state.h"
#include "messages/held_tool.h"

namespace myotact::messages {

/// Of what the force on the hand is made [N, world]. The parts add up to ToolFrame::force_world_N.
struct ForceParts {
  std::array<double, 3> contact{};   // across the surface
  std::array<double, 3> friction{};  // along it
  std::array<double, 3> texture{};
  std::array<double, 3> line{};     // of the muscle line in hand, or strummed
  std::array<double, 3> bone{};     // in hand
  std::array<double, 3> tether{};   // spring between the hand and a place of the scene
  std::array<double, 3> damping{};  // what keeps the loop passive
  std::array<double, 3> limits{};   // what ramp, fade, clamp and slew limit of the gate change
};

/// One tool as the view draws it.
struct ToolFrame {
  int hand = 0;  // index of the scene's tool; hands that nobody has are left out of lists
  std::array<double, 3> tool_world_m{};
  std::array<double, 3> proxy_world_m{};
  std::array<double, 3> force_world_N{};
  double radius_m = 0.0;
  ToolShape shape = ToolShape::Ball;
  bool left = false;  // hand
  bool in_contact = false;
  bool forces_stopped = false;           // by key, button or call; stays until forces are enabled again
  int grabbed_line = -1;                 // muscle, or -1
  int grabbed_body = -1;                 // body, or -1
  std::array<double, 3> grip_world_m{};  // its point in hand
  int touched_muscle = -1;               // or -1
  int touched_body = -1;                 // whose bone is touched, or -1
  ForceParts parts;
  double line_tension_N = 0.0;  // of the line in hand
  double force_scale = 1.0;     // felt over simulated force
  double motion_scale = 1.0;    // way of the tool over way of the hand
  double model_age_s = 0.0;     // of what the hand feels now
};

/// What stands beside a joint's stiffness that mass-spring muscles have a part in.
inline constexpr const char* kPreviewMark = "preview (mass-spring)";

/// What one muscle adds to a joint.
struct MuscleJointFrame {
  double torque_Nm = 0.0;
  double stiffness_Nm_rad = 0.0;      // of its tissue
  double line_muscle_Nm_rad = 0.0;    // r^2 k of its line
  double line_geometry_Nm_rad = 0.0;  // -(dr/dq) F of its line
  double moment_arm_m = 0.0;          // r of its line, the moment arm; positive flexes
};

/// Numbers of a joint for plots and panels.
struct JointFrame {
  double angle_rad = 0.0;
  double torque_Nm = 0.0;
  double stiffness_Nm_rad = 0.0;
  bool preview = false;                   // mass-spring muscles are in it
  double passive_Nm_rad = 0.0;            // of the stiffness: the joint's own
  double contact_Nm_rad = 0.0;            // and what contact adds, as of the last settle
  std::vector<MuscleJointFrame> muscles;  // as in the specimen
};

/// Of about the last second.
struct RateFrame {
  double simulation_hz = 0.0;
  double haptic_hz = 0.0;
  std::uint64_t missed_ticks = 0;  // since the start
  double time_factor = 1.0;        // simulated seconds a second
};

/// A drawable snapshot of the scene. Vectors are sized once and filled in place; order as in the specimen.
struct SceneFrame {
  std::uint64_t sequence = 0;
  double time_s = 0.0;
  double residual_share = 0.0;                     // out-of-balance force of the last step over the size of the forces
  std::vector<std::array<double, 12>> body_poses;  // X_WB, row-major 3x4, bodies
  std::vector<std::vector<std::array<float, 3>>> skins_world_m;       // muscles x skin vertices
  std::vector<double> activations;                                    // muscles, 0 .. 1
  std::vector<double> tensions_N;                                     // muscles
  std::vector<double> stretches;                                      // muscles, fibre length over optimal, mean
  std::vector<double> volume_ratios;                                  // muscles, volume now over rest
  std::vector<double> smallest_volume_ratios;                         // muscles, over the integration points
  std::vector<std::vector<std::array<double, 3>>> lines_world_m;      // muscles x line points
  std::vector<std::array<std::array<double, 3>, 2>> springs_world_m;  // drawn between two places, beside the muscles
  std::vector<JointFrame> joints;
  std::vector<ToolFrame> tools;
  RateFrame rates;
  ControlState control;
  std::string notice;  // what the person should know now, or nothing
};

}  // namespace myotact::messages
