#include "prepare/part/hollow_out.h"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <utility>

#include "prepare/part/node_steps.h"

namespace myotact::prepare {

namespace {

class Hollowing {
 public:
  Hollowing(const std::array<int, 3>& counts, const std::vector<bool>& kept, const std::vector<float>& cost)
      : counts_(counts),
        kept_(kept),
        cost_(cost),
        steps_(counts),
        body_(kept.size(), true),
        waits_(kept.size(), false) {}

  std::vector<bool> run() {
    begin();
    while (!border_.empty()) {
      const std::size_t node = border_.top().second;
      border_.pop();
      waits_[node] = false;
      if (!is_simple(around(node))) continue;  // comes up again when something beside it goes
      body_[node] = false;
      for (const std::ptrdiff_t step : steps_.linked) reach(NodeSteps::go(node, step));
    }
    return std::move(body_);
  }

 private:
  void begin() {
    std::size_t node = 0;
    for (int z = 0; z < counts_[2]; ++z) {
      for (int y = 0; y < counts_[1]; ++y) {
        for (int x = 0; x < counts_[0]; ++x, ++node) {
          const int layer = std::min({x, y, z, counts_[0] - 1 - x, counts_[1] - 1 - y, counts_[2] - 1 - z});
          if (layer == 0) body_[node] = false;
          if (layer == 1) reach(node);
        }
      }
    }
  }

  void reach(std::size_t node) {
    if (!body_[node] || kept_[node] || waits_[node]) return;
    waits_[node] = true;
    border_.emplace(cost_[node], node);
  }

  Neighbourhood around(std::size_t node) const {
    Neighbourhood around = 0;
    for (std::size_t bit = 0; bit < steps_.block.size(); ++bit) {
      around |= Neighbourhood{body_[NodeSteps::go(node, steps_.block[bit])]} << bit;
    }
    return around;
  }

  std::array<int, 3> counts_;
  const std::vector<bool>& kept_;
  const std::vector<float>& cost_;
  NodeSteps steps_;
  std::vector<bool> body_, waits_;
  std::priority_queue<std::pair<float, std::size_t>> border_;
};

}  // namespace

std::vector<bool> hollow_out(const std::array<int, 3>& counts, const std::vector<bool>& kept,
                             const std::vector<float>& cost) {
  return Hollowing(counts, kept, cost).run();
}

}  // namespace myotact::prepare
