#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

namespace myotact::messages {

/// One contact of the tool, named by a material point of a surface so that it rides on the tissue; by its place alone
/// where the hand knows the surface from an engine's reports only.
struct ToolContact {
  std::int32_t surface = -1;   // index as in LocalModel::Triangle::surface
  std::int32_t triangle = -1;  // triangle of that surface; -1: not known, ToolState::touched_world_m is the place
  std::array<double, 3> barycentric{};
  std::array<double, 3> normal_world{};  // unit, out of the tissue
  /// Where the coupling spring pulls the material point: the tool's surface point under the device, friction included.
  std::array<double, 3> target_world_m{};
  double stiffness_N_m = 0.0;  // of the coupling spring, isotropic; 0: no contact
};

/// Places besides the first that the tool's sphere may rest on at once.
inline constexpr int kMaxContactsBeside = 3;

/// What the haptic loop hands to the simulation, newest wins. The simulation adds the springs implicitly to its solve.
struct ToolState {
  std::uint64_t sequence = 0;  // 0: the tool is not in a hand
  std::uint64_t time_ns = 0;
  std::uint64_t model_sequence = 0;                // LocalModel in use when this was written
  std::array<double, 3> tool_position_world_m{};   // device
  std::array<double, 3> proxy_position_world_m{};  // never inside a surface
  std::array<double, 3> force_world_N{};           // force on the hand, after the gate
  ToolContact contact{};                           // that which carries most
  /// Of other surfaces as near, one each, and of another side of the touched one where that is creased; nearest first:
  /// they bear the coupling spring of `contact` with it, and each holds only while it presses. Their third barycentric
  /// coordinate is 1 - first - second, to the last bit. Stiffness 0: none.
  std::array<ToolContact, kMaxContactsBeside> beside{};
  std::uint32_t buttons = 0;
  std::uint32_t faults = 0;                     // haptics::Fault bits of the last window
  std::int32_t grabbed_line = -1;               // muscle whose line is in hand, or -1
  std::int32_t grabbed_body = -1;               // body of which a point is in hand, or -1
  double grab_fraction = 0.0;                   // place along the line, 0 origin .. 1 insertion, by rest arc length
  double line_stiffness_N_m = 0.0;              // of the grab spring between tool and line
  std::array<double, 3> body_point_rest_m{};    // the body's point in hand, where it is at the specimen's pose
  std::array<double, 3> body_target_world_m{};  // where the grab spring pulls that point
  double body_stiffness_N_m = 0.0;              // of the grab spring between hand and body
  std::array<double, 3> touched_world_m{};      // of the contact: where the touched point is believed to be now
};

static_assert(std::is_trivially_copyable_v<ToolState>);

}  // namespace myotact::messages
