#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

namespace myotact::messages {

inline constexpr int kMaxLocalTriangles = 256;
inline constexpr int kMaxLocalVertices = 192;

/// The muscle line nearest to the tool, or the one in hand, as a taut string between two points.
struct LocalLine {
  std::int32_t muscle = -1;                        // -1: none near
  double fraction = 0.0;                           // place on the line nearest to (or in) the hand, 0 .. 1
  std::array<double, 3> grab_point_world_m{};      // that place
  std::array<double, 3> proximal_point_world_m{};  // the string's end towards the origin
  std::array<double, 3> distal_point_world_m{};    // the string's end towards the insertion
  double tension_N = 0.0;                          // at `length_m`
  double length_m = 0.0;                           // proximal -> (tool, if in hand) -> distal, when published
  double stiffness_N_m = 0.0;                      // dT/dl, >= 0
  double damping_Ns_m = 0.0;                       // dT/d(dl/dt), >= 0
};

/// The touched place as the step had it that made the positions of the model: round there the tissue gives way by
///
///   compliance (force - force_world_N)
///
/// within one step more. Where the tool rests on several surfaces both are of all together. Row-major.
struct LocalContact {
  std::int32_t surface = -1;              // touched in that step, or next to the tool then; -1: none
  std::array<double, 3> force_world_N{};  // of the tool's coupling spring on the tissue at the end of the step; 0: none
  std::array<double, 9>
      compliance_m_N{};  // of what the tool rests on, its joints and inertia included, spring left out
};

inline constexpr int kMaxReportedContacts = 4;

/// One contact of the tool's body as an engine's own collision detection found it.
struct ReportedContact {
  std::int32_t surface = -1;              // of the body that is touched, as in LocalModel::Triangle
  std::array<double, 3> point_world_m{};  // on that body's surface
  std::array<double, 3> normal_world{};   // unit, out of that body
  double penetration_m = 0.0;             // of the tool's surface below that body's, >= 0
};

/// What an engine's collision detection reported of the tool after a step: for the force methods that go by it.
struct ReportedContacts {
  std::array<double, 3> tool_world_m{};  // where the tool's middle was then
  std::int32_t count = 0;                // the deepest first
  std::array<ReportedContact, kMaxReportedContacts> contacts{};
};

/// The joint of the scene reduced to one degree of freedom.
struct LocalJoint {
  double angle_rad = 0.0;
  double velocity_rad_s = 0.0;
  double inertia_kg_m2 = 0.0;
  double damping_Nms_rad = 0.0;
  double stiffness_Nm_rad = 0.0;
  double torque_Nm = 0.0;
};

/// The point of a body nearest to the tool, or the one in hand, and how it moves by itself (all in the world frame):
///
///   acceleration + mobility (f - force) - stiffness (x - position) - damping (v - velocity)
///
/// is how it speeds up while a hand pulls with f, as long as neither x nor v is far from the values here. Rank 1 under
/// one hinge, zero for a body that no joint moves. Matrices row-major.
struct LocalGrip {
  std::int32_t body = -1;                    // -1: none near
  std::array<double, 3> point_rest_m{};      // the point where it is at the specimen's pose
  std::array<double, 3> position_world_m{};  // it and its rates at the end of the step
  std::array<double, 3> velocity_world_m_s{};
  std::array<double, 3> acceleration_world_m_s2{};
  std::array<double, 3> force_world_N{};  // of the hand's spring on it, already in the acceleration
  std::array<double, 9> mobility_1_kg{};
  std::array<double, 9> stiffness_1_s2{};
  std::array<double, 9> damping_1_s{};
};

/// A spring between the hand and a place that the simulation moves; the hand feels
///
///   force = stiffness (anchor - hand)
struct LocalTether {
  double stiffness_N_m = 0.0;              // > 0; 0: no tether
  std::array<double, 3> anchor_world_m{};  // it and its rate at published_at
  std::array<double, 3> anchor_velocity_world_m_s{};
};

/// What a place of a surface is made of, for how it feels.
enum class Tissue : std::int32_t { Muscle, Tendon, Fascia, Bone, Fat, Skin };

/// Of a triangle of a surface, as long as the surface lasts.
struct TriangleTissue {
  Tissue tissue = Tissue::Muscle;
  /// Direction of the fibres under the triangle, riding on its corners: [0] (x1 - x0) + [1] (x2 - x0), which is of unit
  /// length at rest; both zero: none.
  std::array<float, 2> fibre_edges{};
};

/// All that the haptic side knows of the simulation: a real-time contract of fixed size.
/// Surfaces are numbered over the whole scene: muscles first (their index in the specimen), then bones.
struct LocalModel {
  struct Triangle {
    std::int32_t surface = -1;
    std::int32_t triangle = -1;              // in that surface
    std::array<std::int32_t, 3> vertices{};  // into the vertex arrays below, counter-clockwise from outside
    TriangleTissue tissue;
  };

  std::uint64_t sequence = 0;
  std::uint64_t published_at_ns = 0;  // the step's end; haptics plays previous -> current over dt_ns from here
  std::uint64_t dt_ns = 0;
  std::uint64_t tool_sequence = 0;  // ToolState that the step consumed
  std::array<double, 3> coverage_centre_world_m{};
  double coverage_radius_m = 0.0;  // every triangle that comes within this of the centre is in the list
  std::int32_t vertex_count = 0;
  std::int32_t triangle_count = 0;
  std::array<std::array<double, 3>, kMaxLocalVertices> previous_world_m{};  // at published_at - dt
  std::array<std::array<double, 3>, kMaxLocalVertices> current_world_m{};   // at published_at
  /// Ascending by surface, then by triangle: what two models share is found in one walk along both.
  std::array<Triangle, kMaxLocalTriangles> triangles{};
  LocalContact contact{};
  ReportedContacts reported{};
  LocalLine line{};
  LocalGrip grip{};
  LocalJoint joint{};
  LocalTether tether{};
};

static_assert(std::is_trivially_copyable_v<LocalModel>);

}  // namespace myotact::messages
