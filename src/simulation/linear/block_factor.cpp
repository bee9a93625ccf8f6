#include "simulation/linear/block_factor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/OrderingMethods>

#include "core/at.h"
#include "core/error.h"

namespace myotact::simulation {
namespace {

/// A front joins the one above it when the zeros that this stores are below this share of the joint front's columns, or
/// when both are so small that bookkeeping would cost more than the zeros.
constexpr double kLargestZeroShare = 0.3;
constexpr int kSmallFront = 6;  // nodes

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
  for (int node = 0; node < pattern.nodes(); ++node) diagonals_.push_back(slot(node, node));
  place_entries(pattern);
}

template <class Scalar>
void BlockFactorOf<Scalar>::make_fronts(const std::vector<std::vector<int>>& neighbours) {
  const std::vector<int> parent = elimination_tree(neighbours);
  const Lists rows = column_structures(neighbours, parent);
  const int n = static_cast<int>(neighbours.size());
  front_of_.resize(at(n));
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
    front_of_[at(j)] = static_cast<int>(fronts_.size()) - 1;
  }
  std::size_t places = 0;
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    Front& front = fronts_[f];
    const std::size_t size = 3 * front.nodes.size();
    front.start = places;
    places += 3 * at(front.own) * (size + kFrontPadding);
    largest_front_ = std::max(largest_front_, size);
    if (at(front.own) == front.nodes.size()) continue;
    Front& above = fronts_[at(front_of_[at(front.nodes[at(front.own)])])];
    above.children.push_back(static_cast<int>(f));
    for (std::size_t k = at(front.own); k < front.nodes.size(); ++k) {
      const auto found = std::lower_bound(above.nodes.begin(), above.nodes.end(), front.nodes[k]);
      const int place = 3 * static_cast<int>(found - above.nodes.begin());
      const bool goes_on = !front.runs.empty() && front.runs.back().place + front.runs.back().count == place;
      if (!goes_on) front.runs.push_back({0, place});
      front.runs.back().count += 3;
    }
  }
  if (places > at(std::numeric_limits<int>::max())) {  // a slot's base is an int
    throw Error(ExitStatus::BadData, "mesh: its stiffness has a factor of " + std::to_string(places) +
                                         " numbers; must be below 2147483648: mesh coarser");
  }
  values_.assign(places, Scalar(0));
  find_depths();
}

template <class Scalar>
void BlockFactorOf<Scalar>::find_depths() {
  for (std::size_t f = fronts_.size(); f-- > 0;) {
    for (int child : fronts_[f].children) fronts_[at(child)].even = !fronts_[f].even;
  }
  Workspace empty;
  for (const Front& front : fronts_) {
    typename Workspace::Stack& stack = empty.stack_of(front);
    stack.top += remainder_places(front);
    std::size_t& most = stack_places_[front.even ? 0 : 1];
    most = std::max(most, stack.top);
    for (int child : front.children) empty.stack_of(fronts_[at(child)]).top -= remainder_places(fronts_[at(child)]);
  }
}

template <class Scalar>
void BlockFactorOf<Scalar>::place_entries(const BlockMatrix& pattern) {
  const Eigen::SparseMatrix<double>& lower = pattern.lower();
  for (int column = 0; column < pattern.nodes(); ++column) {
    for (int k = lower.outerIndexPtr()[3 * column]; k < lower.outerIndexPtr()[3 * column + 1]; k += 3) {
      const int row = lower.innerIndexPtr()[k] / 3;
      entries_.push_back({pattern.slot(row, column), slot(row, column), is_later(column, row)});
    }
  }
  std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) { return a.to.base < b.to.base; });
}

template <class Scalar>
void BlockFactorOf<Scalar>::set_zero() {
  std::fill(values_.begin(), values_.end(), Scalar(0));
}

template <class Scalar>
BlockSlot BlockFactorOf<Scalar>::slot(int a, int b) const {
  const int first = std::min(order_[at(a)], order_[at(b)]), second = std::max(order_[at(a)], order_[at(b)]);
  const Front& front = fronts_[at(front_of_[at(first)])];
  const auto place = [&front](int node) {
    return 3 * static_cast<int>(std::lower_bound(front.nodes.begin(), front.nodes.end(), node) - front.nodes.begin());
  };
  const int stride = 3 * static_cast<int>(front.nodes.size()) + kFrontPadding;
  return {static_cast<int>(front.start) + place(first) * stride + place(second), stride};
}

template <class Scalar>
void BlockFactorOf<Scalar>::add(int row, int column, const Mat3& block) {
  const BlockSlot where = slot(row, column);
  const bool transposed = is_later(column, row);
  Scalar* to = values_.data() + where.base;
  for (int j = 0; j < 3; ++j, to += where.stride) {
    for (int i = 0; i < 3; ++i) to[i] += static_cast<Scalar>(transposed ? block(j, i) : block(i, j));
  }
}

template <class Scalar>
void BlockFactorOf<Scalar>::add_diagonal(int node, double value) {
  const BlockSlot& where = diagonals_[at(node)];
  for (int i = 0; i < 3; ++i) values_[at(where.base + i * where.stride + i)] += static_cast<Scalar>(value);
}

/// Places of a front's remainder on a stack.
template <class Scalar>
std::size_t BlockFactorOf<Scalar>::remainder_places(const Front& front) {
  const std::size_t below = 3 * (front.nodes.size() - at(front.own));
  return below * (below + kFrontPadding);
}

template <class Scalar>
void BlockFactorOf<Scalar>::reserve(Workspace& work) const {
  work.panel.resize(std::max(work.panel.size(), kFrontPanel * (largest_front_ + kFrontPadding)));
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<Scalar>& places = work.stacks[k].places;
    places.resize(std::max(places.size(), stack_places_[k] + kFrontPadding));
    work.stacks[k].top = 0;
  }
}

template <class Scalar>
DenseFront<Scalar> BlockFactorOf<Scalar>::kept(std::size_t f) const {
  const int size = 3 * static_cast<int>(fronts_[f].nodes.size());
  // The values are this object's own; const callers only read them.
  return {const_cast<Scalar*>(values_.data() + fronts_[f].start), nullptr, size, 3 * fronts_[f].own};
}

/// The front before its elimination. Its own columns are where solve() finds them, the rest on top of its stack.
template <class Scalar>
DenseFront<Scalar> BlockFactorOf<Scalar>::assemble_front(std::size_t f, Workspace& work) {
  const Front& front = fronts_[f];
  typename Workspace::Stack& stack = work.stack_of(front);
  DenseFront<Scalar> to = kept(f);
  to.rest_values = stack.places.data() + stack.top;
  zero_remainder(to);
  stack.top += remainder_places(front);
  for (auto child = front.children.rbegin(); child != front.children.rend(); ++child) {
    const Front& below = fronts_[at(*child)];
    typename Workspace::Stack& from = work.stack_of(below);
    from.top -= remainder_places(below);
    add_remainder<Scalar>(from.places.data() + from.top, below.runs, to);
  }
  return to;
}

template <class Scalar>
bool BlockFactorOf<Scalar>::factor() {
  thread_local Workspace work;
  reserve(work);
  positive_ = true;
  for (std::size_t f = 0; f < fronts_.size(); ++f) {
    const Pivots pivots = eliminate_front(assemble_front(f, work), work.panel.data());
    if (pivots != Pivots::Positive) positive_ = false;
    if (pivots == Pivots::Unusable) return false;
  }
  return true;
}

template <class Scalar>
bool BlockFactorOf<Scalar>::factor(const BlockMatrix& matrix) {
  set_zero();
  const double* values = matrix.lower().valuePtr();
  for (const Entry& entry : entries_) {
    const double* block = values + entry.from.base;
    const std::ptrdiff_t down = entry.transposed ? entry.from.stride : 1,
                         across = entry.transposed ? 1 : entry.from.stride;
    Scalar* to = values_.data() + entry.to.base;
    for (int j = 0; j < 3; ++j, to += entry.to.stride) {
      for (int i = 0; i < 3; ++i) to[i] = static_cast<Scalar>(block[j * across + i * down]);
    }
  }
  return factor();
}

template <class Scalar>
template <std::size_t kSides>
void BlockFactorOf<Scalar>::solve_sides(Scalar* x) const {
  const std::size_t rows = 3 * order_.size();
  std::vector<Scalar> local(kSides * (largest_front_ + kFrontPadding));
  const auto sweep = [&](std::size_t f, auto&& solve_front) {
    const std::vector<int>& nodes = fronts_[f].nodes;
    const std::size_t stride = 3 * nodes.size() + kFrontPadding;
    for (std::size_t r = 0; r < kSides; ++r) {
      Scalar* place = local.data() + r * stride;
      for (int node : nodes) place = std::copy_n(x + r * rows + 3 * at(node), 3, place);
      std::fill_n(place, kFrontPadding, Scalar(0));
    }
    solve_front(kept(f), local.data());
    for (std::size_t r = 0; r < kSides; ++r) {
      const Scalar* from = local.data() + r * stride;
      for (int node : nodes) {
        std::copy_n(from, 3, x + r * rows + 3 * at(node));
        from += 3;
      }
    }
  };
  for (std::size_t f = 0; f < fronts_.size(); ++f) sweep(f, solve_forward<kSides, Scalar>);
  for (std::size_t f = fronts_.size(); f-- > 0;) sweep(f, solve_backward<kSides, Scalar>);
}

template <class Scalar>
template <std::size_t kSides>
void BlockFactorOf<Scalar>::solve_columns(const Eigen::MatrixXd& right, Eigen::Index first,
                                          Eigen::MatrixXd& result) const {
  const Eigen::Index nodes = right.rows() / 3, count = std::min<Eigen::Index>(kSides, right.cols() - first);
  std::vector<Scalar> sides(kSides * static_cast<std::size_t>(right.rows()));
  const auto place = [&](Eigen::Index node, Eigen::Index side) {
    return sides.data() + side * right.rows() + 3 * order_[static_cast<std::size_t>(node)];
  };
  for (Eigen::Index side = 0; side < count; ++side) {
    for (Eigen::Index node = 0; node < nodes; ++node) {
      for (int i = 0; i < 3; ++i) place(node, side)[i] = static_cast<Scalar>(right(3 * node + i, first + side));
    }
  }
  solve_sides<kSides>(sides.data());
  for (Eigen::Index side = 0; side < count; ++side) {
    for (Eigen::Index node = 0; node < nodes; ++node) {
      for (int i = 0; i < 3; ++i) result(3 * node + i, first + side) = static_cast<double>(place(node, side)[i]);
    }
  }
}

template <class Scalar>
Eigen::MatrixXd BlockFactorOf<Scalar>::solve(const Eigen::MatrixXd& right) const {
  Eigen::MatrixXd result(right.rows(), right.cols());
  for (Eigen::Index first = 0; first < right.cols(); first += kRightSides) {
    if (right.cols() - first == 1)
      solve_columns<1>(right, first, result);
    else
      solve_columns<kRightSides>(right, first, result);
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
