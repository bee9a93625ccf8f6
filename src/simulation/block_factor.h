#pragma once

#include <vector>

#include <Eigen/Core>

#include "simulation/block_matrix.h"
#include "simulation/dense_front.h"

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
  BlockFactorOf() = default;
  /// Analyses the pattern.
  explicit BlockFactorOf(const BlockMatrix& pattern);

  /// Factors a matrix of that pattern. False when a pivot is zero or not finite; solve() must not be called then.
  bool factor(const BlockMatrix& matrix);
  /// Every pivot of the last factorisation was positive.
  bool positive() const { return positive_; }

  /// matrix^-1 right, four columns at a time: one costs as much as four. Rows as in the matrix.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  /// The same, corrected once by its own residual in double: right to 1e-5. `matrix` is the one that was factored.
  Eigen::MatrixXd solve_refined(const BlockMatrix& matrix, const Eigen::MatrixXd& right) const;

 private:
  /// Neighbouring nodes that are neighbours in the parent's list too.
  struct Run {
    int count = 0;
    int place = 0;  // of the first one in the parent's list
  };
  /// A group of neighbouring columns with one dense front: its own nodes first, then the nodes below that it touches.
  struct Front {
    std::vector<int> nodes;  // in elimination order's numbering; the first `own` are eliminated here
    int own = 0;
    std::vector<int> children;  // fronts whose remainder is added here
    std::vector<Run> runs;      // where the nodes after the own ones are in the parent's list
  };
  /// A block of the matrix and where it goes.
  struct Entry {
    BlockSlot slot;
    int row = 0, column = 0;  // in the front's list of nodes
    bool transposed = false;
  };

  void make_fronts(const std::vector<std::vector<int>>& neighbours);
  void place_entries(const BlockMatrix& pattern);
  /// What a factorisation works in: one front's columns that are not its own, its panel, and the remainders that wait
  /// for their parents. Fronts are met children first, so the waiting remainders are a stack. One a thread, small
  /// enough to stay in its cache.
  struct Workspace {
    std::vector<Scalar> rest, panel, stack;
    std::size_t top = 0;
  };
  static std::size_t remainder_places(const Front& front);
  void reserve(Workspace& work) const;
  DenseFront<Scalar> assemble_front(std::size_t front, const double* values, Workspace& work);
  void add_entries(std::size_t front, const double* values, const DenseFront<Scalar>& to) const;
  static void add_remainder(const Front& child, const Scalar* remainder, const DenseFront<Scalar>& to);
  static void push_remainder(const Front& front, const DenseFront<Scalar>& dense, Workspace& work);
  DenseFront<Scalar> kept(std::size_t front) const;
  void solve_four(double* x) const;

  std::vector<int> order_;  // elimination position of each node
  std::vector<Front> fronts_;
  std::vector<std::vector<Entry>> entries_;  // one list a front
  std::vector<std::vector<Scalar>> values_;  // own columns of each front after factor(), see dense_front.h
  std::size_t largest_front_ = 0;            // rows
  std::size_t largest_rest_ = 0;             // columns that are not a front's own
  std::size_t deepest_stack_ = 0;            // places
  bool positive_ = false;
};

/// For the steps of a running simulation.
using BlockFactor = BlockFactorOf<float>;
/// For static solves to the last digits, and for comparison.
using ExactBlockFactor = BlockFactorOf<double>;

}  // namespace myotact::simulation
