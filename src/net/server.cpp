#include "net/server.h"

#include <algorithm>
#include <exception>
#include <utility>

#include <spdlog/spdlog.h>

#include "realtime/real_time_thread.h"

namespace myotact::net {

Server::Server(const Endpoint& endpoint, const ServerSettings& settings, HandTable& hands)
    : listener_(listen_at(endpoint)), state_(settings, hands), acceptor_([this] { accept_all(); }) {
  spdlog::info("Listening for incoming connections...");
}

Server::~Server() {
  closing_ = true;
  shut_down(listener_);
  acceptor_.join();
  say_goodbye();
  const std::lock_guard lock(mutex_);
  for (const auto& connection : connections_) connection->shut_down();
  connections_.clear();
}

void Server::say_goodbye() {
  const std::lock_guard lock(mutex_);
  for (const auto& connection : connections_) {
    if (!connection->is_waiting() && !connection->finished()) {
      connection->dismiss(ByeReason::Closing, "the server stops");
    }
  }
}

void Server::accept_all() {
  realtime::name_this_thread("net accept");
  constexpr std::chrono::milliseconds kLook(100);
  while (!closing_) {
    std::string peer;
    if (Socket socket = accept_from(listener_, kLook, peer)) adopt(std::move(socket), peer);
    make_room();
  }
}

void Server::adopt(Socket socket, const std::string& peer) {
  make_room();
  const std::lock_guard lock(mutex_);
  if (closing_) return;
  state_.count(&ServerCounters::accepted);
  try {
    connections_.push_back(std::make_unique<Connection>(std::move(socket), peer, state_));
  } catch (const std::exception& failure) {  // no memory, no thread: this one does not come in
    state_.count(&ServerCounters::failed);
    if (state_.is_new_complaint(failure.what())) spdlog::warn("{}: closed: {} (reported once)", peer, failure.what());
  }
}

/// Lets go of connections that ended; of those that say nothing, the oldest give way.
void Server::make_room() {
  std::vector<std::unique_ptr<Connection>> ended;  // joined without the lock
  const std::lock_guard lock(mutex_);
  const auto gone = std::stable_partition(connections_.begin(), connections_.end(),
                                          [](const auto& connection) { return !connection->finished(); });
  ended.assign(std::make_move_iterator(gone), std::make_move_iterator(connections_.end()));
  connections_.erase(gone, connections_.end());
  auto waiting = static_cast<std::size_t>(std::count_if(
      connections_.begin(), connections_.end(), [](const auto& connection) { return connection->is_waiting(); }));
  for (auto& connection : connections_) {
    if (waiting < state_.settings.most_waiting) break;
    if (!connection->is_waiting()) continue;
    connection->shut_down();
    --waiting;
  }
}

void Server::refuse(std::uint32_t client, const std::string& why, Refusal kind) {
  const std::lock_guard lock(mutex_);
  for (const auto& connection : connections_) {
    if (connection->id() == client && !connection->finished()) connection->refuse_wish(why, kind);
  }
}

std::vector<ClientFacts> Server::clients() {
  std::vector<ClientFacts> clients;
  const std::lock_guard lock(mutex_);
  for (const auto& connection : connections_) {
    if (!connection->is_waiting() && !connection->finished()) clients.push_back(connection->facts());
  }
  return clients;
}

void Server::announce(Announcement announcement) {
  state_.announce(std::make_shared<const Announcement>(std::move(announcement)));
}

void Server::stop_forces() {
  ++state_.stops;
  state_.bell.ring();
}

void Server::show(const messages::SceneFrame& frame) {
  if (state_.watchers > 0) state_.show(encoder_.encode(frame));
  if (state_.picture_watchers > 0) state_.show(picture_encoder_.encode(frame));
}

}  // namespace myotact::net
