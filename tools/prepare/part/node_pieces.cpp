#include "prepare/part/node_pieces.h"

#include <algorithm>

#include "prepare/part/node_steps.h"

namespace myotact::prepare {

std::vector<std::vector<std::size_t>> pieces_of_nodes(const std::array<int, 3>& counts,
                                                      const std::vector<bool>& marked) {
  const NodeSteps steps(counts);
  std::vector<bool> seen(marked.size(), false);
  std::vector<std::vector<std::size_t>> pieces;
  for (std::size_t start = 0; start < marked.size(); ++start) {
    if (!marked[start] || seen[start]) continue;
    std::vector<std::size_t>& piece = pieces.emplace_back(1, start);
    seen[start] = true;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (const std::ptrdiff_t step : steps.linked) {
        const std::size_t next = NodeSteps::go(piece[i], step);
        if (!marked[next] || seen[next]) continue;
        seen[next] = true;
        piece.push_back(next);
      }
    }
  }
  std::stable_sort(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return pieces;
}

}  // namespace myotact::prepare
