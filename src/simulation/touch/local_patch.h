#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/triangle_mesh.h"
#include "geometry/triangle_tree.h"
#include "messages/local_model.h"
#include "simulation/line/line_model.h"

namespace myotact::simulation {

/// Finds the part of all surfaces that a tool can reach before the next step: each step the surfaces are updated with
/// their last two frames, then a patch is written for every tool.
///
///   skins, bones --update_surface (any thread, one a surface)--> trees --write (const)--> LocalModel's triangles
class LocalPatch {
 public:
  /// Looked no farther than this: 25 times the way of a hand at 1 m/s in a step of 10 ms.
  static constexpr double kSearchRadius_m = 0.25;

  /// Surfaces in the scene's numbering: muscle skins, then bones. Triangles and rest positions are copied into trees.
  explicit LocalPatch(std::span<const geometry::TriangleMesh* const> surfaces);

  /// What the triangles of a surface are made of, one each; without: muscle with no known fibres.
  void set_tissue(int surface, std::vector<messages::TriangleTissue> tissue);

  int surface_count() const { return static_cast<int>(surfaces_.size()); }  // skins and bones

  /// Takes the positions at the last two frames (world). Both arrays must stay in place and unchanged until the next
  /// update; different surfaces may be updated by different threads at once. Allocates nothing.
  void update_surface(int surface, std::span<const Vec3> previous_m, std::span<const Vec3> current_m) noexcept;

  /// Fills triangles, vertices, counts and coverage of `model` with the triangles nearest to `centre_m` (the proxy).
  /// The same triangles come in the same order on the same vertices, wherever the centre is.
  /// A triangle counts as near as it may come while its vertices move from the previous to the current frame.
  /// Deterministic; allocates nothing.
  void write(const Vec3& centre_m, messages::LocalModel& model) const noexcept;

  /// What nearest() finds.
  struct Place {
    int surface = -1;  // -1: none within the radius
    int triangle = -1;
    std::array<double, 3> barycentric{};
    Vec3 position_m = Vec3::Zero();  // W
  };
  /// The place of the surface numbered `first` or higher that comes nearest to `p` (world) now, within the radius.
  /// Deterministic; allocates nothing.
  Place nearest(const Vec3& p, int first, double radius_m) const noexcept;

 private:
  struct Surface {
    geometry::TriangleTree tree;
    std::vector<messages::TriangleTissue> tissue;  // one a triangle
    std::span<const Vec3> previous_m, current_m;   // empty until the first update: left out of patches
  };
  class NearestTriangles;

  void collect(const Vec3& centre_m, NearestTriangles& nearest) const noexcept;

  std::vector<Surface> surfaces_;
};

/// A muscle line as the patch sees it, in the world now.
struct LineView {
  int muscle = -1;                    // index in the specimen
  std::span<const Vec3> points_m;     // from origin to insertion, at least 2
  std::span<const double> fractions;  // of the points, arc length at rest
  double tension_N = 0.0;             // >= 0
  double stiffness_N_m = 0.0;         // dT/dl; may be negative
  double damping_Ns_m = 0.0;          // dT/d(dl/dt)
};

/// A hand at the lines.
struct LineHand {
  Vec3 tool_m = Vec3::Zero();  // W
  int grabbed_muscle = -1;     // -1: none in hand
  double grab_fraction = 0.0;  // place in hand, 0 origin .. 1 insertion
  int offered_muscle = -1;     // the nearest line so far, -1: none
};

/// A line farther than this from the tool is not offered.
inline constexpr double kLineReach_m = 0.030;
/// Another line must be nearer than the one offered so far by this much, or the offer would flicker between two lines
/// while a hand trembles by 0.2 mm halfway.
inline constexpr double kLineLead_m = 0.002;
/// The string's ends lie at least this far from the place in hand, where the line is long enough: a closer end would
/// make a small sideways pull a steep one.
inline constexpr double kShortestString_m = 0.020;

/// The line in hand, else the nearest within reach (the one offered so far a little longer), else muscle -1. Negative
/// stiffness or damping is sent as 0, which the contract of LocalLine asks for. Real-time safe.
messages::LocalLine local_line(std::span<const LineView> lines, const LineHand& hand) noexcept;

}  // namespace myotact::simulation
