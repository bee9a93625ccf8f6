// Surfaces of random triangles, so many that a patch is full of them or of their vertices: it holds the nearest ones,
// as many as there is room for, and says how far that goes. Against a look at every triangle.

#include <algorithm>
#include <array>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/closest_point.h"
#include "simulation/touch/local_patch.h"

namespace myotact::simulation {
namespace {

struct Soup {
  std::vector<geometry::TriangleMesh> meshes;
  std::unique_ptr<LocalPatch> patch;
};

/// `surfaces` times `triangles` of 5 to 20 mm in a cube of 60 mm. Each takes its corners from `pool` vertices of its
/// surface: few, and the triangles fill a patch; three times as many as triangles, and the vertices do.
Soup random_soup(int surfaces, int triangles, int pool, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-0.03, 0.03), near(-0.01, 0.01);
  Soup soup;
  for (int s = 0; s < surfaces; ++s) {
    geometry::TriangleMesh& mesh = soup.meshes.emplace_back();
    Vec3 middle = Vec3::Zero();
    for (int v = 0; v < pool; ++v) {
      if (v % 3 == 0) middle = Vec3::NullaryExpr([&] { return place(random); });
      mesh.positions_m.push_back(middle + Vec3::NullaryExpr([&] { return near(random); }));
    }
    for (int t = 0; t < triangles; ++t) {
      const int first = 3 * (t % (pool / 3));
      const int other = 3 * static_cast<int>(random() % static_cast<unsigned>(pool / 3));
      mesh.triangles.push_back({first, first + 1, pool < 3 * triangles ? other + 2 : first + 2});
    }
  }
  std::vector<const geometry::TriangleMesh*> pointers;
  for (const geometry::TriangleMesh& mesh : soup.meshes) pointers.push_back(&mesh);
  soup.patch = std::make_unique<LocalPatch>(pointers);
  for (int s = 0; s < surfaces; ++s) {
    const std::vector<Vec3>& here_m = soup.meshes[static_cast<std::size_t>(s)].positions_m;
    soup.patch->update_surface(s, here_m, here_m);
  }
  return soup;
}

/// Distance, surface, triangle of all triangles within the search radius, the nearest first.
std::vector<std::tuple<double, int, int>> by_distance(const Soup& soup, const Vec3& centre_m) {
  std::vector<std::tuple<double, int, int>> all;
  for (std::size_t s = 0; s < soup.meshes.size(); ++s) {
    for (std::size_t t = 0; t < soup.meshes[s].triangles.size(); ++t) {
      std::array<Vec3, 3> x;
      for (std::size_t c = 0; c < 3; ++c) {
        x[c] = soup.meshes[s].positions_m[static_cast<std::size_t>(soup.meshes[s].triangles[t][c])];
      }
      const Vec3 nearest_m = geometry::closest_point_on_triangle(centre_m, x[0], x[1], x[2]).position_m;
      const double distance_m = (nearest_m - centre_m).norm();
      if (distance_m <= LocalPatch::kSearchRadius_m) {
        all.emplace_back(distance_m, static_cast<int>(s), static_cast<int>(t));
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// How many of the nearest fit: 256 triangles, 192 vertices of (surface, number).
std::size_t room_for(const Soup& soup, const std::vector<std::tuple<double, int, int>>& nearest_first) {
  std::set<std::pair<int, int>> vertices;
  std::size_t count = 0;
  for (const auto& [distance_m, s, t] : nearest_first) {
    for (const int v : soup.meshes[static_cast<std::size_t>(s)].triangles[static_cast<std::size_t>(t)]) {
      vertices.emplace(s, v);
    }
    if (count == 256 || vertices.size() > 192) break;
    ++count;
  }
  return count;
}

void expect_nearest(const Soup& soup, const Vec3& centre_m, const messages::LocalModel& model) {
  auto all = by_distance(soup, centre_m);
  const std::size_t count = room_for(soup, all);
  ASSERT_EQ(model.triangle_count, static_cast<int>(count));
  ASSERT_LE(model.vertex_count, messages::kMaxLocalVertices);
  const double covered_m = count < all.size() ? std::get<0>(all[count]) : LocalPatch::kSearchRadius_m;
  EXPECT_NEAR(model.coverage_radius_m, covered_m, 1e-12);
  std::vector<std::pair<int, int>> expected;
  for (std::size_t k = 0; k < count; ++k) expected.emplace_back(std::get<1>(all[k]), std::get<2>(all[k]));
  std::sort(expected.begin(), expected.end());
  for (std::size_t k = 0; k < count; ++k) {
    const messages::LocalModel::Triangle& triangle = model.triangles[k];
    ASSERT_EQ(std::pair(triangle.surface, triangle.triangle), expected[k]);
    const geometry::TriangleMesh& mesh = soup.meshes[static_cast<std::size_t>(triangle.surface)];
    for (std::size_t c = 0; c < 3; ++c) {
      ASSERT_LT(triangle.vertices[c], model.vertex_count);
      const int vertex = mesh.triangles[static_cast<std::size_t>(triangle.triangle)][c];
      ASSERT_EQ(to_vec3(model.current_world_m[static_cast<std::size_t>(triangle.vertices[c])]),
                mesh.positions_m[static_cast<std::size_t>(vertex)]);
    }
  }
}

/// Centres in the middle of the soup, at its rim, and so far off that part of it is out of reach.
void expect_nearest_everywhere(const Soup& soup, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  auto model = std::make_unique<messages::LocalModel>();
  for (int round = 0; round < 40; ++round) {
    const double reach_m = round % 4 == 0 ? 0.25 : 0.04;
    const Vec3 centre_m = reach_m * Vec3::NullaryExpr([&] { return uniform(random); });
    soup.patch->write(centre_m, *model);
    expect_nearest(soup, centre_m, *model);
  }
}

TEST(LocalPatchLimits, AsManyOfTheNearestAsThereAreTrianglesFor) {
  std::mt19937 random(71);
  const Soup soup = random_soup(3, 400, 60, random);  // 180 vertices at most
  auto model = std::make_unique<messages::LocalModel>();
  soup.patch->write(Vec3::Zero(), *model);
  EXPECT_EQ(model->triangle_count, 256);
  expect_nearest_everywhere(soup, random);
}

TEST(LocalPatchLimits, AsManyOfTheNearestAsThereAreVerticesFor) {
  std::mt19937 random(72);
  const Soup soup = random_soup(4, 100, 300, random);  // three of its own to each triangle
  auto model = std::make_unique<messages::LocalModel>();
  soup.patch->write(Vec3::Zero(), *model);
  EXPECT_EQ(model->triangle_count, 64);
  EXPECT_EQ(model->vertex_count, 192);
  expect_nearest_everywhere(soup, random);
}

TEST(LocalPatchLimits, SurfacesOfAnyMakeFitTogether) {
  std::mt19937 random(73);
  for (int round = 0; round < 8; ++round) {
    const int triangles = 20 + static_cast<int>(random() % 200);
    const int pool = 3 * (8 + static_cast<int>(random() % static_cast<unsigned>(triangles - 8)));
    expect_nearest_everywhere(random_soup(1 + round, triangles, pool, random), random);
  }
}

}  // namespace
}  // namespace myotact::simulation
