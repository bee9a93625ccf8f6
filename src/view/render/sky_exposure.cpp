#include "view/render/sky_exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "view/look/posing.h"
#include "view/render/depth_grid.h"

namespace myotact::view {

namespace {

// Enough that steps in the shade are not seen: 64 sides of 20 degrees each; cells of about 2 mm on a whole limb.
constexpr int kDirections = 64, kLimbCells = 288, kPartCells = 96;
/// A vertex sees the outside when half of the light reaches it; a muscle is superficial when this share of its skin
/// does. In the limbs at hand shares crowd below 0.21 and above 0.24.
constexpr float kSeesOutside = 0.5f, kSuperficialShare = 0.225f;

/// Evenly spread over the sphere (Fibonacci lattice).
std::vector<glm::vec3> spread_directions(int count) {
  std::vector<glm::vec3> directions;
  const double golden_rad = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count, r = std::sqrt(1.0 - z * z), t = golden_rad * i;
    directions.emplace_back(r * std::cos(t), r * std::sin(t), z);
  }
  return directions;
}

/// A surface with what the loop over directions reads.
struct Receiver {
  std::vector<glm::vec3> positions_m, normals;
  const std::vector<std::array<int, 3>>* triangles = nullptr;
  std::vector<float> seen, whole;  // sums of cosines
};

Receiver receiver_of(const geometry::TriangleMesh& surface) {
  Receiver receiver;
  for (const Vec3& p : surface.positions_m) receiver.positions_m.push_back(to_glm(p));
  for (const Vec3& n : geometry::vertex_normals(surface)) receiver.normals.push_back(to_glm(n));
  receiver.triangles = &surface.triangles;
  receiver.seen.resize(surface.positions_m.size());
  receiver.whole.resize(surface.positions_m.size());
  return receiver;
}

/// The world as it is seen from one side: x and y in cells, z towards what is seen.
struct SideView {
  SideView(const glm::vec3& to_light, const glm::vec3& centre, float radius, int count)
      : towards(to_light), centre_m(centre), cells(static_cast<float>(count)), cell_m(2.0f * radius / cells) {
    u = glm::normalize(glm::cross(to_light, std::abs(to_light.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
    v = glm::cross(to_light, u);
  }
  glm::vec3 see(const glm::vec3& p_m) const {
    const glm::vec3 out = p_m - centre_m;
    return {glm::dot(out, u) / cell_m + 0.5f * cells, glm::dot(out, v) / cell_m + 0.5f * cells,
            -glm::dot(out, towards)};
  }

  glm::vec3 towards, centre_m, u{0.0f}, v{0.0f};
  float cells, cell_m;
};

void draw_depths(const std::vector<Receiver>& receivers, const SideView& side, DepthGrid& grid) {
  grid.clear();
  std::vector<glm::vec3> seen;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    seen.clear();
    for (const glm::vec3& p : receivers[r].positions_m) seen.push_back(side.see(p));
    for (const auto& [a, b, c] : *receivers[r].triangles) {
      grid.add(seen[static_cast<std::size_t>(a)], seen[static_cast<std::size_t>(b)], seen[static_cast<std::size_t>(c)],
               static_cast<int>(r));
    }
  }
}

void gather_light(const SideView& side, const DepthGrid& grid, Receiver& receiver) {
  for (std::size_t i = 0; i < receiver.positions_m.size(); ++i) {
    const float cosine = glm::dot(receiver.normals[i], side.towards);
    if (cosine <= 0.0f) continue;
    receiver.whole[i] += cosine;
    // Looked at from a cell and a half above the surface, or it would shade itself.
    const glm::vec3 at = side.see(receiver.positions_m[i] + 1.5f * side.cell_m * receiver.normals[i]);
    const int x = std::clamp(static_cast<int>(at.x), 0, grid.width() - 1);
    const int y = std::clamp(static_cast<int>(at.y), 0, grid.height() - 1);
    if (at.z <= grid.depth(x, y)) receiver.seen[i] += cosine;
  }
}

bool is_superficial(const std::vector<float>& exposure) {
  const auto seeing = std::count_if(exposure.begin(), exposure.end(), [](float x) { return x > kSeesOutside; });
  return static_cast<float>(seeing) >= kSuperficialShare * static_cast<float>(exposure.size());
}

}  // namespace

std::vector<std::vector<float>> sky_exposure(std::span<const geometry::TriangleMesh* const> surfaces, int directions,
                                             int cells) {
  std::vector<Receiver> receivers;
  glm::vec3 lowest_m(1e9f), highest_m(-1e9f);
  for (const geometry::TriangleMesh* surface : surfaces) {
    receivers.push_back(receiver_of(*surface));
    for (const glm::vec3& p : receivers.back().positions_m) {
      lowest_m = glm::min(lowest_m, p);
      highest_m = glm::max(highest_m, p);
    }
  }
  const float radius_m = std::max(0.5f * glm::length(highest_m - lowest_m), 1e-6f);
  DepthGrid grid(cells, cells);
  for (const glm::vec3& direction : spread_directions(directions)) {
    const SideView side(direction, 0.5f * (lowest_m + highest_m), radius_m, cells);
    draw_depths(receivers, side, grid);
    for (Receiver& receiver : receivers) gather_light(side, grid, receiver);
  }
  std::vector<std::vector<float>> exposure;
  for (const Receiver& receiver : receivers) {
    exposure.emplace_back();
    for (std::size_t i = 0; i < receiver.seen.size(); ++i) {
      exposure.back().push_back(receiver.whole[i] > 0.0f ? receiver.seen[i] / receiver.whole[i] : 1.0f);
    }
  }
  return exposure;
}

LimbShade shade_limb(const anatomy::Specimen& specimen) {
  std::vector<const geometry::TriangleMesh*> all, bones;
  for (const auto& muscle : specimen.muscles) all.push_back(&muscle.skin);
  for (const auto& bone : specimen.bones) {
    all.push_back(&bone.surface);
    bones.push_back(&bone.surface);
  }
  auto together = sky_exposure(all, kDirections, kLimbCells);
  auto among_bones = sky_exposure(bones, kDirections, kLimbCells);
  LimbShade shade;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    shade.superficial.push_back(is_superficial(together[m]));
    const std::vector<const geometry::TriangleMesh*> one{all[m]};
    shade.muscles.push_back({std::move(sky_exposure(one, kDirections, kPartCells)[0]), std::move(together[m])});
  }
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    shade.bones.push_back({std::move(among_bones[b]), std::move(together[specimen.muscles.size() + b])});
  }
  return shade;
}

}  // namespace myotact::view
