#include "simulation/solid/patches.h"

#include <algorithm>
#include <array>
#include <map>

namespace myotact::simulation {
namespace {

/// Six tets make a cube of a structured mesh; unstructured meshes have five to six tets a node.
constexpr std::size_t kPatchSize = 6;
/// Left-over groups up to this size join a neighbouring patch.
constexpr std::size_t kSmallPatch = 3;

using Lists = std::vector<std::vector<int>>;

Lists face_neighbours(const geometry::TetMesh& mesh) {
  Lists neighbours(mesh.corners.size());
  std::map<std::array<int, 3>, int> open;
  for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
    for (std::size_t opposite = 0; opposite < 4; ++opposite) {
      std::array<int, 3> face{};
      std::size_t k = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        if (c != opposite) face[k++] = mesh.corners[t][c];
      }
      std::sort(face.begin(), face.end());
      const auto [place, is_new] = open.try_emplace(face, static_cast<int>(t));
      if (is_new) continue;
      neighbours[t].push_back(place->second);
      neighbours[static_cast<std::size_t>(place->second)].push_back(static_cast<int>(t));
    }
  }
  return neighbours;
}

int shared_nodes(const geometry::TetMesh& mesh, const std::vector<int>& tets, int other) {
  int count = 0;
  for (const int node : mesh.corners[static_cast<std::size_t>(other)]) {
    count += std::any_of(tets.begin(), tets.end(), [&](int t) {
      const auto& corners = mesh.corners[static_cast<std::size_t>(t)];
      return std::find(corners.begin(), corners.end(), node) != corners.end();
    });
  }
  return count;
}

/// Patches under construction.
struct Patching {
  const geometry::TetMesh& mesh;
  const std::vector<int>& material;
  Lists neighbours;
  std::vector<int> patch;  // of each tet, -1: none yet
};

std::size_t index(int t) {
  return static_cast<std::size_t>(t);
}

/// The free neighbour that adds the fewest nodes, of several the one of lowest number; -1: none.
int best_neighbour(const Patching& p, const std::vector<int>& tets) {
  int best = -1, most = -1;
  for (const int t : tets) {
    for (const int other : p.neighbours[index(t)]) {
      if (p.patch[index(other)] >= 0 || p.material[index(other)] != p.material[index(t)]) continue;
      const int shared = shared_nodes(p.mesh, tets, other);
      if (shared > most || (shared == most && other < best)) {
        most = shared;
        best = other;
      }
    }
  }
  return best;
}

std::vector<int> grow_patch(Patching& p, int first, int number) {
  std::vector<int> tets;
  for (int next = first; next >= 0; next = best_neighbour(p, tets)) {
    tets.push_back(next);
    p.patch[index(next)] = number;
    if (tets.size() == kPatchSize) break;
  }
  return tets;
}

/// Its tets join a neighbouring patch: alone they would lock.
void dissolve(Patching& p, const std::vector<int>& tets) {
  for (const int t : tets) {
    const auto& around = p.neighbours[index(t)];
    const auto found = std::find_if(around.begin(), around.end(), [&](int other) {
      return p.patch[index(other)] != p.patch[index(t)] && p.material[index(other)] == p.material[index(t)];
    });
    if (found != around.end()) p.patch[index(t)] = p.patch[index(*found)];
  }
}

}  // namespace

std::vector<int> find_patches(const geometry::TetMesh& mesh, const std::vector<int>& material) {
  Patching p{mesh, material, face_neighbours(mesh), std::vector<int>(mesh.corners.size(), -1)};
  Lists patches;
  for (std::size_t first = 0; first < p.patch.size(); ++first) {
    if (p.patch[first] >= 0) continue;
    patches.push_back(grow_patch(p, static_cast<int>(first), static_cast<int>(patches.size())));
  }
  for (const std::vector<int>& tets : patches) {
    if (tets.size() <= kSmallPatch) dissolve(p, tets);
  }
  return p.patch;
}

}  // namespace myotact::simulation
