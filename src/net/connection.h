#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "net/frame_reader.h"
#include "net/server_state.h"
#include "net/socket.h"
#include "net/token_bucket.h"
#include "net/tool_state_frames.h"

namespace myotact::net {

/// One client of a server, from its first byte to its end, with a thread that receives and one that sends.
///
///   receives: Hello --> [ToolState --> hand's channel, newest Force back at once] [Control --> requests] [Ping -->
///   Pong] sends:    newest LocalModel of its hand, newest scene frame, events: each when there is news
///
/// A reader that is too slow gets the newest of each and nothing in between, and is closed when it takes nothing at
/// all.
class Connection {
 public:
  Connection(Socket socket, std::string peer, ServerState& server);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // ---- any thread
  bool finished() const { return finished_; }
  bool is_waiting() const { return !admitted_; }  // for its Hello
  std::uint32_t id() const { return id_; }
  ClientFacts facts() const { return {id_, role_, hand_, name_}; }  // once it no longer waits
  /// Sends the client, soon, why something that it asked for is not done.
  void refuse_wish(const std::string& why, Refusal kind);
  /// The last word of a server that has no more time for it.
  void dismiss(ByeReason reason, const std::string& why);
  void shut_down() const { net::shut_down(socket_); }

 private:
  void receive_all();
  void serve();
  void leave();
  bool admit();
  bool take_hand(HandWish wish, std::uint64_t former_id, std::uint64_t resume_id);
  bool welcome(const Hello& hello);
  bool obey(const Frame& frame);
  bool take_tool_frame(const Frame& frame);
  bool take_event(const Frame& frame);
  bool take_control(const Frame& frame);
  std::optional<Frame> next_frame();
  void refuse(ByeReason reason, const std::string& text);
  void complain(const std::string& what);

  void send_all();
  bool send_news();
  bool send_events();
  bool send_announcement();
  bool send_model();
  bool send_scene();
  bool send_picture();

  bool write(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload, bool may_drop = false);
  bool write(const SmallFrame& frame, bool may_drop = false);
  bool write_locked(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload, bool may_drop);

  Socket socket_;
  std::string peer_;
  ServerState& server_;
  FrameReader reader_;
  ToolStateJoiner joiner_;
  TokenBucket frames_, controls_;
  std::atomic<std::uint32_t> id_{0};
  Role role_ = Role::Viewer;  // as name and wants of the Hello
  std::string name_;
  Wants wants_;
  std::atomic<int> hand_{-1};
  std::uint64_t first_step_ = 0;  // whose force is of this client's hand
  std::uint32_t stops_ = 0;       // sent so far
  std::mutex refusing_;
  std::deque<Event> refusals_;  // of wishes, to be sent
  Bytes model_bytes_;
  std::shared_ptr<const EncodedScene> shown_;                 // sent last
  std::shared_ptr<const ScenePicture> pictured_;              // sent last
  std::deque<std::pair<std::uint64_t, std::size_t>> unseen_;  // pictures on their way, with their bytes
  std::atomic<std::uint64_t> seen_{0};                        // the newest picture that the client has taken in
  std::shared_ptr<const Announcement> heard_;                 // sent last
  std::mutex writing_;
  std::uint32_t sequence_ = 0;         // of the next frame, under writing_
  std::atomic<bool> is_stuck_{false};  // it did not take a frame: nothing after it would make sense to it
  std::atomic<bool> admitted_{false};
  std::atomic<bool> dismissed_{false};  // its last word is said; who passes it on may still need the connection
  std::atomic<bool> closing_{false};
  std::atomic<bool> finished_{false};
  std::thread sender_;
  std::thread receiver_;  // last: it runs from the constructor on
};

}  // namespace myotact::net
