#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/vector.h"
#include "geometry/mesh_files.h"
#include "simulation/solid/law.h"
#include "simulation/solid/static_solve.h"

// A finite-element case as `myotact solve` reads it: assets/cases/README.md documents the file.

namespace myotact::measure {

enum class Element { T4, T4F, T10 };
enum class Dynamics { Static, Bdf2, BackwardEuler };

/// The mesh that is computed: of the nodes and mid-sides that the element needs, and no others.
struct CaseMesh {
  std::string file;  // for messages
  geometry::TetMesh mesh;
  std::vector<int> regions;       // of each tet
  std::vector<Vec3> fibres;       // of each tet, unit or zero; empty: none
  std::vector<int> attachments;   // of each node; empty: none
  std::vector<int> node_of_file;  // the node for each of the file's, -1 where it is left out
  std::vector<int> patches;       // of each tet, for T4F; empty: found by the solver
};

/// Nodes that a condition acts on or an output is about.
struct NodeSet {
  std::vector<int> nodes;  // ascending
  int plane_axis = -1;     // 0, 1, 2 of a set that is a plane
};
using NodeSets = std::map<std::string, NodeSet>;

/// What the tets of one region are made of.
struct CaseMaterial {
  std::vector<simulation::Law> laws;
  std::optional<double> density_kg_m3;
  std::optional<double> fluctuation_Pa;
};

enum class Quantity { Displacement, Reaction, Stress, Stretch, VolumeRatio, Energy };
enum class Reduction { Mean, Sum, Max, L2 };

struct CaseOutput {
  std::string name;  // set.quantity.reduce
  Quantity quantity = Quantity::Displacement;
  Reduction reduce = Reduction::Mean;
  std::vector<int> nodes;
  std::vector<int> tets;  // for what tets have
};

struct SolveCase {
  std::string name;  // of the file
  Element element = Element::T10;
  Dynamics dynamics = Dynamics::Static;
  double dt_s = 0.0, t_end_s = 0.0;  // of what is not static
  CaseMesh mesh;
  std::vector<CaseMaterial> materials;
  std::vector<int> material_of_tet;
  simulation::SolidLoads loads;  // at full value
  double activation_ramp_s = 0.0;
  int load_steps = 1;  // the least number, static
  std::optional<double> tolerance;
  std::vector<CaseOutput> outputs;
};

/// Reads and checks a case and its mesh. Throws Error: NoInput, or BadData naming file, place, value, allowed range and
/// remedy.
SolveCase load_case(const std::filesystem::path& path);

}  // namespace myotact::measure
