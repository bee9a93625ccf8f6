#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Geometry>

#include "core/vector.h"
#include "prepare/field/level_set.h"

namespace myotact::prepare {

/// Nodes at equal spacing around a box, x fastest; those of extract_level_set() with the same spacing and inner_box().
class BlockLattice {
 public:
  /// `margin` layers of nodes around the box.
  BlockLattice(const Eigen::AlignedBox3d& box, double spacing_m, int margin)
      : origin_m_(box.min() - Vec3::Constant(margin * spacing_m)), spacing_m_(spacing_m) {
    counts_ = (box.sizes() / spacing_m).array().ceil().cast<int>() + 2 * margin + 1;
  }

  std::size_t size() const { return static_cast<std::size_t>(counts_.cast<std::ptrdiff_t>().prod()); }
  double spacing_m() const { return spacing_m_; }
  std::array<int, 3> counts() const { return {counts_[0], counts_[1], counts_[2]}; }
  /// All but the outermost layer.
  Eigen::AlignedBox3d inner_box() const { return {place_of(Eigen::Array3i::Ones()), place_of(counts_ - 2)}; }
  Vec3 place_of(std::size_t node) const { return place_of(index_of(node)); }
  /// Layers of nodes between this one and the outermost, which is layer 0.
  int layer_of(std::size_t node) const {
    const Eigen::Array3i index = index_of(node);
    return index.min(counts_ - 1 - index).minCoeff();
  }
  /// From any node to its neighbour in that direction, which must be there.
  std::ptrdiff_t offset_to(int x, int y, int z) const {
    return x + counts_[0] * (y + static_cast<std::ptrdiff_t>(counts_[1]) * z);
  }

  /// Calls visit(node) for the nodes at most `reach` layers away, itself among them, x fastest; near the rim fewer.
  template <class Visit>
  void for_each_within(std::size_t node, int reach, Visit&& visit) const {
    const Eigen::Array3i index = index_of(node);
    const Eigen::Array3i low = (index - reach).max(0), high = (index + reach).min(counts_ - 1);
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) visit(node_at({x, y, z}));
      }
    }
  }

  /// Calls visit(node, value) for every node: with the field's value there, or, in blocks that the field cannot vanish
  /// in, with its value at the block's centre. The field changes no faster than distance does.
  template <class Visit>
  void sample(const BodyField& field, Visit&& visit) const {
    for (int z = 0; z < counts_[2]; z += kBlock) {
      for (int y = 0; y < counts_[1]; y += kBlock) {
        for (int x = 0; x < counts_[0]; x += kBlock) sample_block(field, {x, y, z}, visit);
      }
    }
  }

  /// Between the nodes' values, of which there is one a node; outside, as at the nearest place of the lattice.
  double interpolate(const std::vector<float>& values, const Vec3& p) const {
    const Eigen::Array3d place = ((p - origin_m_) / spacing_m_).array().max(0.0).min((counts_ - 1).cast<double>());
    const Eigen::Array3i cell = place.floor().cast<int>().min(counts_ - 2);
    const Eigen::Array3d part = place - cell.cast<double>();
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Array3i step(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
      double weight = 1.0;
      for (Eigen::Index k = 0; k < 3; ++k) weight *= step[k] == 1 ? part[k] : 1.0 - part[k];
      value += weight * static_cast<double>(values[node_at(cell + step)]);
    }
    return value;
  }

 private:
  static constexpr int kBlock = 4;

  std::size_t node_at(const Eigen::Array3i& index) const {
    return (static_cast<std::size_t>(index[2]) * static_cast<std::size_t>(counts_[1]) +
            static_cast<std::size_t>(index[1])) *
               static_cast<std::size_t>(counts_[0]) +
           static_cast<std::size_t>(index[0]);
  }
  Eigen::Array3i index_of(std::size_t node) const {
    const auto row = node / static_cast<std::size_t>(counts_[0]);
    return {static_cast<int>(node % static_cast<std::size_t>(counts_[0])),
            static_cast<int>(row % static_cast<std::size_t>(counts_[1])),
            static_cast<int>(row / static_cast<std::size_t>(counts_[1]))};
  }
  Vec3 place_of(const Eigen::Array3i& index) const { return origin_m_ + spacing_m_ * index.cast<double>().matrix(); }

  template <class Visit>
  void sample_block(const BodyField& field, const Eigen::Array3i& first, Visit& visit) const {
    const double half_m = 0.5 * (kBlock - 1) * spacing_m_;
    const double centre = field(place_of(first) + Vec3::Constant(half_m));
    const bool whole = std::abs(centre) > std::sqrt(3.0) * half_m;
    const Eigen::Array3i last = (first + (kBlock - 1)).min(counts_ - 1);
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          const Eigen::Array3i index(x, y, z);
          visit(node_at(index), whole ? centre : field(place_of(index)));
        }
      }
    }
  }

  Vec3 origin_m_;
  double spacing_m_;
  Eigen::Array3i counts_;
};

}  // namespace myotact::prepare
