#include "net/client.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/error.h"
#include "net/local_model_codec.h"
#include "realtime/periodic_loop.h"
#include "realtime/real_time_thread.h"

namespace myotact::net {

namespace {

constexpr std::chrono::milliseconds kFirstRetry(100), kLongestRetry(1000);

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// A Control of a server is the scene, or what it says to a class.
bool is_announcement(std::span<const std::uint8_t> payload) {
  constexpr std::string_view kBegin = R"({"class":)";
  return payload.size() >= kBegin.size() && std::equal(kBegin.begin(), kBegin.end(), payload.begin());
}

}  // namespace

Client::Client(const ClientSettings& settings, LoopChannels loop) : settings_(settings), loop_(loop) {}

Client::~Client() {
  stop();
}

void Client::start() {
  connect();
  while (connected_ && status().scene_json.empty()) {
    if (!receive_until_break()) break;
  }
  if (const LinkStatus now = status(); now.scene_json.empty()) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("{}:{}: {}", settings_.server.host, settings_.server.port, now.why));
  }
  receiver_ = std::thread([this] { receive_all(); });
  sender_ = std::thread([this] { send_all(); });
}

void Client::stop() noexcept {
  closing_ = true;
  if (connected_) write(encode(Bye{ByeReason::Leaving, ""}));
  connected_ = false;
  {
    const std::lock_guard lock(writing_);
    shut_down(socket_);
  }
  if (receiver_.joinable()) receiver_.join();
  if (sender_.joinable()) sender_.join();
}

void Client::connect() {
  Socket socket = connect_to(settings_.server, settings_.connect_wait);
  set_patience(socket, settings_.silence);
  reader_ = FrameReader();
  decoder_ = SceneDecoder();
  clock_ = ClockEstimate();  // it may be another server, or the same one after a restart of its machine
  settings_.hello.resume_id = status().welcome.resume_id;
  const SmallFrame hello = encode(settings_.hello);
  const std::lock_guard lock(writing_);
  is_welcome_ = has_hand_ = false;
  socket_ = std::move(socket);
  sequence_ = 0;
  connected_ = true;
  hello_ns_ = realtime::steady_now_ns();
  write_locked(hello.type, hello.flags, hello.payload());
}

void Client::receive_all() {
  realtime::name_this_thread("net receive");
  while (!closing_) {
    while (!closing_ && connected_ && receive_until_break()) {
    }
    if (!closing_) reconnect();
  }
}

/// What has come, at least one read of it. False: the connection is at its end.
bool Client::receive_until_break() {
  std::size_t count = 0;
  switch (receive(socket_, reader_.room(), count)) {
    case Received::Some:
      reader_.filled(count);
      break;
    case Received::Closed:
      note_break("the server closed the connection");
      return false;
    case Received::TimedOut:
      note_break("the server is silent");
      return false;
  }
  while (const std::optional<Frame> frame = reader_.next()) {
    if (!take(*frame)) return false;
  }
  if (reader_.fault() == WireFault::None) return true;
  note_break(fmt::format("the server sent a bad frame: {}", describe(reader_.fault())));
  return false;
}

void Client::take_control(const Frame& frame) {
  const std::lock_guard lock(telling_);
  if (is_announcement(frame.payload)) {
    status_.announcement.assign(frame.payload.begin(), frame.payload.end());
    return;
  }
  status_.scene_json.assign(frame.payload.begin(), frame.payload.end());
  status_.connected = true;
  status_.why.clear();
  ++status_.connections;
}

bool Client::take(const Frame& frame) {
  bool sound = true;
  switch (frame.header.type) {
    case FrameType::Welcome: {
      const std::lock_guard lock(telling_);
      sound = decode(frame.payload, status_.welcome);
      const std::uint64_t there_ns = status_.welcome.server_time_ns;
      clock_.add({hello_ns_, there_ns, there_ns, realtime::steady_now_ns()});
      has_hand_ = sound && status_.welcome.hand >= 0;
      is_welcome_ = sound;
      break;
    }
    case FrameType::Control:
      take_control(frame);
      break;
    case FrameType::LocalModel:
      sound = take_model(frame);
      break;
    case FrameType::Pong: {
      Pong pong;
      sound = decode(frame.payload, pong);
      clock_.add({pong.ping_ns, pong.arrived_ns, pong.left_ns, realtime::steady_now_ns()});
      const std::lock_guard lock(telling_);
      status_.round_trip_s = clock_.round_trip_s();
      break;
    }
    case FrameType::Event: {
      Event event;
      sound = decode(frame.payload, event);
      if (sound && event.code == EventCode::Stop) {
        if (on_stop_) on_stop_();
        ++stops_;
      }
      if (sound) spdlog::warn("server: {}", event.text);
      break;
    }
    case FrameType::Bye:
      take_bye(frame);
      return false;
    case FrameType::SceneKey:
    case FrameType::SceneDelta:
    case FrameType::BonePoses:
    case FrameType::Readings:
    case FrameType::InForce:
      sound = decoder_.take(frame);
      if (sound && decoder_.is_whole()) frames_.publish(decoder_.frame());
      break;
    default:
      break;  // the newest force, for clients that have no loop of their own
  }
  if (!sound) note_break("the server sent a frame with a number out of its range");
  return sound;
}

bool Client::take_model(const Frame& frame) {
  messages::LocalModel& model = loop_.models == nullptr ? discarded_ : loop_.models->back();
  if (!decode(frame.payload, model)) return false;
  if (loop_.models == nullptr) return true;
  model.published_at_ns = clock_.here_ns(model.published_at_ns);
  loop_.models->publish();
  return true;
}

void Client::take_bye(const Frame& frame) {
  Bye bye;
  const bool sound = decode(frame.payload, bye);
  note_break(sound && !bye.text.empty() ? bye.text : "the server said good-bye");
  const std::lock_guard lock(telling_);
  status_.is_final = sound && (bye.reason == ByeReason::Token || bye.reason == ByeReason::Version);
}

void Client::note_break(const std::string& why) {
  connected_ = is_welcome_ = false;
  const std::lock_guard lock(telling_);
  if (status_.connected && !closing_) spdlog::warn("connection lost: {}; connecting again", why);
  status_.connected = false;
  status_.why = why;
}

/// Until it is connected, closed or refused for good.
void Client::reconnect() {
  auto wait = kFirstRetry;
  while (!closing_ && !connected_) {
    std::this_thread::sleep_for(wait);
    wait = std::min(kLongestRetry, 2 * wait);
    if (closing_ || status().is_final) continue;
    try {
      connect();
    } catch (const Error& failure) {
      note_break(failure.what());
    }
  }
}

void Client::send_all() {
  realtime::name_this_thread("net send");
  constexpr std::uint64_t kPeriod_ns = 1'000'000, kPing_ns = 100'000'000;
  realtime::PeriodicLoop loop(kPeriod_ns);
  loop.start();
  std::uint64_t pinged_ns = 0;
  while (!closing_) {
    const std::uint64_t now_ns = loop.wait().now_ns;
    if (!is_welcome_) continue;
    if (loop_.states != nullptr && has_hand_ && loop_.states->update()) {
      const ToolStateFrames frames = encode(loop_.states->front());
      for (const SmallFrame& frame : frames.used()) write(frame);
    }
    if (now_ns - pinged_ns < kPing_ns) continue;
    pinged_ns = now_ns;
    write(encode(Ping{realtime::steady_now_ns()}));
  }
}

bool Client::write(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload) {
  const std::lock_guard lock(writing_);
  return write_locked(type, flags, payload);
}

bool Client::write_locked(FrameType type, std::uint8_t flags, std::span<const std::uint8_t> payload) {
  constexpr std::chrono::milliseconds kPatience(500);
  FrameHeader header;
  header.type = type;
  header.flags = flags;
  header.sequence = sequence_;
  header.time_ns = realtime::steady_now_ns();
  if (send(socket_, header_bytes(header, payload), payload, false, kPatience) != Sent::All) {
    shut_down(socket_);  // the receiving thread finds out
    return false;
  }
  ++sequence_;
  return true;
}

void Client::ask(const std::string& control_json) {
  if (is_welcome_) write(FrameType::Control, 0, bytes_of(control_json));
}

void Client::ask_stop() {
  if (is_welcome_) write(encode(Event{EventCode::Stop, 0, "stop"}));
}

LinkStatus Client::status() const {
  const std::lock_guard lock(telling_);
  return status_;
}

bool Client::fetch_frame(messages::SceneFrame& frame) {
  if (!frames_.update()) return false;
  frame = frames_.front();
  return true;
}

}  // namespace myotact::net
