#include "view/overlay/seen_parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "view/look/limb_bounds.h"
#include "view/look/posing.h"
#include "view/look/visibility.h"
#include "view/render/depth_grid.h"

namespace myotact::view {

namespace {

constexpr int kCellsHigh = 200;
constexpr int kFewestCells = 6;  // less of a part is not worth a name

/// One picture of depths, part after part.
struct DepthPicture {
  DepthPicture(const ViewState& view, const ViewBox& limb, float aspect)
      : grid(std::clamp(static_cast<int>(aspect * kCellsHigh), 8, 8 * kCellsHigh), kCellsHigh),
        clip_from_world(view.camera.clip_from_world(aspect)),
        kept(kept_half_space(view.section, limb)) {}

  template <typename At>
  void add(const geometry::TriangleMesh& surface, int owner, const At& world_place) {
    seen.clear();
    for (std::size_t i = 0; i < surface.positions_m.size(); ++i) {
      const glm::vec3 p = world_place(i);
      const glm::vec4 clip = clip_from_world * glm::vec4(p, 1.0f);
      const bool there = clip.w > 0.0f && is_kept(kept, p);
      const float x = (0.5f + 0.5f * clip.x / clip.w) * static_cast<float>(grid.width());
      const float y = (0.5f - 0.5f * clip.y / clip.w) * static_cast<float>(grid.height());
      seen.push_back(there ? glm::vec3(x, y, clip.z / clip.w) : glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
    const auto at = [&](int i) { return seen[static_cast<std::size_t>(i)]; };
    for (const auto& [a, b, c] : surface.triangles) grid.add(at(a), at(b), at(c), owner);
  }

  DepthGrid grid;
  glm::mat4 clip_from_world;
  glm::vec4 kept;
  std::vector<glm::vec3> seen;
};

struct Sums {
  glm::vec2 place{0.0f};
  int cells = 0;
};

glm::vec2 middle_of_cell(int x, int y) {
  return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
}

/// The cell of its own that is nearest to the middle of all its cells: a bent part holds its middle not always.
std::vector<glm::vec2> nearest_own_cells(const DepthGrid& grid, const std::vector<Sums>& sums) {
  std::vector<glm::vec2> places(sums.size());
  std::vector<float> distances(sums.size(), std::numeric_limits<float>::infinity());
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (grid.owner(x, y) == DepthGrid::kNobody) continue;
      const auto owner = static_cast<std::size_t>(grid.owner(x, y));
      const glm::vec2 cell = middle_of_cell(x, y);
      const float distance = glm::distance(cell, sums[owner].place / static_cast<float>(sums[owner].cells));
      if (distance >= distances[owner]) continue;
      distances[owner] = distance;
      places[owner] = cell;
    }
  }
  return places;
}

/// Of what is drawn in the row of a place, as a share of the width.
float middle_of_row(const DepthGrid& grid, const glm::vec2& place) {
  const int y = static_cast<int>(place.y);
  int left = grid.width(), right = 0;
  for (int x = 0; x < grid.width(); ++x) {
    if (grid.owner(x, y) == DepthGrid::kNobody) continue;
    left = std::min(left, x);
    right = x + 1;
  }
  return 0.5f * static_cast<float>(left + right) / static_cast<float>(grid.width());
}

SeenLimb read_grid(const DepthGrid& grid, const std::vector<Part>& owners) {
  std::vector<Sums> sums(owners.size());
  int left = grid.width(), right = 0;
  for (int y = 0; y < grid.height(); ++y) {
    for (int x = 0; x < grid.width(); ++x) {
      if (grid.owner(x, y) == DepthGrid::kNobody) continue;
      Sums& sum = sums[static_cast<std::size_t>(grid.owner(x, y))];
      sum.place += middle_of_cell(x, y);
      ++sum.cells;
      left = std::min(left, x);
      right = std::max(right, x + 1);
    }
  }
  const std::vector<glm::vec2> places = nearest_own_cells(grid, sums);
  const glm::vec2 size(static_cast<float>(grid.width()), static_cast<float>(grid.height()));
  SeenLimb limb{{}, static_cast<float>(left) / size.x, static_cast<float>(right) / size.x};
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (sums[i].cells < kFewestCells) continue;
    limb.parts.push_back({owners[i], places[i] / size, middle_of_row(grid, places[i]),
                          static_cast<float>(sums[i].cells) / (size.x * size.y)});
  }
  return limb;
}

}  // namespace

SeenLimb seen_parts(const anatomy::Specimen& specimen, const messages::SceneFrame& frame, const ViewState& view,
                    const std::vector<bool>& superficial, float aspect) {
  DepthPicture picture(view, view.section.on ? bounds_of(specimen) : ViewBox{}, aspect);
  std::vector<Part> owners;
  for (std::size_t m = 0; m < specimen.muscles.size() && m < frame.skins_world_m.size(); ++m) {
    owners.push_back({PartKind::Muscle, static_cast<int>(m)});
    if (opacity_of(view, superficial, owners.back()) < kSolidOpacity) continue;
    picture.add(specimen.muscles[m].skin, static_cast<int>(owners.size()) - 1,
                [&](std::size_t i) { return to_glm(frame.skins_world_m[m][i]); });
  }
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    owners.push_back({PartKind::Bone, static_cast<int>(b)});
    if (opacity_of(view, superficial, owners.back()) < kSolidOpacity) continue;
    const glm::mat4 pose = pose_of_bone(specimen, frame, b);
    const auto& surface = specimen.bones[b].surface;
    picture.add(surface, static_cast<int>(owners.size()) - 1,
                [&](std::size_t i) { return glm::vec3(pose * glm::vec4(to_glm(surface.positions_m[i]), 1.0f)); });
  }
  return read_grid(picture.grid, owners);
}

}  // namespace myotact::view
