#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "messages/local_model.h"
#include "messages/remote_hand.h"
#include "messages/tool_state.h"
#include "net/small_frames.h"
#include "realtime/latest_value.h"

namespace myotact::net {

/// The channels between the simulation and the connection that owns a hand. The simulation's ends are used by its one
/// thread; the other ends by the connection, one after the other where a hand changes owners.
struct HandChannels {
  realtime::LatestValue<messages::ToolState> states;   // to the simulation
  realtime::LatestValue<messages::LocalModel> models;  // from it
  realtime::LatestValue<messages::HandForce> forces;   // from it
};

struct HandPlace {
  HandChannels* channels = nullptr;
  bool left = false;
};

/// Which client has which hand of the scene. Any thread.
class HandTable {
 public:
  /// The channels outlive the table.
  explicit HandTable(const std::vector<HandPlace>& places);

  struct Taken {
    int hand = -1;
    bool comes_free = false;                  // its own hand is still another connection's, which was asked to leave
    std::optional<std::uint32_t> stops_sent;  // to its owner, who has come back to it, before the break
  };
  /// A free hand for a client, if there is one. One that left a moment ago gets its own hand again; until then others
  /// get it only when there is no other. `leave_now` is called, under a lock, when the client comes back by another
  /// connection while this one, which broke without a word, still has the hand.
  Taken take(HandWish wish, std::uint64_t resume_id, std::function<void()> leave_now);
  /// The hand is free from now on: it lets go of everything. `stops_sent`: emergency stops that were sent to its owner.
  void leave(int hand, std::uint32_t stops_sent);

  HandChannels& channels(int hand) { return *places_[static_cast<std::size_t>(hand)].hand.channels; }

 private:
  struct Place {
    HandPlace hand;
    std::function<void()> leave_now;  // empty: the hand is free
    std::uint64_t resume_id = 0;      // of its owner, or its last one
    std::uint32_t stops_sent = 0;     // to its last owner
    std::chrono::steady_clock::time_point kept_until;
  };

  std::mutex mutex_;
  std::vector<Place> places_;
};

}  // namespace myotact::net
