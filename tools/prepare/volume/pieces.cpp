#include "prepare/volume/pieces.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

/// Runs of a layer that are looked at; a limb has some 10 a row. 1 GB at most.
constexpr std::size_t kMostRuns = std::size_t{1} << 26;

/// Points of one label side by side along x.
struct Run {
  std::uint32_t begin, end;  // x
  std::uint32_t parent;      // index of a run of the same piece, an earlier one or itself
  std::uint16_t label;
};

class Pieces {
 public:
  Pieces(const Labels& labels, const Lattice& lattice) {
    const std::size_t nx = at(lattice.counts[0]), ny = at(lattice.counts[1]), nz = at(lattice.counts[2]);
    row_ends_.push_back(0);
    for (std::size_t row = 0; row < ny * nz && counted_; ++row) {
      add_row(labels.data() + row * nx, nx);
      if (row % ny != 0) join_rows(row, row - 1);
      if (row >= ny) join_rows(row, row - ny);
      if (row % ny != 0 && row >= ny) join_rows(row, row - ny - 1);
    }
  }

  bool counted() const { return counted_; }

  /// Label -> sizes of its pieces [points], the largest first.
  std::map<int, std::vector<std::size_t>> sizes() {
    std::vector<std::size_t> points(runs_.size(), 0);
    for (std::uint32_t r = 0; r < runs_.size(); ++r) points[root(r)] += runs_[r].end - runs_[r].begin;
    std::map<int, std::vector<std::size_t>> sizes;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      if (points[r] > 0) sizes[runs_[r].label].push_back(points[r]);
    }
    for (auto& [label, pieces] : sizes) std::sort(pieces.begin(), pieces.end(), std::greater<>());
    return sizes;
  }

 private:
  void add_row(const std::uint16_t* labels, std::size_t nx) {
    for (std::size_t x = 0; x < nx;) {
      const std::size_t begin = x;
      while (x < nx && labels[x] == labels[begin]) ++x;
      if (labels[begin] == 0) continue;
      const auto index = static_cast<std::uint32_t>(runs_.size());
      runs_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(x), index, labels[begin]});
    }
    row_ends_.push_back(static_cast<std::uint32_t>(runs_.size()));
    counted_ = runs_.size() < kMostRuns;
  }

  /// With an earlier row, whose points at the same x and one before have an edge to those of this one (kLink).
  void join_rows(std::size_t row, std::size_t other) {
    std::uint32_t a = row_ends_[row], b = row_ends_[other];
    while (a < row_ends_[row + 1] && b < row_ends_[other + 1]) {
      const bool touch = runs_[a].begin <= runs_[b].end && runs_[b].begin < runs_[a].end;
      if (touch && runs_[a].label == runs_[b].label) join(a, b);
      if (runs_[a].end <= runs_[b].end) {
        ++a;
      } else {
        ++b;
      }
    }
  }

  std::uint32_t root(std::uint32_t run) {
    while (runs_[run].parent != run) {
      runs_[run].parent = runs_[runs_[run].parent].parent;
      run = runs_[run].parent;
    }
    return run;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    runs_[std::max(a, b)].parent = std::min(a, b);
  }

  std::vector<Run> runs_;
  std::vector<std::uint32_t> row_ends_;  // of row r: runs row_ends_[r] .. row_ends_[r + 1]
  bool counted_ = true;
};

std::string note_of(const std::string& name, const std::vector<std::size_t>& pieces) {
  constexpr std::size_t kListed = 5;
  std::vector<std::string> sizes;
  for (std::size_t i = 0; i < std::min(pieces.size(), kListed); ++i) sizes.push_back(std::to_string(pieces[i]));
  if (pieces.size() > kListed) sizes.emplace_back("...");
  return fmt::format("segment \"{}\" is in {} pieces of {} points that do not touch: one is kept, the largest", name,
                     pieces.size(), join(sizes));
}

}  // namespace

std::vector<std::string> piece_notes(const LabelVolume& volume) {
  std::vector<std::string> notes;
  for (std::size_t layer = 0; layer < volume.layers.size(); ++layer) {
    Pieces pieces(volume.layers[layer], volume.lattice);
    if (!pieces.counted()) continue;
    const auto sizes = pieces.sizes();
    for (const Segment& segment : volume.segments) {
      if (segment.layer != static_cast<int>(layer)) continue;
      const auto found = sizes.find(segment.label);
      if (found != sizes.end() && found->second.size() > 1) notes.push_back(note_of(segment.name, found->second));
    }
  }
  return notes;
}

}  // namespace myotact::prepare
