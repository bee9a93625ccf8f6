#include "prepare/dirty_edits.h"

#include <algorithm>

namespace myotact::testing {

using geometry::TriangleMesh;

Vec3 random_vector(std::mt19937& random, double length) {
  // Not std::uniform_real_distribution: its numbers differ between libraries.
  const auto unit = [&] { return 2.0 * static_cast<double>(random()) / 4294967296.0 - 1.0; };
  return length * Vec3(unit(), unit(), unit());
}

double diagonal_of(const TriangleMesh& mesh) {
  Vec3 low = mesh.positions_m[0], high = low;
  for (const Vec3& p : mesh.positions_m) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).norm();
}

void flip(TriangleMesh& mesh, std::size_t triangle) {
  std::swap(mesh.triangles[triangle][0], mesh.triangles[triangle][1]);
}

TriangleMesh turned(TriangleMesh mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) flip(mesh, t);
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor, const Vec3& shift) {
  for (Vec3& p : mesh.positions_m) p = factor * p + shift;
  return mesh;
}

bool has_vertex(const std::array<int, 3>& triangle, int v) {
  return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
}

TriangleMesh without(TriangleMesh mesh, const std::vector<int>& vertices) {
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& triangle) {
    return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return has_vertex(triangle, v); });
  });
  return mesh;
}

TriangleMesh with_round_hole(const TubeBody& body, double radius) {
  TriangleMesh mesh = body.mesh;
  const Vec3 centre = mesh.positions_m[at(body.vertex(body.rings / 2, 0))];
  const double limit_m = radius * diagonal_of(mesh);
  std::erase_if(mesh.triangles, [&](const std::array<int, 3>& t) {
    const Vec3 middle = (mesh.positions_m[at(t[0])] + mesh.positions_m[at(t[1])] + mesh.positions_m[at(t[2])]) / 3.0;
    return (middle - centre).norm() < limit_m;
  });
  return mesh;
}

TriangleMesh soup_of(const TriangleMesh& mesh, std::mt19937& random, double gap) {
  TriangleMesh soup;
  const double length_m = gap * diagonal_of(mesh);
  for (const auto& triangle : mesh.triangles) {
    const int base = static_cast<int>(soup.positions_m.size());
    for (const int v : triangle) soup.positions_m.push_back(mesh.positions_m[at(v)] + random_vector(random, length_m));
    soup.triangles.push_back({base, base + 1, base + 2});
  }
  return soup;
}

void split_one_side(TriangleMesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = mesh.triangles[triangle];
  const int middle = static_cast<int>(mesh.positions_m.size());
  mesh.positions_m.push_back(0.5 * (mesh.positions_m[at(a)] + mesh.positions_m[at(b)]));
  mesh.triangles[triangle] = {a, middle, c};
  mesh.triangles.push_back({middle, b, c});
}

void add_wall(TriangleMesh& mesh, const TubeBody& body, int ring) {
  Vec3 middle = Vec3::Zero();
  for (int side = 0; side < body.sides; ++side) middle += mesh.positions_m[at(body.vertex(ring, side))] / body.sides;
  const int centre = static_cast<int>(mesh.positions_m.size());
  mesh.positions_m.push_back(middle);
  for (int side = 0; side < body.sides; ++side) {
    mesh.triangles.push_back({centre, body.vertex(ring, side), body.vertex(ring, side + 1)});
  }
}

void add_fin(TriangleMesh& mesh, const TubeBody& body, int ring, int side) {
  const int a = body.vertex(ring, side), b = body.vertex(ring + 1, side);
  const std::vector<Vec3> normals = geometry::vertex_normals(body.mesh);
  const int tip = static_cast<int>(mesh.positions_m.size());
  mesh.positions_m.push_back(mesh.positions_m[at(a)] + 0.01 * normals[at(a)]);
  mesh.triangles.push_back({a, b, tip});
}

void add_slit(TriangleMesh& mesh, const TubeBody& body, int ring, double gap) {
  const double gap_m = gap * diagonal_of(body.mesh);
  for (int side = 1; side < body.sides / 3; ++side) {
    const int v = body.vertex(ring, side);
    const int copy = static_cast<int>(mesh.positions_m.size());
    mesh.positions_m.push_back(mesh.positions_m[at(v)]);
    const Vec3 along = (mesh.positions_m[at(body.vertex(ring + 1, side))] - mesh.positions_m[at(v)]).normalized();
    mesh.positions_m.back() += gap_m * along;
    for (auto& triangle : mesh.triangles) {
      const bool beyond = std::any_of(triangle.begin(), triangle.end(), [&](int corner) {
        return corner >= body.vertex(ring + 1, 0) && corner <= body.last();
      });
      if (!beyond) continue;
      for (int& corner : triangle) corner = corner == v ? copy : corner;
    }
  }
}

Make edit(std::function<void(TriangleMesh&, const TubeBody&, std::mt19937&)> change) {
  return [change = std::move(change)](const TubeBody& body, std::mt19937& random) {
    TriangleMesh mesh = body.mesh;
    change(mesh, body, random);
    return mesh;
  };
}

}  // namespace myotact::testing
