#include "exchange/vtk_scene.h"

#include <cmath>
#include <limits>
#include <utility>

#include "core/at.h"
#include "simulation/tissue_snapshot.h"

namespace myotact::exchange {

namespace {

using Reals = std::vector<double>;
using Integers = std::vector<std::int32_t>;
using simulation::TissueSnapshot;

constexpr double kNotOfBones = std::numeric_limits<double>::quiet_NaN();

void add_vector(const Vec3& v, Reals& out) {
  out.insert(out.end(), {v.x(), v.y(), v.z()});
}

/// Whole muscles, as the view colours them.
struct MuscleValues {
  Reals activation, tension_N, fibre_length;

  void add(const messages::SceneFrame& frame, std::size_t muscle) {
    activation.push_back(frame.activations[muscle]);
    tension_N.push_back(frame.tensions_N[muscle]);
    fibre_length.push_back(frame.stretches[muscle]);
  }
  void add_none() {
    for (Reals* list : {&activation, &tension_N, &fibre_length}) list->push_back(kNotOfBones);
  }
  void move_to(std::vector<VtkArray>& arrays) {
    arrays.push_back({"activation", 1, std::move(activation)});
    arrays.push_back({"tension_N", 1, std::move(tension_N)});
    arrays.push_back({"fibre_length", 1, std::move(fibre_length)});
  }
};

/// What stands at the tets.
struct TetValues {
  Integers muscle, region;
  Reals fibre, stretch, volume_ratio, fibre_Pa, stress_Pa, von_mises_Pa, pressure_Pa;
  MuscleValues whole;

  void add(const TissueSnapshot& now, std::size_t tet) {
    add_vector(now.fibre[tet], fibre);
    stretch.push_back(now.stretch[tet]);
    volume_ratio.push_back(now.volume_ratio[tet]);
    fibre_Pa.push_back(now.fibre_Pa[tet]);
    const Mat3& s = now.cauchy_Pa[tet];
    stress_Pa.insert(stress_Pa.end(), {s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(1, 2), s(0, 2)});
    const Mat3 deviator = s - s.trace() / 3.0 * Mat3::Identity();
    von_mises_Pa.push_back(std::sqrt(1.5) * deviator.norm());
    pressure_Pa.push_back(-s.trace() / 3.0);
  }
  void move_to(std::vector<VtkArray>& arrays) {
    arrays.push_back({"muscle", 1, std::move(muscle)});
    arrays.push_back({"region", 1, std::move(region)});
    arrays.push_back({"fibre", 3, std::move(fibre)});
    arrays.push_back({"stretch", 1, std::move(stretch)});
    arrays.push_back({"volume_ratio", 1, std::move(volume_ratio)});
    arrays.push_back({"fibre_stress_Pa", 1, std::move(fibre_Pa)});
    arrays.push_back({"stress_Pa", 6, std::move(stress_Pa)});
    arrays.push_back({"von_mises_Pa", 1, std::move(von_mises_Pa)});
    arrays.push_back({"pressure_Pa", 1, std::move(pressure_Pa)});
    whole.move_to(arrays);
  }
};

/// Of the nodes that were there before the mid-sides; those lie between two that are attached to one body, or nowhere.
Integers attachments_of(const anatomy::Muscle& muscle, const geometry::TetMesh& rest) {
  Integers bodies(rest.nodes_m.size(), -1);
  for (std::size_t n = 0; n < muscle.attachments.size(); ++n) bodies[n] = muscle.attachments[n];
  for (std::size_t t = 0; t < rest.midsides.size(); ++t) {
    for (std::size_t e = 0; e < geometry::kTetEdges.size(); ++e) {
      const auto body = [&](std::size_t k) { return bodies[at(rest.corners[t][at(geometry::kTetEdges[e][k])])]; };
      if (body(0) == body(1)) bodies[at(rest.midsides[t][e])] = body(0);
    }
  }
  return bodies;
}

void add_tets(const geometry::TetMesh& rest, std::int64_t first_point, VtkPiece& piece) {
  for (std::size_t t = 0; t < rest.corners.size(); ++t) {
    for (const int node : rest.corners[t]) piece.connectivity.push_back(first_point + node);
    if (rest.quadratic()) {
      for (const int node : rest.midsides[t]) piece.connectivity.push_back(first_point + node);
    }
    piece.offsets.push_back(static_cast<std::int64_t>(piece.connectivity.size()));
    piece.types.push_back(rest.quadratic() ? kVtkQuadraticTetra : kVtkTetra);
  }
}

template <class Parts>
std::vector<std::string> keys_of(const Parts& parts) {
  std::vector<std::string> keys;
  for (const auto& part : parts) keys.push_back(part.key);
  return keys;
}

void add_triangles(const geometry::TriangleMesh& mesh, std::int64_t first_point, VtkPiece& piece) {
  for (const auto& triangle : mesh.triangles) {
    for (const int vertex : triangle) piece.connectivity.push_back(first_point + vertex);
    piece.offsets.push_back(static_cast<std::int64_t>(piece.connectivity.size()));
  }
}

}  // namespace

VtkPiece vtk_tissue(const anatomy::Specimen& specimen, const simulation::Simulation& simulation) {
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  VtkPiece piece;
  Reals displacement_m, velocity_m_s;
  Integers attachment;
  TetValues tets;
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const anatomy::Muscle& muscle = specimen.muscles[m];
    const TissueSnapshot now = simulation.tissue(static_cast<int>(m));
    add_tets(now.rest, static_cast<std::int64_t>(piece.points_m.size()), piece);
    for (std::size_t n = 0; n < now.position_m.size(); ++n) {
      piece.points_m.push_back(now.position_m[n]);
      add_vector(now.position_m[n] - now.rest.nodes_m[n], displacement_m);
      add_vector(now.velocity_m_s[n], velocity_m_s);
    }
    const Integers bodies = attachments_of(muscle, now.rest);
    attachment.insert(attachment.end(), bodies.begin(), bodies.end());
    for (std::size_t t = 0; t < now.rest.corners.size(); ++t) {
      tets.muscle.push_back(static_cast<std::int32_t>(m));
      tets.region.push_back(static_cast<std::int32_t>(muscle.regions[t]));
      tets.whole.add(frame, m);
      tets.add(now, t);
    }
  }
  piece.point_data = {{"displacement_m", 3, std::move(displacement_m)},
                      {"velocity_m_s", 3, std::move(velocity_m_s)},
                      {"attachment", 1, std::move(attachment)}};
  tets.move_to(piece.cell_data);
  piece.field_data = {{"TimeValue", 1, Reals{frame.time_s}},
                      {"muscle_keys", 1, keys_of(specimen.muscles)},
                      {"body_keys", 1, keys_of(specimen.bodies)}};
  return piece;
}

VtkPiece vtk_surfaces(const anatomy::Specimen& specimen, const simulation::Simulation& simulation) {
  messages::SceneFrame frame;
  simulation.write_frame(frame);
  VtkPiece piece;
  piece.surface = true;
  Integers part, muscle_of;
  Reals volume_error;
  MuscleValues values;
  for (std::size_t b = 0; b < specimen.bones.size(); ++b) {
    const anatomy::Bone& bone = specimen.bones[b];
    add_triangles(bone.surface, static_cast<std::int64_t>(piece.points_m.size()), piece);
    const Pose pose = simulation.body_pose(bone.body);
    for (const Vec3& p : bone.surface.positions_m) piece.points_m.push_back(pose * p);
    for (std::size_t t = 0; t < bone.surface.triangles.size(); ++t) {
      part.push_back(static_cast<std::int32_t>(b));
      muscle_of.push_back(-1);
      volume_error.push_back(kNotOfBones);
      values.add_none();
    }
  }
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const geometry::TriangleMesh& skin = specimen.muscles[m].skin;
    add_triangles(skin, static_cast<std::int64_t>(piece.points_m.size()), piece);
    for (const Vec3& p : simulation.skin_world_m(static_cast<int>(m))) piece.points_m.push_back(p);
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
      part.push_back(static_cast<std::int32_t>(specimen.bones.size() + m));
      muscle_of.push_back(static_cast<std::int32_t>(m));
      volume_error.push_back(frame.volume_ratios[m] - 1.0);
      values.add(frame, m);
    }
  }
  piece.cell_data = {{"part", 1, std::move(part)}, {"muscle", 1, std::move(muscle_of)}};
  values.move_to(piece.cell_data);
  piece.cell_data.push_back({"volume_error", 1, std::move(volume_error)});
  std::vector<std::string> keys = keys_of(specimen.bones);
  for (const std::string& key : keys_of(specimen.muscles)) keys.push_back(key);
  piece.field_data = {{"TimeValue", 1, Reals{frame.time_s}}, {"part_keys", 1, std::move(keys)}};
  return piece;
}

}  // namespace myotact::exchange
