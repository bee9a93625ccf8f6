#include "net/connection.h"

#include <cstring>
#include <exception>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "net/admission.h"
#include "realtime/periodic_loop.h"
#include "realtime/real_time_thread.h"

namespace myotact::net {

namespace {

constexpr std::size_t kMostStudentControl = 1024;  // bytes of what is not an instructor's

/// The same hand, which touches and holds nothing, and yet is somebody's.
messages::ToolState without_touch(const messages::ToolState& state) {
  messages::ToolState resting = messages::let_go(state);
  resting.sequence = state.sequence;
  resting.proxy_position_world_m = state.tool_position_world_m;  // nothing holds it back
  return resting;
}

/// As hard to guess as a token: who knows it takes over the hand.
std::uint64_t new_resume_id() {
  const Token random = new_token();
  std::uint64_t id = 0;
  std::memcpy(&id, random.data(), sizeof id);
  return id;
}

}  // namespace

Connection::Connection(Socket socket, std::string peer, ServerState& server)
    : socket_(std::move(socket)),
      peer_(std::move(peer)),
      server_(server),
      frames_(server.settings.most_frames_per_s),
      controls_(server.settings.most_controls_per_s),
      receiver_([this] { receive_all(); }) {}

Connection::~Connection() {
  shut_down();
  receiver_.join();
}

/// Whatever one client makes fail - no memory, no thread - is the end of its connection and of nothing else.
void Connection::receive_all() {
  realtime::name_this_thread("net receive");
  try {
    serve();
  } catch (const std::exception& failure) {
    server_.count(&ServerCounters::failed);
    complain(failure.what());
  }
  leave();
  finished_ = true;
}

void Connection::serve() {
  reader_.set_most_payload(kSmallPayload);  // a stranger is not worth more memory
  set_patience(socket_, server_.settings.hello_wait);
  if (!admit()) return;
  const bool leads = role_ == Role::Instructor;
  reader_.set_most_payload(leads ? kMostControl : kMostStudentControl);
  if (!leads) controls_ = TokenBucket(server_.settings.most_student_controls_per_s);
  set_patience(socket_, server_.settings.silence);
  sender_ = std::thread([this] { send_all(); });
  for (std::optional<Frame> frame = next_frame(); frame && obey(*frame);) frame = next_frame();
}

void Connection::leave() {
  closing_ = true;
  shut_down();
  server_.bell.ring();
  if (sender_.joinable()) sender_.join();
  if (hand_ >= 0) server_.hands.leave(hand_, stops_);
  if (!admitted_) return;
  --server_.admitted;
  if (wants_.frames) --server_.watchers;
  if (wants_.pictures) --server_.picture_watchers;
  spdlog::info("Client {} left.", id_.load());
}

/// The next whole frame; nothing when the connection is at its end.
std::optional<Frame> Connection::next_frame() {
  for (;;) {
    if (std::optional<Frame> frame = reader_.next()) {
      const auto wait = frames_.take(std::chrono::steady_clock::now());
      if (wait.count() > 0) std::this_thread::sleep_for(wait);
      return frame;
    }
    if (reader_.fault() != WireFault::None) {
      server_.count(reader_.fault());
      refuse(ByeReason::BadFrame, describe(reader_.fault()));
      return std::nullopt;
    }
    std::size_t count = 0;
    switch (receive(socket_, reader_.room(), count)) {
      case Received::Some:
        reader_.filled(count);
        break;
      case Received::Closed:
        return std::nullopt;
      case Received::TimedOut:
        server_.count(&ServerCounters::closed_silent);
        refuse(ByeReason::Silent, "nothing came for too long; ping ten times a second");
        return std::nullopt;
    }
  }
}

bool Connection::admit() {
  const std::optional<Frame> frame = next_frame();
  if (!frame) return false;
  Hello hello;
  if (const auto refusal = refusal_of(*frame, server_.settings.access_policy, hello)) {
    refuse(refusal->reason, refusal->text);
    return false;
  }
  return welcome(hello);
}

bool Connection::welcome(const Hello& hello) {
  if (++server_.admitted > server_.settings.most_connections) {
    --server_.admitted;
    refuse(ByeReason::Full, fmt::format("{} clients are all that may join", server_.settings.most_connections));
    return false;
  }
  role_ = hello.role;
  name_ = hello.name;
  wants_ = hello.wants;
  if (wants_.frames) ++server_.watchers;
  if (wants_.pictures) ++server_.picture_watchers;
  stops_ = server_.stops;  // before the Welcome: no stop after it is missed
  id_ = server_.next_client++;
  admitted_ = true;
  const std::uint64_t resume_id = hello.resume_id != 0 ? hello.resume_id : new_resume_id();
  if (wants_.hand && role_ != Role::Viewer && !take_hand(hello.hand, hello.resume_id, resume_id)) return false;
  Welcome answer;
  answer.client = id_;
  answer.resume_id = resume_id;
  answer.hand = static_cast<std::int8_t>(hand_);
  answer.role = role_;
  answer.step_ns = server_.settings.step_ns;
  answer.server_time_ns = realtime::steady_now_ns();
  const std::string& scene = server_.settings.scene_json;
  spdlog::info("Client connected! {} as {}{}", peer_, describe(role_),
               hand_ >= 0 ? fmt::format(", hand {}", hand_.load()) : std::string());
  bool sent = write(encode(answer)) &&
              write(FrameType::Control, 0, {reinterpret_cast<const std::uint8_t*>(scene.data()), scene.size()});
  for (const Bytes& mesh : server_.settings.meshes) sent = sent && (!wants_.meshes || write(FrameType::Mesh, 0, mesh));
  return sent;
}

/// Gives a connection that broke without a word the time to leave. False: the client came back for a hand, and is to
/// try again later; a new one may watch without.
bool Connection::take_hand(HandWish wish, std::uint64_t former_id, std::uint64_t resume_id) {
  constexpr std::chrono::milliseconds kLook(20);
  constexpr int kLooks = 50;
  const auto leave_now = [this] {
    closing_ = true;
    shut_down();
  };
  HandTable::Taken taken = server_.hands.take(wish, resume_id, leave_now);
  for (int i = 0; taken.comes_free && i < kLooks && !closing_; ++i) {
    std::this_thread::sleep_for(kLook);
    taken = server_.hands.take(wish, resume_id, leave_now);
  }
  hand_ = taken.hand;
  if (hand_ < 0) {
    if (former_id != 0) refuse(ByeReason::NoHand, "no hand of the scene is free yet; come again");
    return former_id == 0;
  }
  // A stop while it was away is sent to it now. Another client may have its former hand: one stop too many is harmless.
  if (former_id != 0) stops_ = taken.stops_sent.value_or(0);
  HandChannels& channels = server_.hands.channels(hand_);
  channels.forces.update();
  first_step_ = channels.forces.front().step + 2;  // the step under way may still be the former owner's
  return true;
}

bool Connection::obey(const Frame& frame) {
  switch (frame.header.type) {
    case FrameType::ToolState:
    case FrameType::ToolContact:
    case FrameType::ToolGrip:
      return take_tool_frame(frame);
    case FrameType::Ping: {
      Pong pong;
      pong.arrived_ns = realtime::steady_now_ns();
      Ping ping;
      if (!decode(frame.payload, ping)) break;
      pong.ping_ns = ping.sent_ns;
      pong.left_ns = realtime::steady_now_ns();
      return write(encode(pong), true) || !closing_;
    }
    case FrameType::Event:
      return take_event(frame);
    case FrameType::Control:
      return take_control(frame);
    case FrameType::PictureSeen: {
      PictureSeen seen;
      if (!decode(frame.payload, seen)) break;
      seen_ = seen.sequence;
      return true;
    }
    case FrameType::Bye:
      return false;
    default:
      break;
  }
  server_.count(WireFault::Value);
  refuse(ByeReason::BadFrame,
         fmt::format("a frame of type {} with this content is not for a server", static_cast<int>(frame.header.type)));
  return false;
}

bool Connection::take_tool_frame(const Frame& frame) {
  if (!joiner_.take(frame)) {
    server_.count(WireFault::Value);
    refuse(ByeReason::BadFrame, "a tool state with a number out of its range");
    return false;
  }
  if (frame.header.type != FrameType::ToolState) return true;
  if (hand_ < 0) {
    refuse(ByeReason::NoHand, "no hand of the scene is free for this client; it may watch");
    return false;
  }
  const messages::ToolState& state = joiner_.state();
  const bool rests = server_.rests && role_ != Role::Instructor;
  HandChannels& channels = server_.hands.channels(hand_);
  channels.states.publish(rests ? without_touch(state) : state);
  channels.forces.update();
  messages::HandForce force = channels.forces.front();
  if (force.step < first_step_) force.force_world_N = {};
  spdlog::debug("force send: {} {} {}", force.force_world_N[0], force.force_world_N[1], force.force_world_N[2]);
  write(encode(ForceAnswer{state.sequence, force.step, force.force_world_N}), true);
  return true;
}

bool Connection::take_event(const Frame& frame) {
  Event event;
  if (!decode(frame.payload, event)) {
    server_.count(WireFault::Text);
    refuse(ByeReason::BadFrame, "an event that cannot be read");
    return false;
  }
  if (event.code == EventCode::Stop) {
    spdlog::warn("Client {} stopped all forces.", id_.load());
    ++server_.stops;
    server_.bell.ring();
  }
  return true;
}

bool Connection::take_control(const Frame& frame) {
  const std::string text(frame.payload.begin(), frame.payload.end());
  const auto wait = controls_.take(std::chrono::steady_clock::now());
  if (wait.count() > 0) std::this_thread::sleep_for(wait);
  if (!server_.ask({id_, role_, text}))
    return write(encode(
        Event{EventCode::Refused, static_cast<std::int32_t>(Refusal::TooMuch), "too much is asked for at once"}));
  return true;
}

void Connection::refuse_wish(const std::string& why, Refusal kind) {
  constexpr std::size_t kMost = 8;  // of answers that a slow reader has not taken
  {
    const std::lock_guard lock(refusing_);
    if (refusals_.size() < kMost) refusals_.push_back({EventCode::Refused, static_cast<std::int32_t>(kind), why});
  }
  server_.bell.ring();
}

void Connection::refuse(ByeReason reason, const std::string& text) {
  server_.count(&ServerCounters::refused);
  complain(text);
  write(encode(Bye{reason, text}), true);
}

void Connection::complain(const std::string& what) {
  if (server_.is_new_complaint(what)) spdlog::warn("{}: closed: {} (reported once)", peer_, what);
}

}  // namespace myotact::net
