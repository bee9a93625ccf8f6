#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "simulation/linear/block_matrix.h"
#include "simulation/linear/dense_front.h"

namespace myotact::simulation {

/// L D L^T of a symmetric BlockMatrix by the multifrontal method: nodes are ordered by minimum degree, neighbouring
/// columns of like structure are eliminated together in dense fronts. Scalar is what the factors are kept in.
/// Single precision moves half the bytes: a solution is right to 1e-5 .. 3e-3 on the muscles of the elbow, enough for a
/// Newton step, whose residual is taken in double anyway. The pattern is analysed once; a factorisation allocates
/// nothing but each thread's own workspace, once. No pivoting: meant for positive definite matrices; an indefinite one
/// is factored too as long as no pivot vanishes.
template <class Scalar>
class BlockFactorOf {
 public:
  /// Without a pattern: good for assignment only.
  BlockFactorOf() = default;
  /// Analyses the pattern. Throws Error BadData when the factor would hold more than 2^31 numbers.
  explicit BlockFactorOf(const BlockMatrix& pattern);

  /// The matrix may be added up where it will be factored, block by block after set_zero(). values() and its places()
  /// are what slots refer to; factor() overwrites them. Blocks that the pattern does not have must not be named.
  void set_zero();  // all places
  Scalar* values() { return values_.data(); }
  std::size_t places() const { return values_.size(); }
  /// Of the stored block of two nodes of the pattern; its rows are those of the node that is eliminated later.
  BlockSlot slot(int a, int b) const;
  /// Whether node a is eliminated after node b.
  bool is_later(int a, int b) const {
    return order_[static_cast<std::size_t>(a)] > order_[static_cast<std::size_t>(b)];
  }
  /// Adds a block, in the matrix's numbering, and a multiple of the unit matrix to a node's diagonal block. Either
  /// order of row and column names the same stored block: add one of the two.
  void add(int row, int column, const Mat3& block);
  void add_diagonal(int node, double value);

  /// Factors what was added. False when a pivot is zero or not finite; solve() must not be called then.
  bool factor();
  /// Factors a matrix of that pattern. Likewise.
  bool factor(const BlockMatrix& matrix);
  /// Every pivot of the last factorisation was positive.
  bool positive() const { return positive_; }

  /// matrix^-1 right, four columns at a time, or a last one alone. Rows as in the matrix.
  /// Const, but after a factor(); several threads may solve at once. Allocates.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// The same, corrected once by its own residual in double: right to 1e-5. `matrix` is the one that was factored.
  Eigen::MatrixXd solve_refined(const BlockMatrix& matrix, const Eigen::MatrixXd& right) const;

 private:
  /// A group of neighbouring columns with one dense front: its own nodes first, then the nodes below that it touches.
  struct Front {
    std::vector<int> nodes;  // in elimination order's numbering; the first `own` are eliminated here
    int own = 0;
    std::size_t start = 0;       // of its own columns in the values
    std::vector<int> children;   // fronts whose remainder is added here
    std::vector<FrontRun> runs;  // where the rows after the own ones are in the parent
    bool even = false;           // an even number of fronts above it
  };
  /// A block of a BlockMatrix and where it goes.
  struct Entry {
    BlockSlot from, to;
    bool transposed = false;
  };

  void make_fronts(const std::vector<std::vector<int>>& neighbours);
  void place_entries(const BlockMatrix& pattern);
  /// What a factorisation works in: the panel of eliminate_front() and the remainders that wait for their parents.
  /// Fronts are met children first, so what waits is a stack; two of them, because a front's own remainder is built
  /// while its children's are still read. One a thread, small enough to stay in its cache.
  struct Workspace {
    struct Stack {
      std::vector<Scalar> places;
      std::size_t top = 0;
    };
    std::vector<Scalar> panel;
    std::array<Stack, 2> stacks;  // of fronts with an even number of fronts above them, and the others

    Stack& stack_of(const Front& front) { return stacks[front.even ? 0 : 1]; }
  };
  static std::size_t remainder_places(const Front& front);
  void find_depths();
  void reserve(Workspace& work) const;
  DenseFront<Scalar> assemble_front(std::size_t front, Workspace& work);
  DenseFront<Scalar> kept(std::size_t front) const;
  /// Right sides, one after the other in elimination order, become the solutions.
  template <std::size_t kSides>
  void solve_sides(Scalar* x) const;
  /// Columns of `right` from `first`, as many as there are up to kSides.
  template <std::size_t kSides>
  void solve_columns(const Eigen::MatrixXd& right, Eigen::Index first, Eigen::MatrixXd& result) const;

  std::vector<int> order_;            // elimination position of each node
  std::vector<BlockSlot> diagonals_;  // of each node
  std::vector<Front> fronts_;
  std::vector<int> front_of_;      // by elimination position: the front that eliminates it
  std::vector<Entry> entries_;     // of a whole BlockMatrix
  std::vector<Scalar> values_;     // own columns of all fronts, see dense_front.h: the matrix, then its factors
  std::size_t largest_front_ = 0;  // rows
  std::array<std::size_t, 2> stack_places_{};  // that the stacks of a workspace need
  bool positive_ = false;
};

/// For the steps of a running simulation.
using BlockFactor = BlockFactorOf<float>;
/// For static solves to the last digits, and for comparison.
using ExactBlockFactor = BlockFactorOf<double>;

}  // namespace myotact::simulation
