#include "simulation/block_factor.h"

#include <algorithm>
#include <cmath>

#include <Eigen/OrderingMethods>

namespace myotact::simulation {
namespace {

/// A front joins the one above it when the zeros that this stores are below this share of the joint front's columns, or
/// when both are so small that bookkeeping would cost more than the zeros.
constexpr double kLargestZeroShare = 0.3;
constexpr int kSmallFront = 6;  // nodes

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

using Lists = std::vector<std::vector<int>>;

/// Neighbours of each node, both ways, from the stored lower blocks.
Lists neighbours_of(const BlockMatrix& matrix) {
  Lists neighbours(at(matrix.nodes()));
  const Eigen::SparseMatrix<double>& lower = matrix.lower();
  for (int column = 0; column < matrix.nodes(); ++column) {
    for (int k = lower.outerIndexPtr()[3 * column]; k < lower.outerIndexPtr()[3 * column + 1]; k += 3) {
      const int row = lower.innerIndexPtr()[k] / 3;
      if (row == column) continue;
      neighbours[at(column)].push_back(row);
      neighbours[at(row)].push_back(column);
    }
  }
  return neighbours;
}

/// Position of each node in a minimum-degree order.
std::vector<int> minimum_degree(const Lists& neighbours) {
  const int n = static_cast<int>(neighbours.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < n; ++node) {
    entries.emplace_back(node, node, 1.0);
    for (int other : neighbours[at(node)]) entries.emplace_back(other, node, 1.0);
  }
  Eigen::SparseMatrix<double> graph(n, n);
  graph.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
  Eigen::AMDOrdering<int>()(graph, permutation);
  std::vector<int> position(at(n));
  for (int k = 0; k < n; ++k) position[at(permutation.indices()[k])] = k;
  return position;
}

Lists renumbered(const Lists& neighbours, const std::vector<int>& position) {
  Lists result(neighbours.size());
  for (std::size_t node = 0; node < neighbours.size(); ++node) {
    for (int other : neighbours[node]) result[at(position[node])].push_back(position[at(other)]);
  }
  return result;
}

/// Parent of each column in the elimination tree (Liu 1990, with path compression); -1 for a root.
std::vector<int> elimination_tree(const Lists& neighbours) {
  std::vector<int> parent(neighbours.size(), -1), ancestor(neighbours.size(), -1);
  for (int j = 0; j < static_cast<int>(neighbours.size()); ++j) {
    for (int i : neighbours[at(j)]) {
      while (i >= 0 && i < j) {
        const int next = ancestor[at(i)];
        ancestor[at(i)] = j;
        if (next < 0) parent[at(i)] = j;
        i = next;
      }
    }
  }
  return parent;
}

/// Positions that put every column right after its last descendant.
std::vector<int> postorder(const std::vector<int>& parent) {
  const int n = static_cast<int>(parent.size());
  Lists children(parent.size());
  std::vector<int> stack;
  for (int j = n - 1; j >= 0; --j) {
    if (parent[at(j)] >= 0)
      children[at(parent[at(j)])].push_back(j);
    else
      stack.push_back(j);
  }
  std::vector<int> position(parent.size());
  int next = n;  // parents are met before their children: number from the end
  while (!stack.empty()) {
    const int j = stack.back();
    stack.pop_back();
    position[at(j)] = --next;
    stack.insert(stack.end(), children[at(j)].begin(), children[at(j)].end());
  }
  return position;
}

/// Rows below the diagonal of each column of L, rising.
Lists column_structures(const Lists& neighbours, const std::vector<int>& parent) {
  Lists rows(neighbours.size());
  for (int j = 0; j < static_cast<int>(neighbours.size()); ++j) {
    for (int i : neighbours[at(j)]) {
      if (i > j) rows[at(j)].push_back(i);
    }
  }
  for (int j = 0; j < static_cast<int>(neighbours.size()); ++j) {
    std::vector<int>& own = rows[at(j)];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    if (parent[at(j)] < 0) continue;
    std::vector<int>& above = rows[at(parent[at(j)])];
    std::copy_if(own.begin(), own.end(), std::back_inserter(above), [&](int i) { return i > parent[at(j)]; });
  }
  return rows;
}

}  // namespace

template <class Scalar>
BlockFactorOf<Scalar>::BlockFactorOf(const BlockMatrix& pattern) {
  Lists neighbours = neighbours_of(pattern);
  order_ = minimum_degree(neighbours);
  const std::vector<int> post = postorder(elimination_tree(renumbered(neighbours, order_)));
  for (int& position : order_) position = post[at(position)];
  neighbours = renumbered(neighbours, order_);
  make_fronts(neighbours);
  place_entries(pattern);
}

template <class Scalar>
void BlockFactorOf<Scalar>::make_fronts(const std::vector<std::vector<int>>& neighbours) {
  const std::vector<int> parent = elimination_tree(neighbours);
  const Lists rows = column_structures(neighbours, parent);
  const int n = static_cast<int>(neighbours.size());
  std::vector<int> front_of(at(n));
  int zeros = 0;  // stored in the front being grown, in blocks
  for (int j = 0; j < n; ++j) {
    const int below = static_cast<int>(rows[at(j)].size());
    bool joins = j > 0 && parent[at(j - 1)] == j;
    if (joins) {
      const Front& last = fronts_.back();
      const int extra = below + 1 - static_cast<int>(rows[at(j - 1)].size());  // rows that the columns so far lack
      const int more = zeros + extra * last.own;
      const int stored = (last.own + 1) * (last.own + 1 + below);
      joins = extra == 0 || more < kLargestZeroShare * stored || last.own + 1 + below <= kSmallFront;
      if (joins) zeros = more;
    }
    if (!joins) {
      fronts_.push_back({});
      zeros = 0;
    }
    Front& front = fronts_.back();
    front.nodes.resize(at(front.own));
    front.nodes.push_back(j);
    ++front.own;
    front.nodes.insert(front.nodes.end(), rows[at(j)].begin(), rows[at(j)].end());
    front_of[at(j)] = static_cast<int>(fronts_.size()) - 1;
  }
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    Front& front = fronts_[f];
    const std::size_t size = 3 * front.nodes.size();
    values_.emplace_back(3 * at(front.own) * (size + kFrontPadding), Scalar(0));
    largest_front_ = std::max(largest_front_, size);
    largest_rest_ = std::max(largest_rest_, size - 3 * at(front.own));
    if (at(front.own) == front.nodes.size()) continue;
    Front& above = fronts_[at(front_of[at(front.nodes[at(front.own)])])];
    above.children.push_back(static_cast<int>(f));
    for (std::size_t k = at(front.own); k < front.nodes.size(); ++k) {
      const auto found = std::lower_bound(above.nodes.begin(), above.nodes.end(), front.nodes[k]);
      const int place = static_cast<int>(found - above.nodes.begin());
      const bool goes_on = !front.runs.empty() && front.runs.back().place + front.runs.back().count == place;
      if (!goes_on) front.runs.push_back({0, place});
      ++front.runs.back().count;
    }
  }
  std::size_t top = 0;
  for (const Front& front : fronts_) {
    for (int child : front.children) top -= remainder_places(fronts_[at(child)]);
    top += remainder_places(front);
    deepest_stack_ = std::max(deepest_stack_, top);
  }
}

template <class Scalar>
void BlockFactorOf<Scalar>::place_entries(const BlockMatrix& pattern) {
  std::vector<int> front_of(order_.size());
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    for (int k = 0; k < fronts_[f].own; ++k) front_of[at(fronts_[f].nodes[at(k)])] = static_cast<int>(f);
  }
  entries_.resize(fronts_.size());
  const Eigen::SparseMatrix<double>& lower = pattern.lower();
  for (int column = 0; column < pattern.nodes(); ++column) {
    for (int k = lower.outerIndexPtr()[3 * column]; k < lower.outerIndexPtr()[3 * column + 1]; k += 3) {
      const int row = lower.innerIndexPtr()[k] / 3;
      const int p = order_[at(row)], q = order_[at(column)];
      const int first = std::min(p, q), second = std::max(p, q);
      const std::size_t f = at(front_of[at(first)]);
      const std::vector<int>& nodes = fronts_[f].nodes;
      const auto place = [&](int node) {
        return static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
      };
      entries_[f].push_back({pattern.slot(row, column), place(second), place(first), p < q});
    }
  }
}

/// Places of a front's remainder on the stack: its lower triangle, column after column.
template <class Scalar>
std::size_t BlockFactorOf<Scalar>::remainder_places(const Front& front) {
  const std::size_t below = 3 * (front.nodes.size() - at(front.own));
  return below * (below + 1) / 2;
}

template <class Scalar>
void BlockFactorOf<Scalar>::reserve(Workspace& work) const {
  const std::size_t stride = largest_front_ + kFrontPadding;
  work.rest.resize(std::max(work.rest.size(), largest_rest_ * stride));
  work.panel.resize(std::max(work.panel.size(), kFrontPanel * stride));
  work.stack.resize(std::max(work.stack.size(), deepest_stack_));
  work.top = 0;
}

template <class Scalar>
DenseFront<Scalar> BlockFactorOf<Scalar>::kept(std::size_t f) const {
  const int size = 3 * static_cast<int>(fronts_[f].nodes.size());
  // The values are this object's own; const callers only read them.
  return {const_cast<Scalar*>(values_[f].data()), nullptr, size + kFrontPadding, size, 3 * fronts_[f].own};
}

/// Adds the matrix's own blocks.
template <class Scalar>
void BlockFactorOf<Scalar>::add_entries(std::size_t f, const double* values, const DenseFront<Scalar>& to) const {
  for (const Entry& entry : entries_[f]) {
    const double* block = values + entry.slot.base;
    for (int j = 0; j < 3; ++j) {
      Scalar* column = to.column(3 * entry.column + j) + 3 * entry.row;
      for (int i = 0; i < 3; ++i) {
        column[i] +=
            static_cast<Scalar>(entry.transposed ? block[i * entry.slot.stride + j] : block[j * entry.slot.stride + i]);
      }
    }
  }
}

/// Adds a child's packed lower triangle, column after column.
template <class Scalar>
void BlockFactorOf<Scalar>::add_remainder(const Front& child, const Scalar* remainder, const DenseFront<Scalar>& to) {
  const auto add_rows = [&remainder](Scalar* rows, int count) {
    for (int i = 0; i < count; ++i) rows[i] += remainder[i];
    remainder += count;
  };
  for (auto run = child.runs.begin(); run != child.runs.end(); ++run) {
    for (int j = 0; j < 3 * run->count; ++j) {
      Scalar* column = to.column(3 * run->place + j);
      add_rows(column + 3 * run->place + j, 3 * run->count - j);
      for (auto below = run + 1; below != child.runs.end(); ++below)
        add_rows(column + 3 * below->place, 3 * below->count);
    }
  }
}

/// The front before its elimination. Its own columns are where solve() finds them, the rest in the workspace.
template <class Scalar>
DenseFront<Scalar> BlockFactorOf<Scalar>::assemble_front(std::size_t f, const double* values, Workspace& work) {
  DenseFront<Scalar> to = kept(f);
  to.rest_values = work.rest.data();
  for (int c = 0; c < to.size; ++c) std::fill(to.column(c) + c, to.column(c) + to.size, Scalar(0));
  add_entries(f, values, to);
  const std::vector<int>& children = fronts_[f].children;
  for (auto child = children.rbegin(); child != children.rend(); ++child) {
    work.top -= remainder_places(fronts_[at(*child)]);
    add_remainder(fronts_[at(*child)], work.stack.data() + work.top, to);
  }
  return to;
}

template <class Scalar>
void BlockFactorOf<Scalar>::push_remainder(const Front& front, const DenseFront<Scalar>& dense, Workspace& work) {
  Scalar* stack = work.stack.data() + work.top;
  for (int c = dense.own; c < dense.size; ++c) {
    stack = std::copy(dense.column(c) + c, dense.column(c) + dense.size, stack);
  }
  work.top += remainder_places(front);
}

template <class Scalar>
bool BlockFactorOf<Scalar>::factor(const BlockMatrix& matrix) {
  thread_local Workspace work;
  reserve(work);
  positive_ = true;
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    const DenseFront<Scalar> dense = assemble_front(f, matrix.lower().valuePtr(), work);
    const Pivots pivots = eliminate_front(dense, work.panel.data());
    if (pivots != Pivots::Positive) positive_ = false;
    if (pivots == Pivots::Unusable) return false;
    push_remainder(fronts_[f], dense, work);
  }
  return true;
}

/// Four right sides side by side, in elimination order, become the solutions.
template <class Scalar>
void BlockFactorOf<Scalar>::solve_four(double* x) const {
  constexpr std::ptrdiff_t kNode = 4 * 3;  // numbers a node
  std::vector<double> local(4 * largest_front_);
  const auto sweep = [&](const Front& front, auto&& solve_front) {
    double* place = local.data();
    for (int node : front.nodes) place = std::copy_n(x + kNode * node, kNode, place);
    solve_front(local.data());
    const double* from = local.data();
    for (int node : front.nodes) {
      std::copy_n(from, kNode, x + kNode * node);
      from += kNode;
    }
  };
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    sweep(fronts_[f], [this, f](double* values) { solve_forward(kept(f), values); });
  }
  for (std::size_t f = fronts_.size(); f-- > 0;) {
    sweep(fronts_[f], [this, f](double* values) { solve_backward(kept(f), values); });
  }
}

template <class Scalar>
Eigen::MatrixXd BlockFactorOf<Scalar>::solve(const Eigen::MatrixXd& right) const {
  Eigen::MatrixXd result(right.rows(), right.cols());
  std::vector<double> four(4 * 3 * order_.size());
  for (Eigen::Index first = 0; first < right.cols(); first += 4) {
    const Eigen::Index count = std::min<Eigen::Index>(4, right.cols() - first);
    std::fill(four.begin(), four.end(), 0.0);
    const auto place = [&](Eigen::Index row, Eigen::Index column) -> double& {
      return four[at(4 * (3 * order_[static_cast<std::size_t>(row / 3)] + static_cast<int>(row % 3)) +
                     static_cast<int>(column))];
    };
    for (Eigen::Index c = 0; c < count; ++c) {
      for (Eigen::Index row = 0; row < right.rows(); ++row) place(row, c) = right(row, first + c);
    }
    solve_four(four.data());
    for (Eigen::Index c = 0; c < count; ++c) {
      for (Eigen::Index row = 0; row < right.rows(); ++row) result(row, first + c) = place(row, c);
    }
  }
  return result;
}

template <class Scalar>
Eigen::MatrixXd BlockFactorOf<Scalar>::solve_refined(const BlockMatrix& matrix, const Eigen::MatrixXd& right) const {
  Eigen::MatrixXd solution = solve(right);
  const Eigen::MatrixXd residual = right - matrix.lower().selfadjointView<Eigen::Lower>() * solution;
  solution += solve(residual);
  return solution;
}

template class BlockFactorOf<float>;
template class BlockFactorOf<double>;

}  // namespace myotact::simulation
