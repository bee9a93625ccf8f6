#include "geometry/corner_welder.h"

#include <bit>

namespace myotact::geometry {

namespace {

/// Every bit of `value` changes about half of the result's (a multiplication carries upwards, a shift downwards).
std::uint64_t mixed(std::uint64_t value) {
  constexpr std::uint64_t kOdd = 0x9e37'79b9'7f4a'7c15U;  // 2^64 over the golden ratio: no pattern in its bits
  value = (value ^ (value >> 32)) * kOdd;
  value = (value ^ (value >> 29)) * kOdd;
  return value ^ (value >> 32);
}

std::uint64_t hash_of(const Vec3& position) {
  std::uint64_t hash = 0;
  // Adding 0 turns -0 into 0, so that equal positions have equal hashes.
  for (const double x : to_array(position)) hash = mixed(hash + std::bit_cast<std::uint64_t>(x + 0.0));
  return hash;
}

std::uint32_t tag_of(std::uint64_t hash) {
  return static_cast<std::uint32_t>(hash >> 32);
}

}  // namespace

CornerWelder::CornerWelder(std::size_t expected_triangles) : slots_(std::bit_ceil(expected_triangles + 8)) {
  mesh_.triangles.reserve(expected_triangles);
  mesh_.positions_m.reserve(expected_triangles / 2);  // a closed surface has half as many vertices
}

void CornerWelder::add(const std::array<Vec3, 3>& corners) {
  const int a = vertex(corners[0]), b = vertex(corners[1]), c = vertex(corners[2]);
  mesh_.triangles.push_back({a, b, c});
}

int CornerWelder::vertex(const Vec3& position_m) {
  const std::uint64_t hash = hash_of(position_m);
  std::size_t slot = find(position_m, hash);
  if (slots_[slot].vertex >= 0) return slots_[slot].vertex;
  if (2 * (vertex_count() + 1) > slots_.size()) {
    grow();
    slot = find(position_m, hash);
  }
  slots_[slot] = {tag_of(hash), static_cast<int>(vertex_count())};
  mesh_.positions_m.push_back(position_m);
  return slots_[slot].vertex;
}

/// The slot that holds the position, or else the free one where it belongs.
std::size_t CornerWelder::find(const Vec3& position_m, std::uint64_t hash) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = static_cast<std::size_t>(hash) & mask;
  while (slots_[slot].vertex >= 0) {
    const bool same = slots_[slot].tag == tag_of(hash) &&
                      mesh_.positions_m[static_cast<std::size_t>(slots_[slot].vertex)] == position_m;
    if (same) break;
    slot = (slot + 1) & mask;
  }
  return slot;
}

void CornerWelder::grow() {
  slots_.assign(2 * slots_.size(), Slot{});
  for (std::size_t v = 0; v < vertex_count(); ++v) {
    const std::uint64_t hash = hash_of(mesh_.positions_m[v]);
    slots_[find(mesh_.positions_m[v], hash)] = {tag_of(hash), static_cast<int>(v)};
  }
}

}  // namespace myotact::geometry
