#include <algorithm>
#include <numeric>

#include "prepare/repair/soup.h"
#include "prepare/surface/edge_table.h"

namespace myotact::prepare {

void drop_flat_triangles(RepairJob& job) {
  std::vector<bool> keep;
  int flat = 0;
  Vec3 place = Vec3::Zero();
  for (int t = 0; t < static_cast<int>(job.mesh.triangles.size()); ++t) {
    keep.push_back(least_height(job.mesh, t) > kSame);
    if (keep.back()) continue;
    if (flat++ == 0) place = centroid(job.mesh, t);
  }
  if (flat == 0) return;
  keep_triangles(job, keep, Dropped::StillCovered);
  note(job, "triangles without area dropped", flat, place);
  if (job.mesh.triangles.empty()) {
    throw refusal(job, "encloses nothing: no triangle has an area, the first of them at {}. Export it again", place);
  }
}

void drop_copies(RepairJob& job) {
  std::vector<std::array<int, 3>> corners = job.mesh.triangles;
  for (auto& triangle : corners) std::sort(triangle.begin(), triangle.end());
  std::vector<int> order(corners.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return corners[at(a)] != corners[at(b)] ? corners[at(a)] < corners[at(b)] : a < b; });
  std::vector<bool> keep(corners.size(), true);
  int copies = 0;
  int first = order.empty() ? -1 : order.front();
  Vec3 place = Vec3::Zero();
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (corners[at(order[i])] != corners[at(order[i - 1])]) {
      first = order[i];
      continue;
    }
    keep[at(order[i])] = false;
    job.copies.emplace_back(job.face_source[at(order[i])], job.face_source[at(first)]);
    if (copies++ == 0) place = centroid(job.mesh, order[i]);
  }
  if (copies == 0) return;
  keep_triangles(job, keep, Dropped::StillCovered);
  note(job, "copies of triangles dropped", copies, place);
}

namespace {

/// Goes from triangle to neighbour and finds those that must be flipped.
class Winder {
 public:
  explicit Winder(const RepairJob& job)
      : job_(job), opposite_(opposite_sides(job.mesh)), flip_(job.mesh.triangles.size(), 0) {}

  std::vector<int> triangles_to_flip() {
    for (std::size_t seed = 0; seed < flip_.size(); ++seed) {
      if (flip_[seed] == 0) flood(static_cast<int>(seed));
    }
    return std::move(flipped_);
  }

 private:
  void flood(int seed) {
    flip_[at(seed)] = 1;
    std::vector<int> region{seed}, against;
    for (std::size_t next = 0; next < region.size(); ++next) {
      const int here = region[next];
      if (flip_[at(here)] < 0) against.push_back(here);
      for (int side = 3 * here; side < 3 * here + 3; ++side) cross(side, region);
    }
    if (2 * against.size() <= region.size()) {
      flipped_.insert(flipped_.end(), against.begin(), against.end());
      return;
    }
    for (const int t : region) {  // most lie the other way: flip the fewer
      if (flip_[at(t)] > 0) flipped_.push_back(t);
    }
  }

  /// A neighbour met for the first time joins the region.
  void cross(int side, std::vector<int>& region) {
    const int other = opposite_[at(side)];
    if (other < 0) return;
    const bool alike = tail_of(job_.mesh, side) == head_of(job_.mesh, other);
    const int wanted = alike ? flip_[at(side / 3)] : -flip_[at(side / 3)];
    signed char& there = flip_[at(other / 3)];
    if (there == 0) region.push_back(other / 3);
    if (there == -wanted) {
      throw refusal(job_,
                    "has only one side (like a Moebius strip), so it encloses nothing: going round it near {} ends on "
                    "the back. Cut it there and export it again",
                    centroid(job_.mesh, side / 3));
    }
    there = static_cast<signed char>(wanted);
  }

  const RepairJob& job_;
  std::vector<int> opposite_;
  std::vector<signed char> flip_;  // 0: not met; 1: as it is; -1: to be flipped
  std::vector<int> flipped_;
};

}  // namespace

void wind_alike(RepairJob& job) {
  const std::vector<int> flipped = Winder(job).triangles_to_flip();
  if (flipped.empty()) return;
  for (const int t : flipped) std::swap(job.mesh.triangles[at(t)][1], job.mesh.triangles[at(t)][2]);
  note(job, "triangles flipped to their neighbours' side", static_cast<int>(flipped.size()),
       centroid(job.mesh, flipped.front()));
}

}  // namespace myotact::prepare
