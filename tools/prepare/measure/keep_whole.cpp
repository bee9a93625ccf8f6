#include "prepare/measure/keep_whole.h"

#include <algorithm>
#include <set>

#include "prepare/part/hollow_out.h"
#include "prepare/part/node_pieces.h"
#include "prepare/part/node_steps.h"
#include "prepare/partition/point_box.h"

namespace myotact::prepare {

namespace {

/// Layers around a part that films may not reach; the outermost is outside for certain.
constexpr int kMargin = 2;
/// Pieces of fewer lattice points are specks that nothing need join.
constexpr std::size_t kSpeck = 6;
/// No film may cut more points than this off another muscle.
constexpr std::size_t kWorthKeeping = 30;
/// What a point is dearer by in bone or in another's film, which may not be taken: a film goes round that where the way
/// is short. If no film could be had but far from the muscle, the hole would better stay. And how far off points count
/// that lie in no band [steps].
constexpr float kForbidden = 3.0F, kFarOff = 20.0F;
/// Films and strands are as thick as a step.
constexpr double kFilmMargin = 0.5;
/// A film may pierce a part that was whole; a second round sees to that.
constexpr int kRounds = 2;

using Points = std::vector<std::size_t>;

class Mender {
 public:
  Mender(PartVolume& volume, const std::vector<Claim>& claims)
      : volume_(volume),
        claims_(claims),
        steps_(volume.lattice.counts),
        film_(volume.labels.size(), false),
        wholeness_(claims.size()) {}

  /// Whether anything had to be added.
  bool mend(std::size_t part) {
    const PointBox box = box_around(claims_[part].samples, volume_.lattice, kMargin);
    if (box.size() == 0) return false;
    std::vector<bool> kept(box.size(), false);
    for (const Points& piece : pieces_of_nodes(box.counts, marked(part, box))) {
      if (piece.size() < kSpeck && std::find(kept.begin(), kept.end(), true) != kept.end()) break;
      for (const std::size_t point : piece) kept[point] = true;
    }
    const std::vector<bool> whole = hollow_out(box.counts, kept, costs(part, box));
    std::vector<bool> missing(box.size(), false);
    for (std::size_t point = 0; point < whole.size(); ++point) missing[point] = whole[point] && !kept[point];
    bool added = false;
    for (Points& film : pieces_of_nodes(box.counts, missing)) {
      for (std::size_t& point : film) point = box.to_lattice(point);
      added |= add(part, film);
    }
    return added;
  }

  /// Gives all pieces but the largest to whoever claims them most.
  void drop_specks(std::size_t part) {
    const PointBox box = box_around(claims_[part].samples, volume_.lattice, kMargin);
    if (box.size() == 0) return;
    const std::vector<Points> pieces = pieces_of_nodes(box.counts, marked(part, box));
    Points loose;
    for (std::size_t i = 1; i < pieces.size(); ++i) {
      for (const std::size_t point : pieces[i]) loose.push_back(box.to_lattice(point));
    }
    wholeness_[part].dropped += loose.size();
    std::sort(loose.begin(), loose.end());
    for (const std::size_t point : loose) give(point, next_of(part, point));
  }

  std::vector<Wholeness> take() { return std::move(wholeness_); }

 private:
  std::uint16_t label(std::size_t part) const { return static_cast<std::uint16_t>(part + 1); }

  std::vector<bool> marked(std::size_t part, const PointBox& box) const {
    std::vector<bool> marked(box.size(), false);
    for (const DepthSample& sample : claims_[part].samples) {
      if (volume_.labels[sample.point] == label(part)) marked[box.to_box(sample.point)] = true;
    }
    return marked;
  }

  bool forbidden(std::size_t part, std::size_t point) const {
    const std::uint16_t owner = volume_.labels[point];
    if (owner == 0 || owner == label(part)) return false;
    return film_[point] || claims_[owner - std::size_t{1}].bone;
  }

  /// How unwelcome film is: little inside the muscle's own surface, more outside.
  std::vector<float> costs(std::size_t part, const PointBox& box) const {
    std::vector<float> costs(box.size(), kFarOff);
    for (const DepthSample& sample : claims_[part].samples) costs[box.to_box(sample.point)] = -sample.depth;
    for (std::size_t point = 0; point < costs.size(); ++point) {
      if (forbidden(part, box.to_lattice(point))) costs[point] += kForbidden;
    }
    return costs;
  }

  /// The owners of a film's points that would be cut in two without them.
  std::set<std::uint16_t> cut_by(std::size_t part, const Points& film) const {
    std::set<std::uint16_t> owners;
    for (const std::size_t point : film) {
      if (!forbidden(part, point) && volume_.labels[point] != 0) owners.insert(volume_.labels[point]);
    }
    owners.erase(label(part));
    std::erase_if(owners, [&](std::uint16_t owner) { return !is_cut(owner - std::size_t{1}, film); });
    return owners;
  }

  bool is_cut(std::size_t owner, const Points& film) const {
    const PointBox box = box_around(claims_[owner].samples, volume_.lattice, kMargin);
    std::vector<bool> left = marked(owner, box);
    const std::size_t before = second_piece(pieces_of_nodes(box.counts, left));
    for (const std::size_t point : film) {
      if (volume_.labels[point] == label(owner)) left[box.to_box(point)] = false;
    }
    return second_piece(pieces_of_nodes(box.counts, left)) >= std::max(kWorthKeeping, before + 1);
  }

  static std::size_t second_piece(const std::vector<Points>& pieces) {
    return pieces.size() < 2 ? 0 : pieces[1].size();
  }

  bool add(std::size_t part, const Points& film) {
    const std::set<std::uint16_t> cut = cut_by(part, film);
    bool added = false;
    for (const std::size_t point : film) {
      if (forbidden(part, point) || cut.contains(volume_.labels[point])) continue;
      film_[point] = true;
      give(point, label(part));
      ++wholeness_[part].added;
      added = true;
    }
    return added;
  }

  void give(std::size_t point, std::uint16_t owner) {
    volume_.labels[point] = owner;
    const auto margin = static_cast<std::uint8_t>(kFilmMargin * kMarginsPerStep);
    volume_.margins[point] = margin;
    for (const std::ptrdiff_t step : steps_.linked) {
      const std::size_t next = NodeSteps::go(point, step);
      if (volume_.labels[next] != owner) volume_.margins[next] = std::min(volume_.margins[next], margin);
    }
  }

  /// The label of the part, besides this one, in which the point lies deepest, among those that touch it; 0: none.
  std::uint16_t next_of(std::size_t part, std::size_t point) const {
    std::uint16_t best = 0;
    float deepest = 0.0F;
    for (const std::ptrdiff_t step : steps_.linked) {
      const std::uint16_t owner = volume_.labels[NodeSteps::go(point, step)];
      if (owner == 0 || owner == label(part) || owner == best) continue;
      const float depth = depth_in(claims_[owner - std::size_t{1}], point);
      if (depth > deepest) best = owner, deepest = depth;
    }
    return best;
  }

  static float depth_in(const Claim& claim, std::size_t point) {
    const auto found = std::lower_bound(claim.samples.begin(), claim.samples.end(), point,
                                        [](const DepthSample& sample, std::size_t p) { return sample.point < p; });
    return found != claim.samples.end() && found->point == point ? found->depth : -1.0F;
  }

  PartVolume& volume_;
  const std::vector<Claim>& claims_;
  NodeSteps steps_;
  std::vector<bool> film_;
  std::vector<Wholeness> wholeness_;
};

}  // namespace

std::vector<Wholeness> keep_whole(PartVolume& volume, const std::vector<Claim>& claims, const std::vector<int>& genus) {
  std::vector<std::size_t> muscles;
  for (std::size_t c = 0; c < claims.size(); ++c) {
    if (!claims[c].bone && genus[c] == 0) muscles.push_back(c);
  }
  std::stable_sort(muscles.begin(), muscles.end(),
                   [&](std::size_t a, std::size_t b) { return claims[a].samples.size() < claims[b].samples.size(); });
  Mender mender(volume, claims);
  bool changed = true;
  for (int round = 0; round < kRounds && changed; ++round) {
    changed = false;
    for (const std::size_t muscle : muscles) changed |= mender.mend(muscle);
  }
  for (std::size_t c = 0; c < claims.size(); ++c) mender.drop_specks(c);
  return mender.take();
}

}  // namespace myotact::prepare
