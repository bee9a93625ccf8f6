#include "view/render/sky_exposure.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <numbers>

#include "core/at.h"
#include "view/look/posing.h"
#include "view/render/depth_grid.h"
#include "view/render/seam_normals.h"

namespace myotact::view {

namespace {

// Enough that steps in the shade are not seen: 64 sides of 20 degrees each. Cells of a millimetre: grooves between
// muscles are a few wide.
constexpr int kDirections = 64, kFewestCells = 96, kMostCells = 640;
constexpr float kCell_m = 1.0e-3f;
/// About half of a limb's thickness: what is deeper inside stays dark, the next segment of the limb casts no shade.
constexpr float kReach_m = 0.06f;
/// Directions are shared out in so many parts, whatever the number of processors: sums have the same bits.
constexpr int kShares = 4;
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
  std::vector<glm::vec3> positions_m;
  const ShadedSurface* shaded = nullptr;
};

/// Sums of cosines over directions, one a vertex: of the light that comes past what is near, past everything, and of
/// all that would come.
struct Light {
  std::vector<float> seen, outside, whole;
};

Receiver receiver_of(const ShadedSurface& shaded) {
  Receiver receiver{{}, &shaded};
  for (const Vec3& p : shaded.surface->positions_m) receiver.positions_m.push_back(to_glm(p));
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
    for (const auto& [a, b, c] : receivers[r].shaded->surface->triangles) {
      grid.add(seen[at(a)], seen[at(b)], seen[at(c)], static_cast<int>(r));
    }
  }
}

/// 0 .. 1 of the light that passes what lies `above_m` towards it.
float passes(float above_m, float reach_m) {
  if (above_m < 0.0f) return 1.0f;
  const float share = std::clamp(2.0f * above_m / reach_m - 1.0f, 0.0f, 1.0f);
  return share * share * (3.0f - 2.0f * share);
}

void gather_light(const SideView& side, const DepthGrid& grid, const Receiver& receiver, float reach_m, Light& light) {
  for (std::size_t i = 0; i < receiver.positions_m.size(); ++i) {
    const glm::vec3& normal = receiver.shaded->normals[i];
    const float cosine = glm::dot(normal, side.towards);
    if (cosine <= 0.0f) continue;
    light.whole[i] += cosine;
    // Looked at from a cell and a half above the surface, or it would shade itself.
    const glm::vec3 place = side.see(receiver.positions_m[i] + 1.5f * side.cell_m * normal);
    const int x = std::clamp(static_cast<int>(place.x), 0, grid.width() - 1);
    const int y = std::clamp(static_cast<int>(place.y), 0, grid.height() - 1);
    const float above_m = place.z - grid.depth(x, y);
    light.seen[i] += cosine * passes(above_m, reach_m);
    if (above_m <= 0.0f) light.outside[i] += cosine;
  }
}

/// The light of every kShares-th direction from `first` on.
std::vector<Light> light_of_share(const std::vector<Receiver>& receivers, const glm::vec3& centre_m, float radius_m,
                                  const SkySampling& sampling, std::size_t first) {
  std::vector<Light> lights;
  for (const Receiver& receiver : receivers) {
    const std::vector<float> dark(receiver.positions_m.size(), 0.0f);
    lights.push_back({dark, dark, dark});
  }
  DepthGrid grid(sampling.cells, sampling.cells);
  const std::vector<glm::vec3> directions = spread_directions(sampling.directions);
  for (std::size_t d = first; d < directions.size(); d += kShares) {
    const SideView side(directions[d], centre_m, radius_m, sampling.cells);
    draw_depths(receivers, side, grid);
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      gather_light(side, grid, receivers[r], sampling.reach_m, lights[r]);
    }
  }
  return lights;
}

struct Ball {
  glm::vec3 centre_m{0.0f};
  float radius_m = 1e-6f;
};
Ball ball_round(const std::vector<Receiver>& receivers) {
  glm::vec3 lowest_m(1e9f), highest_m(-1e9f);
  for (const Receiver& receiver : receivers) {
    for (const glm::vec3& p : receiver.positions_m) {
      lowest_m = glm::min(lowest_m, p);
      highest_m = glm::max(highest_m, p);
    }
  }
  return {0.5f * (lowest_m + highest_m), std::max(0.5f * glm::length(highest_m - lowest_m), 1e-6f)};
}

SkySampling sampling_of(std::span<const ShadedSurface> surfaces) {
  std::vector<Receiver> receivers;
  for (const ShadedSurface& shaded : surfaces) receivers.push_back(receiver_of(shaded));
  const float cells = 2.0f * ball_round(receivers).radius_m / kCell_m;
  return {kDirections, std::clamp(static_cast<int>(std::min(cells, 1e6f)), kFewestCells, kMostCells), kReach_m};
}

std::vector<float> shares_of(const std::vector<float>& parts, const std::vector<float>& wholes) {
  std::vector<float> shares;
  for (std::size_t i = 0; i < parts.size(); ++i) shares.push_back(wholes[i] > 0.0f ? parts[i] / wholes[i] : 1.0f);
  return shares;
}

bool is_superficial(const std::vector<float>& exposure) {
  const auto seeing = std::count_if(exposure.begin(), exposure.end(), [](float x) { return x > kSeesOutside; });
  return static_cast<float>(seeing) >= kSuperficialShare * static_cast<float>(exposure.size());
}

}  // namespace

SkyExposure sky_exposure(std::span<const ShadedSurface> surfaces, const SkySampling& sampling) {
  std::vector<Receiver> receivers;
  for (const ShadedSurface& shaded : surfaces) receivers.push_back(receiver_of(shaded));
  const Ball ball = ball_round(receivers);
  std::vector<std::future<std::vector<Light>>> shares;
  for (std::size_t s = 0; s < kShares; ++s) {
    shares.push_back(std::async(std::launch::async, [&receivers, &ball, &sampling, s] {
      return light_of_share(receivers, ball.centre_m, ball.radius_m, sampling, s);
    }));
  }
  std::vector<Light> sums = shares.front().get();
  for (std::size_t s = 1; s < kShares; ++s) {
    const std::vector<Light> lights = shares[s].get();
    for (std::size_t r = 0; r < sums.size(); ++r) {
      for (std::size_t i = 0; i < sums[r].seen.size(); ++i) {
        sums[r].seen[i] += lights[r].seen[i];
        sums[r].outside[i] += lights[r].outside[i];
        sums[r].whole[i] += lights[r].whole[i];
      }
    }
  }
  SkyExposure exposure;
  for (const Light& light : sums) {
    exposure.seen.push_back(shares_of(light.seen, light.whole));
    exposure.outside.push_back(shares_of(light.outside, light.whole));
  }
  return exposure;
}

std::vector<ShadedSurface> shaded_surfaces(const anatomy::Specimen& specimen) {
  std::vector<const geometry::TriangleMesh*> skins;
  std::vector<glm::vec3> positions_m, normals;
  for (const auto& muscle : specimen.muscles) {
    skins.push_back(&muscle.skin);
    for (const Vec3& p : muscle.skin.positions_m) positions_m.push_back(to_glm(p));
  }
  SeamNormals(skins).compute(positions_m, normals);
  std::vector<ShadedSurface> shaded;
  auto from = normals.begin();
  for (const auto* skin : skins) {
    const auto to = from + static_cast<std::ptrdiff_t>(skin->positions_m.size());
    shaded.push_back({skin, {from, to}});
    from = to;
  }
  for (const auto& bone : specimen.bones) {
    shaded.push_back({&bone.surface, {}});
    for (const Vec3& n : geometry::vertex_normals(bone.surface)) shaded.back().normals.push_back(to_glm(n));
  }
  return shaded;
}

LimbShade shade_limb(const anatomy::Specimen& specimen) {
  const std::vector<ShadedSurface> all = shaded_surfaces(specimen);
  const std::size_t muscle_count = specimen.muscles.size();
  const std::span<const ShadedSurface> bones = std::span(all).subspan(muscle_count);
  auto together = sky_exposure(all, sampling_of(all));
  auto among_bones = sky_exposure(bones, sampling_of(bones));
  LimbShade shade;
  for (std::size_t m = 0; m < muscle_count; ++m) {
    shade.superficial.push_back(is_superficial(together.outside[m]));
    const std::span<const ShadedSurface> one = std::span(all).subspan(m, 1);
    shade.muscles.push_back(
        {std::move(sky_exposure(one, {kDirections, kFewestCells, kReach_m}).seen[0]), std::move(together.seen[m])});
  }
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    shade.bones.push_back({std::move(among_bones.seen[b]), std::move(together.seen[muscle_count + b])});
  }
  return shade;
}

}  // namespace myotact::view
