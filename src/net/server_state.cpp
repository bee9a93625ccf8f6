#include "net/server_state.h"

#include <utility>

namespace myotact::net {

namespace {

constexpr std::size_t kMostRequests = 256;   // a second of a class that moves its sliders
constexpr std::size_t kMostComplaints = 64;  // kinds, not clients

}  // namespace

void ServerState::show(std::shared_ptr<const EncodedScene> scene) {
  {
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
  }
  bell.ring();
}

std::shared_ptr<const EncodedScene> ServerState::scene() const {
  const std::lock_guard lock(mutex_);
  return scene_;
}

void ServerState::show(std::shared_ptr<const ScenePicture> picture) {
  {
    const std::lock_guard lock(mutex_);
    picture_ = std::move(picture);
  }
  bell.ring();
}

std::shared_ptr<const ScenePicture> ServerState::picture() const {
  const std::lock_guard lock(mutex_);
  return picture_;
}

void ServerState::announce(std::shared_ptr<const Announcement> announcement) {
  {
    const std::lock_guard lock(mutex_);
    announcement_ = std::move(announcement);
  }
  bell.ring();
}

std::shared_ptr<const Announcement> ServerState::announcement() const {
  const std::lock_guard lock(mutex_);
  return announcement_;
}

bool ServerState::ask(ControlRequest request) {
  const std::lock_guard lock(mutex_);
  if (requests_.size() >= kMostRequests) {
    ++counters_.dropped_controls;
    return false;
  }
  requests_.push_back(std::move(request));
  return true;
}

std::optional<ControlRequest> ServerState::take_request() {
  const std::lock_guard lock(mutex_);
  if (requests_.empty()) return std::nullopt;
  ControlRequest request = std::move(requests_.front());
  requests_.pop_front();
  return request;
}

void ServerState::count(std::uint64_t ServerCounters::*counter) {
  const std::lock_guard lock(mutex_);
  ++(counters_.*counter);
}

void ServerState::count(WireFault fault) {
  const std::lock_guard lock(mutex_);
  ++counters_.faults[static_cast<std::size_t>(fault)];
}

ServerCounters ServerState::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

bool ServerState::is_new_complaint(const std::string& text) {
  const std::lock_guard lock(mutex_);
  return complaints_.size() < kMostComplaints && complaints_.insert(text).second;
}

}  // namespace myotact::net
