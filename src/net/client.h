#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "messages/local_model.h"
#include "messages/scene_frame.h"
#include "messages/tool_state.h"
#include "net/clock_estimate.h"
#include "net/frame_reader.h"
#include "net/scene_decoder.h"
#include "net/small_frames.h"
#include "net/socket.h"
#include "net/tool_state_frames.h"
#include "realtime/latest_value.h"

namespace myotact::net {

struct ClientSettings {
  Endpoint server;
  Hello hello;  // who asks for what; its resume id is the client's own business
  std::chrono::milliseconds connect_wait{2000};
  std::chrono::milliseconds silence{1000};  // of the server, which answers pings; after it the client connects anew
};

/// What a person may want to know of the connection.
struct LinkStatus {
  bool connected = false;
  std::uint64_t connections = 0;  // so far
  double round_trip_s = 0.0;      // of the last ping
  Welcome welcome;                // of the present connection, or the last one
  std::string scene_json;         // likewise
  std::string announcement;       // what was said to a class last; empty: nothing, or not wanted
  std::string why;                // it is not connected
  bool is_final = false;          // refused for good: trying again would not help
};

/// The channels of a haptic loop: the client reads the states and writes the models.
struct LoopChannels {
  realtime::LatestValue<messages::ToolState>* states = nullptr;
  realtime::LatestValue<messages::LocalModel>* models = nullptr;
};

/// One side of a connection to a server that is kept up: after a break it connects again by itself.
///
///   haptic loop --states--> [send thread, 1 kHz] --> server --> [receive thread] --models--> haptic loop
///                                                                  |--> newest scene frame
///
/// Times of models are by this machine's clock. Neither thread ever makes the haptic loop wait.
class Client {
 public:
  /// `loop`: none for a client without a hand. Its channels outlive the client and have no other user on these ends.
  explicit Client(const ClientSettings& settings, LoopChannels loop = {});
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Before start(): what the receiving thread calls when somebody stopped all forces.
  void on_stop(std::function<void()> call) { on_stop_ = std::move(call); }
  /// Connects for the first time, so that a wrong address, port or token is reported at once. Throws Error Unavailable.
  void start();
  /// Sends Bye; threads joined. Any number of times.
  void stop() noexcept;

  // ---- any thread but a haptic one
  LinkStatus status() const;
  void ask(const std::string& control_json);  // dropped while there is no connection
  void ask_stop();                            // of all forces of all clients
  /// How often somebody stopped all forces.
  std::uint32_t stops() const { return stops_; }

  /// One thread: copies the newest scene frame; false when there is none newer.
  bool fetch_frame(messages::SceneFrame& frame);

 private:
  void connect();
  void receive_all();
  bool receive_until_break();
  bool take(const Frame& frame);
  void take_control(const Frame& frame);
  bool take_model(const Frame& frame);
  void take_bye(const Frame& frame);
  void reconnect();
  void send_all();
  bool write(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload);
  bool write_locked(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload);
  bool write(const SmallFrame& frame) { return write(frame.type, frame.flags, frame.payload()); }
  void note_break(const std::string& why);

  ClientSettings settings_;
  LoopChannels loop_;
  std::mutex writing_;  // of the socket's replacement too
  Socket socket_;
  std::uint32_t sequence_ = 0;
  FrameReader reader_;
  ClockEstimate clock_;
  SceneDecoder decoder_;
  messages::LocalModel discarded_;  // where a client without a hand decodes
  realtime::LatestValue<messages::SceneFrame> frames_;
  mutable std::mutex telling_;
  LinkStatus status_;
  std::function<void()> on_stop_;
  std::atomic<std::uint32_t> stops_{0};
  std::uint64_t hello_ns_ = 0;           // when the last one left
  std::atomic<bool> connected_{false};   // the socket is
  std::atomic<bool> is_welcome_{false};  // the server answered the Hello of this connection
  std::atomic<bool> has_hand_{false};    // of this connection
  std::atomic<bool> closing_{false};
  std::thread receiver_, sender_;
};

}  // namespace myotact::net
