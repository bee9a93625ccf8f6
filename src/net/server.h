#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "messages/scene_frame.h"
#include "net/connection.h"
#include "net/scene_encoder.h"
#include "net/server_state.h"
#include "net/socket.h"

namespace myotact::net {

/// Lets clients join a simulation over TCP. What it does to others is bounded: connections, bytes, rates and times.
class Server {
 public:
  /// Listens from now on. `hands` outlives it. Throws Error Unavailable.
  Server(const Endpoint& endpoint, const ServerSettings& settings, HandTable& hands);
  ~Server();

  std::uint16_t port() const { return port_of(listener_); }

  // ---- any thread but a haptic one
  /// A connection that came in by another way (a WebSocket), with the bytes of TCP.
  void adopt(Socket socket, const std::string& peer);
  /// The hands' models and forces are new.
  void ring() { state_.bell.ring(); }
  std::optional<ControlRequest> take_request() { return state_.take_request(); }
  /// Sends a client why what it asked for is not done.
  void refuse(std::uint32_t client, const std::string& why, Refusal kind = Refusal::Other);
  std::uint32_t stops() const { return state_.stops; }  // emergency stops that clients asked for so far
  void stop_forces();                                   // of all hands, asked for by this machine's person
  std::size_t client_count() const { return state_.admitted; }
  std::vector<ClientFacts> clients();
  /// Takes the place of what was said before; who joins later hears it too.
  void announce(Announcement announcement);
  /// Tells everybody that the server stops. What comes in by other ways than TCP is passed on by whoever adopted it.
  void say_goodbye();
  /// While it is on, all hands but instructors' touch and hold nothing.
  void let_hands_rest(bool on) { state_.rests = on; }
  bool is_new_complaint(const std::string& text) { return state_.is_new_complaint(text); }
  ServerCounters counters() const { return state_.counters(); }

  /// Whether anybody wants to see scene frames.
  bool is_watched() const { return state_.watchers > 0 || state_.picture_watchers > 0; }
  /// One thread: shows a newer frame to all who want to see.
  void show(const messages::SceneFrame& frame);

 private:
  void accept_all();
  void make_room();

  Socket listener_;
  ServerState state_;
  SceneEncoder encoder_;
  PictureEncoder picture_encoder_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Connection>> connections_;
  std::atomic<bool> closing_{false};
  std::thread acceptor_;  // last: it runs from the constructor on
};

}  // namespace myotact::net
