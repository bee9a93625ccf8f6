#include "measure/validation/nested_muscle.h"

#include <algorithm>
#include <map>
#include <set>

#include <Eigen/Geometry>

#include "core/at.h"
#include "core/data_folder.h"
#include "geometry/mesh_files.h"
#include "geometry/refine.h"

namespace myotact::measure {
namespace {

constexpr int kTendon = 1;
/// The middle: from this share of the way between the ends to that.
constexpr double kMiddleFrom = 0.4, kMiddleTo = 0.6;
/// A face whose normal has this share along `across` or more is pressed.
constexpr double kFacing = 0.5;

Vec3 mean_of_end(const NestedMuscle& muscle, int end) {
  Vec3 sum = Vec3::Zero();
  double count = 0.0;
  for (std::size_t n = 0; n < muscle.end.size(); ++n) {
    if (muscle.end[n] != end) continue;
    sum += muscle.mesh.nodes_m[n];
    count += 1.0;
  }
  return sum / count;
}

Vec3 centre_of(const geometry::TetMesh& mesh, std::size_t tet) {
  Vec3 sum = Vec3::Zero();
  for (const int node : mesh.corners[tet]) sum += mesh.nodes_m[at(node)];
  return 0.25 * sum;
}

/// The lower body of the two is the origin.
void set_ends(const std::vector<int>& attachments, NestedMuscle& muscle) {
  std::set<int> bodies(attachments.begin(), attachments.end());
  bodies.erase(-1);
  const int origin = *bodies.begin();
  for (const int body : attachments) muscle.end.push_back(body < 0 ? -1 : body == origin ? 0 : 1);
  const Vec3 start_m = mean_of_end(muscle, 0), end_m = mean_of_end(muscle, 1);
  muscle.axis = (end_m - start_m).normalized();
  Eigen::Index smallest = 0;
  muscle.axis.cwiseAbs().minCoeff(&smallest);
  const Vec3 least = Vec3::Unit(smallest);
  muscle.across = muscle.axis.cross(least).normalized();
}

void give_tendon_to_ends(NestedMuscle& muscle) {
  const Vec3 start_m = mean_of_end(muscle, 0), end_m = mean_of_end(muscle, 1);
  for (std::size_t t = 0; t < muscle.tendon.size(); ++t) {
    if (muscle.tendon[t] == 0) continue;
    const Vec3 centre_m = centre_of(muscle.mesh, t);
    const int end = (centre_m - start_m).norm() < (centre_m - end_m).norm() ? 0 : 1;
    for (const int node : muscle.mesh.corners[t]) {
      if (muscle.end[at(node)] < 0) muscle.end[at(node)] = end;
    }
  }
}

void mark_loaded_tets(NestedMuscle& muscle) {
  const Vec3 start_m = mean_of_end(muscle, 0);
  const double length_m = (mean_of_end(muscle, 1) - start_m).dot(muscle.axis);
  for (std::size_t t = 0; t < muscle.mesh.corners.size(); ++t) {
    const auto& corners = muscle.mesh.corners[t];
    muscle.end_tets.push_back(
        std::any_of(corners.begin(), corners.end(), [&](int node) { return muscle.end[at(node)] == 1; }) ? 1 : 0);
    const double part = (centre_of(muscle.mesh, t) - start_m).dot(muscle.axis) / length_m;
    muscle.belly_tets.push_back(part > kMiddleFrom && part < kMiddleTo && muscle.tendon[t] == 0 ? 1 : 0);
  }
}

constexpr std::array<std::array<std::size_t, 3>, 4> kFaces{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

std::array<int, 3> corners_of_face(const geometry::TetMesh& mesh, std::size_t tet, std::size_t opposite) {
  std::array<int, 3> nodes{};
  for (std::size_t k = 0; k < 3; ++k) nodes[k] = mesh.corners[tet][kFaces[opposite][k]];
  return nodes;
}

std::map<std::array<int, 3>, int> count_faces(const geometry::TetMesh& mesh) {
  std::map<std::array<int, 3>, int> uses;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      std::array<int, 3> face = corners_of_face(mesh, t, opposite);
      std::sort(face.begin(), face.end());
      ++uses[face];
    }
  }
  return uses;
}

/// Mid-side node between two corners (of a tet of the mesh, numbered 0 .. 3).
int midside(const geometry::TetMesh& mesh, std::size_t tet, std::size_t a, std::size_t b) {
  for (std::size_t e = 0; e < 6; ++e) {
    const std::size_t first = at(geometry::kTetEdges[e][0]), second = at(geometry::kTetEdges[e][1]);
    if ((first == a && second == b) || (first == b && second == a)) return mesh.midsides[tet][e];
  }
  return -1;
}

/// An even traction on a straight quadratic triangle acts on its mid-side nodes alone.
void add_face(const geometry::TetMesh& mesh, std::size_t tet, std::size_t opposite, double area_m2,
              Eigen::VectorXd& shares) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t a = kFaces[opposite][k], b = kFaces[opposite][(k + 1) % 3];
    shares[mesh.quadratic() ? midside(mesh, tet, a, b) : mesh.corners[tet][a]] += area_m2 / 3.0;
  }
}

}  // namespace

NestedMuscle read_nested_muscle(const std::string& specimen, const std::string& name) {
  const geometry::TetFile file = geometry::read_vtk(data_folder() / "meshes" / specimen / "muscles" / (name + ".vtk"));
  NestedMuscle muscle;
  muscle.mesh = file.mesh;
  muscle.mesh.midsides.clear();
  muscle.fibre = file.fibres;
  for (const int region : file.regions) muscle.tendon.push_back(region == kTendon ? 1 : 0);
  set_ends(file.attachments, muscle);
  give_tendon_to_ends(muscle);
  mark_loaded_tets(muscle);
  return muscle;
}

NestedMuscle refine_muscle(const NestedMuscle& muscle) {
  NestedMuscle fine = muscle;
  std::vector<std::array<int, 2>> edges;
  fine.mesh = geometry::refine(muscle.mesh, &edges);
  for (const auto& edge : edges) {
    const int a = muscle.end[at(edge[0])], b = muscle.end[at(edge[1])];
    fine.end.push_back(a == b ? a : -1);
  }
  const auto to_children = [](const auto& of_parents, auto& of_children) {
    of_children.clear();
    for (const auto& value : of_parents) of_children.insert(of_children.end(), 8, value);
  };
  to_children(muscle.fibre, fine.fibre);
  to_children(muscle.tendon, fine.tendon);
  to_children(muscle.end_tets, fine.end_tets);
  to_children(muscle.belly_tets, fine.belly_tets);
  ++fine.refinements;
  return fine;
}

std::vector<int> ends_of_nodes(const NestedMuscle& muscle, const simulation::Solid& solid) {
  std::vector<int> ends = muscle.end;
  ends.resize(at(solid.nodes()), -1);
  const geometry::TetMesh& mesh = solid.mesh();
  for (std::size_t t = 0; mesh.quadratic() && t < mesh.corners.size(); ++t) {
    for (std::size_t e = 0; e < 6; ++e) {
      const int a = ends[at(mesh.corners[t][at(geometry::kTetEdges[e][0])])];
      const int b = ends[at(mesh.corners[t][at(geometry::kTetEdges[e][1])])];
      if (a == b) ends[at(mesh.midsides[t][e])] = a;
    }
  }
  return ends;
}

Eigen::VectorXd insertion_shares(const NestedMuscle& muscle, const simulation::Solid& solid) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(solid.nodes());
  const geometry::TetMesh& mesh = solid.mesh();
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    if (muscle.end_tets[t] == 0) continue;
    const double volume_m3 = solid.rest_volume_m3(t);
    for (const int node : mesh.corners[t]) shares[node] += volume_m3 * (mesh.quadratic() ? -1.0 / 20.0 : 0.25);
    if (!mesh.quadratic()) continue;
    for (const int node : mesh.midsides[t]) shares[node] += 0.2 * volume_m3;
  }
  return shares / shares.sum();
}

Eigen::VectorXd belly_shares(const NestedMuscle& muscle, const simulation::Solid& solid) {
  Eigen::VectorXd shares = Eigen::VectorXd::Zero(solid.nodes());
  const geometry::TetMesh& mesh = solid.mesh();
  const auto uses = count_faces(mesh);
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t opposite = 0; muscle.belly_tets[t] != 0 && opposite < 4; ++opposite) {
      std::array<int, 3> face = corners_of_face(mesh, t, opposite);
      const Vec3 first = mesh.nodes_m[at(face[0])];
      const Vec3 doubled = (mesh.nodes_m[at(face[1])] - first).cross(mesh.nodes_m[at(face[2])] - first);
      std::sort(face.begin(), face.end());
      if (uses.at(face) > 1 || doubled.dot(muscle.across) < kFacing * doubled.norm()) continue;
      add_face(mesh, t, opposite, 0.5 * doubled.norm(), shares);
    }
  }
  return shares / shares.sum();
}

}  // namespace myotact::measure
