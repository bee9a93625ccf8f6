#include "view/render/ground_shadow.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "view/look/posing.h"

namespace myotact::view {

namespace {

constexpr float kReach_m = 0.04f;           // above the ground; what is higher casts none
constexpr std::size_t kPointsOfBone = 200;  // enough for where it lies
constexpr float kDarkest = 0.60f;           // opacity under what touches the ground
constexpr float kSoftEdge = 3.2f;           // the shadow's radius over the spread of what casts it
constexpr float kLeastSpread_m = 0.006f;
constexpr int kRings = 5, kSectors = 32;

/// What is near the ground: weighted by how near.
struct Footprint {
  float weight = 0.0f, nearest = 0.0f;
  glm::vec2 sum{0.0f};
  float xx = 0.0f, xy = 0.0f, yy = 0.0f;

  void add(const glm::vec2& p, float nearness) {
    weight += nearness;
    nearest = std::max(nearest, nearness);
    sum += nearness * p;
    xx += nearness * p.x * p.x;
    xy += nearness * p.x * p.y;
    yy += nearness * p.y * p.y;
  }
};

Footprint footprint_of(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, float ground_m) {
  Footprint print;
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    const auto& positions_m = specimen.bones[b].surface.positions_m;
    const glm::mat4 pose = pose_of_bone(specimen, frame, b);
    const std::size_t step = 1 + positions_m.size() / kPointsOfBone;
    for (std::size_t i = 0; i < positions_m.size(); i += step) {
      const auto p = glm::vec3(pose * glm::vec4(to_glm(positions_m[i]), 1.0f));
      const float nearness = 1.0f - std::abs(p.z - ground_m) / kReach_m;
      if (nearness > 0.0f) print.add({p.x, p.y}, nearness);
    }
  }
  return print;
}

}  // namespace

void add_ground_shadow(DrawMesh& mesh, const anatomy::Specimen& specimen, const messages::SceneFrame& frame,
                       float ground_m) {
  const Footprint print = footprint_of(specimen, frame, ground_m);
  if (!(print.weight > 0.0f)) return;
  const glm::vec2 middle = print.sum / print.weight;
  // Half axes of the ellipse: the square root of the spread's matrix, by its angle and principal values.
  const float xx = print.xx / print.weight - middle.x * middle.x, yy = print.yy / print.weight - middle.y * middle.y;
  const float xy = print.xy / print.weight - middle.x * middle.y;
  const float angle_rad = 0.5f * std::atan2(2.0f * xy, xx - yy);
  const float mean = 0.5f * (xx + yy), half = std::sqrt(0.25f * (xx - yy) * (xx - yy) + xy * xy);
  const auto radius_m = [](float square) {
    return kSoftEdge * std::max(std::sqrt(std::max(square, 0.0f)), kLeastSpread_m);
  };
  const glm::vec2 u(std::cos(angle_rad), std::sin(angle_rad)), v(-u.y, u.x);
  const glm::vec2 a = radius_m(mean + half) * u, b = radius_m(mean - half) * v;
  const auto start = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int ring = 0; ring <= kRings; ++ring) {
    const float r = static_cast<float>(ring) / kRings, fall = (1.0f - r * r) * (1.0f - r * r);
    for (int s = 0; s < kSectors; ++s) {
      const float t = 2.0f * std::numbers::pi_v<float> * static_cast<float>(s) / kSectors;
      const glm::vec2 p = middle + r * (std::cos(t) * a + std::sin(t) * b);
      mesh.vertices.push_back({{p, ground_m}, {0, 0, 1}, {0.10f, 0.09f, 0.12f, kDarkest * print.nearest * fall}});
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t s = 0; s < kSectors; ++s) {
      const std::uint32_t i = start + ring * kSectors + s, j = start + ring * kSectors + (s + 1) % kSectors;
      mesh.indices.insert(mesh.indices.end(), {i, i + kSectors, j, j, i + kSectors, j + kSectors});
    }
  }
}

}  // namespace myotact::view
