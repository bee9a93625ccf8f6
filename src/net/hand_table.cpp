#include "net/hand_table.h"

namespace myotact::net {

namespace {

constexpr std::chrono::seconds kKept(5);  // for a client whose connection broke: a cable is plugged in again

}  // namespace

HandTable::HandTable(const std::vector<HandPlace>& places) {
  for (const HandPlace& place : places) places_.push_back({place, false, 0, {}});
}

int HandTable::take(HandWish wish, std::uint64_t resume_id) {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  int found = -1;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].taken || (wish != HandWish::Any && places_[i].hand.left != (wish == HandWish::Left))) continue;
    const bool was_ours = resume_id != 0 && places_[i].resume_id == resume_id;
    const bool is_kept = places_[i].resume_id != 0 && now < places_[i].kept_until;
    if (was_ours || (!is_kept && found < 0)) found = static_cast<int>(i);
    if (was_ours) break;
  }
  if (found >= 0) {
    Place& place = places_[static_cast<std::size_t>(found)];
    place = {place.hand, true, resume_id, {}};
  }
  return found;
}

void HandTable::leave(int hand) {
  const std::lock_guard lock(mutex_);
  Place& place = places_[static_cast<std::size_t>(hand)];
  place.hand.channels->states.publish({});
  place.taken = false;
  place.kept_until = std::chrono::steady_clock::now() + kKept;
}

}  // namespace myotact::net
