#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/triangle_mesh.h"

namespace myotact::view {

/// Normals of several surfaces that touch, as if they were one: at a seam, where surfaces meet and come to the outside
/// together, all of them have the same normal, that of the outer triangles of all of them. So light runs over a limb
/// without a jump from part to part.
///
/// A vertex touches when one of another surface lies within kTouch_m at the places given at first; a triangle touches,
/// and is no part of the outside, when all its corners touch the same surface.
class SeamNormals {
 public:
  static constexpr float kTouch_m = 1.0e-4f;  // ten times what files round to, far below a triangle's size
  /// Of vertices that have been carried apart, each has its own normal again.
  static constexpr float kTornApart_m = 1.0e-3f;

  SeamNormals() = default;
  explicit SeamNormals(std::span<const geometry::TriangleMesh* const> surfaces);

  /// All surfaces' vertices one after the other, as they are now. Unit normals; (0,0,1) where no triangle has area.
  void compute(std::span<const glm::vec3> positions_m, std::vector<glm::vec3>& normals) const;
  /// Of all surfaces' vertices: whether it lies at a seam.
  const std::vector<bool>& at_seam() const { return at_seam_; }

 private:
  void find_touching(std::span<const geometry::TriangleMesh* const> surfaces);
  void join(std::span<const glm::vec3> positions_m, std::vector<glm::vec3>& normals) const;

  std::vector<std::array<std::uint32_t, 3>> triangles_;  // of all surfaces
  std::vector<bool> inner_;                              // a triangle touches
  std::vector<bool> at_seam_;
  std::vector<std::uint32_t> members_, first_member_;  // of groups of vertices at one place of a seam
};

}  // namespace myotact::view
