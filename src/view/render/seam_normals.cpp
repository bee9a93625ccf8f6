#include "view/render/seam_normals.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "view/look/posing.h"

namespace myotact::view {

namespace {

/// Vertices by the cube of twice the touching distance that they lie in: what touches lies in the same or the next one.
class Cubes {
 public:
  explicit Cubes(std::span<const glm::vec3> positions_m) : positions_m_(positions_m) {
    for (std::size_t i = 0; i < positions_m.size(); ++i)
      cubes_[key(cube_of(i))].push_back(static_cast<std::uint32_t>(i));
  }
  /// In ascending order, with the vertex itself.
  std::vector<std::uint32_t> touching(std::size_t i) const {
    std::vector<std::uint32_t> found;
    // The half of its cube that the vertex lies in says on which side the next cube may hold something.
    const glm::vec3 in_cubes = positions_m_[i] / kCube_m;
    const glm::ivec3 here = cube_of(i);
    glm::ivec3 side;
    for (int k = 0; k < 3; ++k) side[k] = in_cubes[k] - std::floor(in_cubes[k]) < 0.5f ? -1 : 1;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
      const auto cube = cubes_.find(key(here + step * side));
      if (cube == cubes_.end()) continue;
      for (const std::uint32_t other : cube->second) {
        if (glm::distance(positions_m_[other], positions_m_[i]) <= SeamNormals::kTouch_m) found.push_back(other);
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  static constexpr float kCube_m = 2.0f * SeamNormals::kTouch_m;
  static constexpr float kFarthest = 1e6f;  // cubes: 200 m, beyond which all lie together

  glm::ivec3 cube_of(std::size_t i) const {
    return glm::ivec3(glm::clamp(glm::floor(positions_m_[i] / kCube_m), -kFarthest, kFarthest));
  }
  /// 21 bits each.
  static std::uint64_t key(const glm::ivec3& cube) {
    const auto part = [](int value) { return static_cast<std::uint64_t>(value + (1 << 20)) & 0x1fffffu; };
    return part(cube.x) << 42 | part(cube.y) << 21 | part(cube.z);
  }

  std::span<const glm::vec3> positions_m_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cubes_;
};

bool shared(const std::vector<int>& a, const std::vector<int>& b, const std::vector<int>& c) {
  return std::any_of(a.begin(), a.end(), [&](int surface) {
    return std::find(b.begin(), b.end(), surface) != b.end() && std::find(c.begin(), c.end(), surface) != c.end();
  });
}

}  // namespace

SeamNormals::SeamNormals(std::span<const geometry::TriangleMesh* const> surfaces) {
  find_touching(surfaces);
}

void SeamNormals::find_touching(std::span<const geometry::TriangleMesh* const> surfaces) {
  std::vector<glm::vec3> positions_m;
  std::vector<int> surface_of;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const auto first = static_cast<std::uint32_t>(positions_m.size());
    for (const Vec3& p : surfaces[s]->positions_m) {
      positions_m.push_back(to_glm(p));
      surface_of.push_back(static_cast<int>(s));
    }
    for (const auto& [a, b, c] : surfaces[s]->triangles) {
      triangles_.push_back({first + static_cast<std::uint32_t>(a), first + static_cast<std::uint32_t>(b),
                            first + static_cast<std::uint32_t>(c)});
    }
  }
  const Cubes cubes(positions_m);
  std::vector<std::vector<std::uint32_t>> near(positions_m.size());
  std::vector<std::vector<int>> touched(positions_m.size());  // other surfaces
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    for (const std::uint32_t other : cubes.touching(i)) {
      if (surface_of[other] == surface_of[i]) continue;
      near[i].push_back(other);
      touched[i].push_back(surface_of[other]);
    }
  }
  std::vector<bool> outside(positions_m.size(), false);
  for (const auto& [a, b, c] : triangles_) {
    inner_.push_back(shared(touched[a], touched[b], touched[c]));
    if (inner_.back()) continue;
    outside[a] = outside[b] = outside[c] = true;
  }
  at_seam_.assign(positions_m.size(), false);
  first_member_.push_back(0);
  for (std::size_t i = 0; i < positions_m.size(); ++i) {
    if (at_seam_[i] || !outside[i]) continue;
    members_.push_back(static_cast<std::uint32_t>(i));
    for (const std::uint32_t other : near[i]) {
      if (outside[other] && !at_seam_[other]) members_.push_back(other);
    }
    if (members_.size() - first_member_.back() < 2) {
      members_.pop_back();
      continue;
    }
    for (std::size_t k = first_member_.back(); k < members_.size(); ++k) at_seam_[members_[k]] = true;
    first_member_.push_back(static_cast<std::uint32_t>(members_.size()));
  }
}

void SeamNormals::compute(std::span<const glm::vec3> positions_m, std::vector<glm::vec3>& normals) const {
  normals.assign(positions_m.size(), glm::vec3(0.0f));
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const auto& [a, b, c] = triangles_[t];
    const glm::vec3 area = glm::cross(positions_m[b] - positions_m[a], positions_m[c] - positions_m[a]);
    for (const std::uint32_t i : {a, b, c}) {
      if (!inner_[t] || !at_seam_[i]) normals[i] += area;
    }
  }
  join(positions_m, normals);
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
  }
}

void SeamNormals::join(std::span<const glm::vec3> positions_m, std::vector<glm::vec3>& normals) const {
  for (std::size_t g = 0; g + 1 < first_member_.size(); ++g) {
    const std::span<const std::uint32_t> group(&members_[first_member_[g]], first_member_[g + 1] - first_member_[g]);
    glm::vec3 sum(0.0f);
    bool together = true;
    for (const std::uint32_t i : group) {
      sum += normals[i];
      together = together && glm::distance(positions_m[i], positions_m[group.front()]) <= kTornApart_m;
    }
    if (!together || glm::length(sum) <= 0.0f) continue;
    for (const std::uint32_t i : group) normals[i] = sum;
  }
}

}  // namespace myotact::view
