#include "prepare/partition/interface_slabs.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "core/at.h"

namespace myotact::prepare {

namespace {

/// Borders of about so many triangles are simplified at a time: as many as a processor's cache holds.
constexpr std::size_t kSlabFaces = 60000;

/// Which slab every face lies in, by its lowest corner along the longest direction of all; as many faces a slab.
std::vector<int> slabs_of(const Interfaces& interfaces, int& slabs) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : interfaces.positions_m) box.extend(p);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t f = 0; f < interfaces.faces.size(); ++f) {
    const auto& v = interfaces.faces[f].vertices;
    const auto along = [&](std::size_t k) { return interfaces.positions_m[at(v[k])][axis]; };
    order.emplace_back(std::min({along(0), along(1), along(2)}), f);
  }
  std::sort(order.begin(), order.end());
  slabs = static_cast<int>(interfaces.faces.size() / kSlabFaces) + 1;
  const std::size_t faces_a_slab = order.size() / at(slabs) + 1;
  std::vector<int> slab_of(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) slab_of[order[i].second] = static_cast<int>(i / faces_a_slab);
  return slab_of;
}

/// What a vertex belongs to, if not to one slab.
constexpr int kNone = -1, kSeveral = -2;

/// The slab of all faces of each vertex.
std::vector<int> owners_of(const Interfaces& interfaces, const std::vector<int>& slab_of) {
  std::vector<int> owner(interfaces.positions_m.size(), kNone);
  for (std::size_t f = 0; f < slab_of.size(); ++f) {
    for (const int v : interfaces.faces[f].vertices) {
      int& slab = owner[at(v)];
      slab = slab == kNone || slab == slab_of[f] ? slab_of[f] : kSeveral;
    }
  }
  return owner;
}

}  // namespace

std::vector<Slab> split_into_slabs(const Interfaces& interfaces) {
  int count = 0;
  const std::vector<int> slab_of = slabs_of(interfaces, count);
  const std::vector<int> owner = owners_of(interfaces, slab_of);
  std::vector<int> number(interfaces.positions_m.size(), kNone);
  std::vector<std::vector<std::size_t>> faces(at(count));
  for (std::size_t f = 0; f < slab_of.size(); ++f) faces[at(slab_of[f])].push_back(f);
  std::vector<Slab> slabs(faces.size());
  for (std::size_t s = 0; s < slabs.size(); ++s) {
    Slab& slab = slabs[s];
    for (const std::size_t f : faces[s]) {
      Interfaces::Face face = interfaces.faces[f];
      for (int& v : face.vertices) {
        int& own = number[at(v)];
        if (own == kNone) {
          own = static_cast<int>(slab.whole.size());
          slab.whole.push_back(v);
          slab.is_shared.push_back(owner[at(v)] == kSeveral);
          slab.interfaces.positions_m.push_back(interfaces.positions_m[at(v)]);
        }
        v = own;
      }
      slab.interfaces.faces.push_back(face);
    }
    for (const int v : slab.whole) number[at(v)] = kNone;
  }
  return slabs;
}

Interfaces join_slabs(const std::vector<Slab>& slabs, std::size_t vertices) {
  Interfaces whole;
  std::vector<int> shared(vertices, -1);
  for (const Slab& slab : slabs) {
    std::vector<int> number;
    for (std::size_t v = 0; v < slab.whole.size(); ++v) {
      int* known = slab.is_shared[v] ? &shared[at(slab.whole[v])] : nullptr;
      if (known && *known >= 0) {
        number.push_back(*known);
        continue;
      }
      number.push_back(static_cast<int>(whole.positions_m.size()));
      if (known) *known = number.back();
      whole.positions_m.push_back(slab.interfaces.positions_m[v]);
    }
    for (Interfaces::Face face : slab.interfaces.faces) {
      for (int& v : face.vertices) v = number[at(v)];
      whole.faces.push_back(face);
    }
  }
  return whole;
}

}  // namespace myotact::prepare
