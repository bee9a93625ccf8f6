#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
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

  /// A free hand for a client, or -1. One that left a moment ago gets its own hand again; until then others get it only
  /// when there is no other. Where its own hand is still that of a connection that broke without a word, that one is
  /// told to leave, and the answer is kComesFree: ask again.
  int take(HandWish wish, std::uint64_t resume_id);
  static constexpr int kComesFree = -2;
  /// Its owner has come back by another connection: this one is to leave.
  bool is_claimed(int hand);
  /// Nobody has the hand from now on: it lets go of everything.
  void leave(int hand);

  HandChannels& channels(int hand) { return *places_[static_cast<std::size_t>(hand)].hand.channels; }

 private:
  struct Place {
    HandPlace hand;
    bool taken = false, claimed = false;
    std::uint64_t resume_id = 0;  // of its owner, or its last one
    std::chrono::steady_clock::time_point kept_until;
  };

  std::mutex mutex_;
  std::vector<Place> places_;
};

}  // namespace myotact::net
