#include "net/hand_table.h"

namespace myotact::net {

namespace {

constexpr std::chrono::seconds kKept(5);  // for a client whose connection broke: a cable is plugged in again

}  // namespace

HandTable::HandTable(const std::vector<HandPlace>& places) {
  for (const HandPlace& place : places) places_.push_back({place, false, false, 0, {}});
}

int HandTable::take(HandWish wish, std::uint64_t resume_id) {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  Place* best = nullptr;
  int best_rank = 0;
  for (Place& place : places_) {
    if (place.taken && resume_id != 0 && place.resume_id == resume_id) {
      place.claimed = true;
      return kComesFree;
    }
    if (place.taken || (wish != HandWish::Any && place.hand.left != (wish == HandWish::Left))) continue;
    const bool was_ours = resume_id != 0 && place.resume_id == resume_id;
    const int rank = was_ours ? 3 : (now < place.kept_until ? 1 : 2);
    if (rank > best_rank) {
      best = &place;
      best_rank = rank;
    }
  }
  if (best == nullptr) return -1;
  *best = {best->hand, true, false, resume_id, {}};
  return static_cast<int>(best - places_.data());
}

void HandTable::leave(int hand) {
  const std::lock_guard lock(mutex_);
  Place& place = places_[static_cast<std::size_t>(hand)];
  place.hand.channels->states.publish({});
  place.taken = false;
  place.kept_until = std::chrono::steady_clock::now() + kKept;
}

bool HandTable::is_claimed(int hand) {
  const std::lock_guard lock(mutex_);
  return places_[static_cast<std::size_t>(hand)].claimed;
}

}  // namespace myotact::net
