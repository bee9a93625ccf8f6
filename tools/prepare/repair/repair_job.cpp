#include "prepare/repair/repair_job.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/text.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

using geometry::TriangleMesh;

RepairJob start_job(const std::string& name, const TriangleMesh& raw, const RepairSettings& settings) {
  RepairJob job;
  job.name = name;
  job.settings = settings;
  Eigen::AlignedBox3d box;
  for (const auto& triangle : raw.triangles) {
    for (const int v : triangle) box.extend(raw.positions_m[at(v)]);
  }
  job.frame = {box.center(), box.diagonal().norm()};
  if (!(job.frame.diagonal_m > 0.0)) {
    job.frame.diagonal_m = 1.0;
    throw refusal(job, "encloses nothing: all triangles lie in one point, at {}. Export it again", Vec3::Zero());
  }
  for (std::size_t v = 0; v < raw.positions_m.size(); ++v) {
    job.mesh.positions_m.emplace_back((raw.positions_m[v] - job.frame.centre_m) / job.frame.diagonal_m);
    job.vertex_source.push_back(static_cast<int>(v));
  }
  job.mesh.triangles = raw.triangles;
  for (int t = 0; t < static_cast<int>(raw.triangles.size()); ++t) {
    job.face_source.push_back(t);
    job.left_out.push_back(least_height(job.mesh, t) <= kSame);  // a line is no surface
  }
  return job;
}

void note(RepairJob& job, std::string_view what, int count, const Vec3& place) {
  if (count == 0) return;
  const auto known =
      std::find_if(job.steps.begin(), job.steps.end(), [&](const RepairStep& step) { return step.what == what; });
  if (known != job.steps.end()) {
    known->count += count;
  } else {
    job.steps.push_back({std::string(what), count, job.frame.to_m(place)});
  }
}

std::string place_text(const Vec3& place_m) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", place_m.x(), place_m.y(), place_m.z());
}

Error refusal(const RepairJob& job, std::string_view problem, const Vec3& place) {
  std::string text(problem);
  if (const std::size_t mark = text.find("{}"); mark != std::string::npos) {
    text.replace(mark, 2, place_text(job.frame.to_m(place)));
  }
  return bad_data(job.name, "surface", text);
}

void keep_triangles(RepairJob& job, const std::vector<bool>& keep, Dropped dropped) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) {
      job.mesh.triangles[kept] = job.mesh.triangles[t];
      job.face_source[kept++] = job.face_source[t];
    } else if (dropped == Dropped::LeftOut && job.face_source[t] >= 0) {
      job.left_out[at(job.face_source[t])] = true;
    }
  }
  job.mesh.triangles.resize(kept);
  job.face_source.resize(kept);
  drop_unused_vertices(job);
}

void drop_unused_vertices(RepairJob& job) {
  std::vector<int> index(job.mesh.positions_m.size(), -1);
  for (const auto& triangle : job.mesh.triangles) {
    for (const int v : triangle) index[at(v)] = 0;
  }
  int kept = 0;
  for (std::size_t v = 0; v < index.size(); ++v) {
    if (index[v] < 0) continue;
    job.mesh.positions_m[at(kept)] = job.mesh.positions_m[v];
    job.vertex_source[at(kept)] = job.vertex_source[v];
    index[v] = kept++;
  }
  job.mesh.positions_m.resize(at(kept));
  job.vertex_source.resize(at(kept));
  for (auto& triangle : job.mesh.triangles) {
    for (int& v : triangle) v = index[at(v)];
  }
}

void add_triangle(RepairJob& job, const std::array<int, 3>& triangle, int source) {
  job.mesh.triangles.push_back(triangle);
  job.face_source.push_back(source);
}

namespace {

/// Corners in an order that does not depend on which comes first; the winding stays.
std::array<int, 3> from_lowest(std::array<int, 3> corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// What each of `wanted` stands for in `known`, or -1. Lists sorted once are smaller and faster than a map.
template <class Key>
std::vector<int> values_of(std::vector<std::pair<Key, int>> known, const std::vector<Key>& wanted) {
  std::sort(known.begin(), known.end());
  std::vector<int> values;
  for (const Key& key : wanted) {
    const auto found = std::lower_bound(known.begin(), known.end(), std::pair{key, std::numeric_limits<int>::min()});
    values.push_back(found != known.end() && found->first == key ? found->second : -1);
  }
  return values;
}

}  // namespace

void adopt(RepairJob& job, const TriangleMesh& result, int new_source) {
  std::vector<std::pair<std::array<double, 3>, int>> places;
  for (const Vec3& p : job.mesh.positions_m) places.emplace_back(to_array(p), static_cast<int>(places.size()));
  std::vector<std::array<double, 3>> wanted_places;
  for (const Vec3& p : result.positions_m) wanted_places.push_back(to_array(p));
  const std::vector<int> old_vertex = values_of(std::move(places), wanted_places);

  std::vector<std::pair<std::array<int, 3>, int>> triangles;
  for (const auto& triangle : job.mesh.triangles) {
    triangles.emplace_back(from_lowest(triangle), static_cast<int>(triangles.size()));
  }
  std::vector<std::array<int, 3>> wanted_triangles;
  for (const auto& [a, b, c] : result.triangles) {
    wanted_triangles.push_back(from_lowest({old_vertex[at(a)], old_vertex[at(b)], old_vertex[at(c)]}));
  }
  const std::vector<int> old_triangle = values_of(std::move(triangles), wanted_triangles);

  std::vector<int> vertex_source, face_source;
  for (const int v : old_vertex) vertex_source.push_back(v < 0 ? -1 : job.vertex_source[at(v)]);
  for (const int t : old_triangle) face_source.push_back(t < 0 ? new_source : job.face_source[at(t)]);
  job.mesh = result;
  job.vertex_source = std::move(vertex_source);
  job.face_source = std::move(face_source);
  drop_unused_vertices(job);
}

Vec3 centroid(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[at(triangle)];
  return (mesh.positions_m[at(a)] + mesh.positions_m[at(b)] + mesh.positions_m[at(c)]) / 3.0;
}

Vec3 area_vector(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[at(triangle)];
  return (mesh.positions_m[at(b)] - mesh.positions_m[at(a)]).cross(mesh.positions_m[at(c)] - mesh.positions_m[at(a)]);
}

double least_height(const TriangleMesh& mesh, int triangle) {
  const auto& [a, b, c] = mesh.triangles[at(triangle)];
  const double longest = std::max({(mesh.positions_m[at(a)] - mesh.positions_m[at(b)]).norm(),
                                   (mesh.positions_m[at(b)] - mesh.positions_m[at(c)]).norm(),
                                   (mesh.positions_m[at(c)] - mesh.positions_m[at(a)]).norm()});
  return longest > 0.0 ? area_vector(mesh, triangle).norm() / longest : 0.0;
}

}  // namespace myotact::prepare
