#include "net/hand_table.h"

#include <utility>

namespace myotact::net {

namespace {

constexpr std::chrono::seconds kKept(5);  // for a client whose connection broke: a cable is plugged in again

}  // namespace

HandTable::HandTable(const std::vector<HandPlace>& places) {
  for (const HandPlace& place : places) places_.push_back({place, {}, 0, 0, {}});
}

HandTable::Taken HandTable::take(HandWish wish, std::uint64_t resume_id, std::function<void()> leave_now) {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  Place* best = nullptr;
  int best_rank = 0;
  constexpr int kOwn = 3;
  for (Place& place : places_) {
    const bool was_ours = resume_id != 0 && place.resume_id == resume_id;
    if (place.leave_now && was_ours) {
      place.leave_now();
      return {-1, true, {}};
    }
    if (place.leave_now || (wish != HandWish::Any && place.hand.left != (wish == HandWish::Left))) continue;
    const int rank = was_ours ? kOwn : (now < place.kept_until ? 1 : 2);
    if (rank > best_rank) {
      best = &place;
      best_rank = rank;
    }
  }
  if (best == nullptr) return {};
  best->leave_now = std::move(leave_now);
  best->resume_id = resume_id;
  Taken taken{static_cast<int>(best - places_.data()), false, {}};
  if (best_rank == kOwn) taken.stops_sent = best->stops_sent;
  return taken;
}

void HandTable::leave(int hand, std::uint32_t stops_sent) {
  const std::lock_guard lock(mutex_);
  Place& place = places_[static_cast<std::size_t>(hand)];
  place.hand.channels->states.publish({});
  place.leave_now = nullptr;
  place.stops_sent = stops_sent;
  place.kept_until = std::chrono::steady_clock::now() + kKept;
}

}  // namespace myotact::net
