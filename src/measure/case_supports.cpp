#include "measure/case_supports.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/dense_matrix.h"
#include "core/error.h"
#include "geometry/tet_topology.h"

namespace myotact::measure {

namespace {

/// Of the strongest constraint, squared: round-off leaves 1e-16.
constexpr double kWeakest = 1e-10;

/// A node's velocity along one axis for a unit of each rigid motion: three of translation, three of rotation.
using Row = Eigen::Matrix<double, 6, 1>;

/// Tets that hang together, by whatever.
struct Part {
  std::vector<int> nodes;
  std::vector<int> blocks;  // of tets that share faces; ascending
  std::vector<simulation::HeldDof> held;
  int first_tet = -1;
  int tets = 0;
  Vec3 centre_m = Vec3::Zero();
  double size_m = 0.0;
};

/// The parts of a mesh and their blocks, and to which each node belongs.
class Assembly {
 public:
  explicit Assembly(const SolveCase& solve_case) : mesh_(solve_case.mesh.mesh) {
    const std::vector<int> part_of_tet = geometry::connected_parts(mesh_);
    const std::vector<int> block_of_tet = geometry::face_connected_blocks(mesh_);
    part_of_node_.assign(mesh_.nodes_m.size(), -1);
    blocks_of_node_.resize(mesh_.nodes_m.size());
    for (std::size_t tet = 0; tet < part_of_tet.size(); ++tet) add_tet(tet, part_of_tet[tet], block_of_tet[tet]);
    for (Part& part : parts_) measure_part(part);
    for (const simulation::HeldDof& held : solve_case.loads.held) {
      const int part = part_of_node_[static_cast<std::size_t>(held.node)];
      parts_[static_cast<std::size_t>(part)].held.push_back(held);
    }
  }

  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<int>& blocks_of(int node) const { return blocks_of_node_[static_cast<std::size_t>(node)]; }
  int first_tet_of_block(int block) const { return first_tet_of_block_[static_cast<std::size_t>(block)]; }

  Row row(const Part& part, int node, int component) const {
    const Vec3 arm = (mesh_.nodes_m[static_cast<std::size_t>(node)] - part.centre_m) / part.size_m;
    const Vec3 direction = Vec3::Unit(component);
    Row result;
    result << direction, arm.cross(direction);
    return result;
  }

 private:
  /// Parts and blocks are counted in the order of their first tets.
  void add_tet(std::size_t tet, int part_index, int block) {
    if (part_index == static_cast<int>(parts_.size())) {
      parts_.emplace_back();
      parts_.back().first_tet = static_cast<int>(tet);
    }
    Part& part = parts_[static_cast<std::size_t>(part_index)];
    ++part.tets;
    if (block == static_cast<int>(first_tet_of_block_.size())) {
      first_tet_of_block_.push_back(static_cast<int>(tet));
      part.blocks.push_back(block);
    }
    const auto claim = [&](int node) {
      int& owner = part_of_node_[static_cast<std::size_t>(node)];
      if (owner < 0) part.nodes.push_back(node);
      owner = part_index;
      auto& blocks = blocks_of_node_[static_cast<std::size_t>(node)];
      if (std::find(blocks.begin(), blocks.end(), block) == blocks.end()) blocks.push_back(block);
    };
    std::for_each(mesh_.corners[tet].begin(), mesh_.corners[tet].end(), claim);
    if (mesh_.quadratic()) std::for_each(mesh_.midsides[tet].begin(), mesh_.midsides[tet].end(), claim);
  }

  void measure_part(Part& part) const {
    const auto place = [&](int node) -> const Vec3& { return mesh_.nodes_m[static_cast<std::size_t>(node)]; };
    for (const int node : part.nodes) part.centre_m += place(node) / static_cast<double>(part.nodes.size());
    for (const int node : part.nodes) part.size_m = std::max(part.size_m, (place(node) - part.centre_m).norm());
  }

  const geometry::TetMesh& mesh_;
  std::vector<Part> parts_;
  std::vector<int> part_of_node_;
  std::vector<std::vector<int>> blocks_of_node_;
  std::vector<int> first_tet_of_block_;
};

/// How many of the six rigid motions of a part its supports resist.
int held_motions(const Assembly& assembly, const Part& part) {
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  for (const auto& held : part.held) {
    const Row row = assembly.row(part, held.node, held.component);
    gram += row * row.transpose();
  }
  const Eigen::VectorXd values = symmetric_eigen(gram).values;
  return static_cast<int>((values.array() > kWeakest * std::max(values[5], 1e-300)).count());
}

/// Constraints on the rigid motions of the blocks of one part, six unknowns each.
class Linkage {
 public:
  explicit Linkage(const Part& part) : part_(part), gram_(Eigen::MatrixXd::Zero(unknowns(), unknowns())) {}

  void hold(int block, const Row& row) { add(block, block, row * row.transpose()); }
  /// Both blocks move a node alike.
  void join(int a, int b, const Row& row) {
    const Eigen::Matrix<double, 6, 6> square = row * row.transpose();
    add(a, a, square);
    add(b, b, square);
    add(a, b, -square);
    add(b, a, -square);
  }

  /// The block that moves most in the motion that is resisted least; -1: all are resisted.
  int swinging_block() const {
    const SymmetricEigen motions = symmetric_eigen(gram_);
    if (motions.values[0] > kWeakest * motions.values[unknowns() - 1]) return -1;
    const Eigen::VectorXd motion = motions.vectors.col(0);
    const auto speed = [&](int block) { return motion.segment<6>(place(block)).norm(); };
    return *std::max_element(part_.blocks.begin(), part_.blocks.end(),
                             [&](int a, int b) { return speed(a) < speed(b); });
  }

 private:
  Eigen::Index unknowns() const { return 6 * static_cast<Eigen::Index>(part_.blocks.size()); }
  Eigen::Index place(int block) const {  // blocks of a part ascend
    return 6 * (std::lower_bound(part_.blocks.begin(), part_.blocks.end(), block) - part_.blocks.begin());
  }
  void add(int a, int b, const Eigen::Matrix<double, 6, 6>& square) { gram_.block<6, 6>(place(a), place(b)) += square; }

  const Part& part_;
  Eigen::MatrixXd gram_;
};

int swinging_block(const Assembly& assembly, const Part& part) {
  Linkage linkage(part);
  for (const int node : part.nodes) {
    const std::vector<int>& blocks = assembly.blocks_of(node);
    for (std::size_t k = 1; k < blocks.size(); ++k) {
      for (int i = 0; i < 3; ++i) linkage.join(blocks[0], blocks[k], assembly.row(part, node, i));
    }
  }
  for (const auto& held : part.held) {
    linkage.hold(assembly.blocks_of(held.node)[0], assembly.row(part, held.node, held.component));
  }
  return linkage.swinging_block();
}

}  // namespace

void check_supports(const SolveCase& solve_case) {
  /// A part of more blocks is taken as one: the check is dense, and would outlast the solve.
  constexpr std::size_t kMostBlocks = 100;
  const Assembly assembly(solve_case);
  for (const Part& part : assembly.parts()) {
    const auto refusal = [&](int tet, const std::string& problem) {
      return bad_data(solve_case.mesh.file, fmt::format("tet {}", tet), problem);
    };
    if (const int motions = held_motions(assembly, part); motions < 6) {
      throw refusal(part.first_tet,
                    fmt::format("the part of {} tets that begins with it can move as a rigid body: {} of 6 motions are "
                                "held, all must be; hold it with fix, symmetry or displace",
                                part.tets, motions));
    }
    if (part.blocks.size() < 2 || part.blocks.size() > kMostBlocks) continue;
    const int block = swinging_block(assembly, part);
    if (block < 0) continue;
    throw refusal(assembly.first_tet_of_block(block),
                  "the block that begins with it hangs on the rest by a node or an edge only and can swing there; join "
                  "it by faces, or hold it with fix, symmetry or displace");
  }
}

}  // namespace myotact::measure
