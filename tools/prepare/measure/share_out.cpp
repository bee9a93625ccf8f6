#include "prepare/measure/share_out.h"

#include <algorithm>
#include <cmath>

namespace myotact::prepare {

namespace {

/// What a muscle is favoured by in a round, as a part of its thickness, and how many rounds there are: all of the
/// thickness in the end.
constexpr double kFavour = 0.05;
constexpr int kRounds = 20;

/// One body's claim to one point.
struct Bid {
  std::uint32_t point;
  std::uint32_t part;
  float depth, radius;
};

/// All bids, those for one point side by side.
class Auction {
 public:
  explicit Auction(const std::vector<Claim>& claims) : claims_(claims), favour_(claims.size(), 0.0) {
    std::size_t count = 0;
    for (const Claim& claim : claims) count += claim.samples.size();
    bids_.reserve(count);
    for (std::size_t c = 0; c < claims.size(); ++c) {
      for (const DepthSample& s : claims[c].samples) {
        bids_.push_back({s.point, static_cast<std::uint32_t>(c), s.depth, s.radius});
      }
    }
    std::sort(bids_.begin(), bids_.end(),
              [](const Bid& a, const Bid& b) { return a.point != b.point ? a.point < b.point : a.part < b.part; });
  }

  /// Calls visit(first, last) for the bids of each point.
  template <class Visit>
  void for_each_point(Visit&& visit) const {
    for (auto first = bids_.begin(); first != bids_.end();) {
      auto last = first;
      while (last != bids_.end() && last->point == first->point) ++last;
      visit(first, last);
      first = last;
    }
  }

  double score(const Bid& bid) const {
    return static_cast<double>(bid.depth / bid.radius) + (bid.depth > 0.0F ? favour_[bid.part] : 0.0);
  }

  /// The best bid from inside a body; `last` when there is none.
  template <class Bids>
  Bids winner(Bids first, Bids last) const {
    Bids best = last;
    for (Bids bid = first; bid != last; ++bid) {
      if (bid->depth <= 0.0F) continue;
      if (best == last || beats(*bid, *best)) best = bid;
    }
    return best;
  }

  /// How far the point is from the border of the bid that won it [steps]. Along the way from one muscle's middle to
  /// another's the scores change by 1 / radius a step each.
  template <class Bids>
  double margin(Bids first, Bids last, Bids won) const {
    double margin = kLargestMargin;
    if (won == last) {
      for (Bids bid = first; bid != last; ++bid) margin = std::min(margin, -static_cast<double>(bid->depth));
      return margin;
    }
    margin = std::min(margin, static_cast<double>(won->depth));
    for (Bids bid = first; bid != last; ++bid) {
      if (bid != won) margin = std::min(margin, margin_against(*won, *bid));
    }
    return std::max(margin, 0.0);
  }

  std::vector<Share> count_shares() const {
    std::vector<Share> shares(claims_.size());
    for_each_point([&](auto first, auto last) {
      const auto won = winner(first, last);
      for (auto bid = first; bid != last; ++bid) {
        if (bid->depth <= 0.0F) continue;
        ++shares[bid->part].claimed;
        if (claims_[won->part].bone && !claims_[bid->part].bone) ++shares[bid->part].in_bone;
      }
      if (won != last) ++shares[won->part].kept;
    });
    return shares;
  }

  /// Favours those that keep too little. False: all keep enough, or nobody can be favoured more.
  bool favour_the_starved(const std::vector<Share>& shares) {
    bool changed = false;
    for (std::size_t c = 0; c < claims_.size(); ++c) {
      const auto left = static_cast<double>(shares[c].claimed - shares[c].in_bone);
      if (claims_[c].bone || static_cast<double>(shares[c].kept) >= kLeastShare * left) continue;
      favour_[c] += kFavour;
      changed = true;
    }
    return changed;
  }

 private:
  bool beats(const Bid& a, const Bid& b) const {
    const bool bone = claims_[a.part].bone;
    if (bone != claims_[b.part].bone) return bone;
    return bone ? a.depth > b.depth : score(a) > score(b);
  }

  double margin_against(const Bid& won, const Bid& other) const {
    const auto depth = static_cast<double>(won.depth), other_depth = static_cast<double>(other.depth);
    if (claims_[other.part].bone) return claims_[won.part].bone ? 0.5 * (depth - other_depth) : -other_depth;
    if (claims_[won.part].bone) return kLargestMargin;
    const double slopes = 1.0 / static_cast<double>(won.radius) + 1.0 / static_cast<double>(other.radius);
    return (score(won) - score(other)) / slopes;
  }

  const std::vector<Claim>& claims_;
  std::vector<double> favour_;  // one a claim, as a part of the thickness
  std::vector<Bid> bids_;
};

}  // namespace

PartVolume share_out(const Lattice& lattice, const std::vector<Claim>& claims, std::vector<Share>& shares) {
  Auction auction(claims);
  shares = auction.count_shares();
  for (int round = 0; round < kRounds && auction.favour_the_starved(shares); ++round) shares = auction.count_shares();
  PartVolume volume{lattice, {}, Labels(lattice.size(), 0), {}};
  for (const Claim& claim : claims) volume.keys.push_back(claim.key);
  volume.margins.assign(lattice.size(), static_cast<std::uint8_t>(kLargestMargin * kMarginsPerStep));
  auction.for_each_point([&](auto first, auto last) {
    const auto won = auction.winner(first, last);
    if (won != last) volume.labels[first->point] = static_cast<std::uint16_t>(won->part + 1);
    volume.margins[first->point] =
        static_cast<std::uint8_t>(std::lround(kMarginsPerStep * auction.margin(first, last, won)));
  });
  return volume;
}

}  // namespace myotact::prepare
