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

}  // namespace

std::vector<int> find_patches(const geometry::TetMesh& mesh, const std::vector<int>& material) {
  const Lists neighbours = face_neighbours(mesh);
  std::vector<int> patch(mesh.corners.size(), -1);
  Lists patches;
  const auto index = [](int t) { return static_cast<std::size_t>(t); };
  for (std::size_t first = 0; first < patch.size(); ++first) {
    if (patch[first] >= 0) continue;
    std::vector<int> tets{static_cast<int>(first)};
    const int number = static_cast<int>(patches.size());
    patch[first] = number;
    while (tets.size() < kPatchSize) {  // the neighbour that adds the fewest nodes, then the one of lowest number
      int best = -1, most = -1;
      for (const int t : tets) {
        for (const int other : neighbours[index(t)]) {
          if (patch[index(other)] >= 0 || material[index(other)] != material[first]) continue;
          const int shared = shared_nodes(mesh, tets, other);
          if (shared > most || (shared == most && other < best)) {
            most = shared;
            best = other;
          }
        }
      }
      if (best < 0) break;
      tets.push_back(best);
      patch[index(best)] = number;
    }
    patches.push_back(tets);
  }
  for (const std::vector<int>& tets : patches) {  // lone tets would lock
    if (tets.size() > kSmallPatch) continue;
    for (const int t : tets) {
      for (const int other : neighbours[index(t)]) {
        if (patch[index(other)] == patch[index(t)] || material[index(other)] != material[index(t)]) continue;
        patch[index(t)] = patch[index(other)];
        break;
      }
    }
  }
  return patch;
}

}  // namespace myotact::simulation
