#include "net/small_frames.h"

#include <algorithm>
#include <cmath>

#include "net/byte_cursor.h"

namespace myotact::net {

namespace {

/// Writes the payload of one frame.
class Payload {
 public:
  explicit Payload(FrameType type) noexcept : out_(frame_.bytes) { frame_.type = type; }

  template <typename... T>
  Payload& put(const T&... values) {
    (out_.put(values), ...);
    return *this;
  }
  Payload& put_text(const std::string& text, std::size_t most) {
    std::size_t size = std::min(text.size(), most);
    while (size < text.size() && size > 0 && (static_cast<std::uint8_t>(text[size]) & 0xC0) == 0x80) --size;
    out_.put_bytes(reinterpret_cast<const std::uint8_t*>(text.data()), size);
    return *this;
  }
  SmallFrame frame() noexcept {
    frame_.size = static_cast<std::uint8_t>(out_.size());
    return frame_;
  }

 private:
  SmallFrame frame_;
  ByteWriter out_;
};

/// The rest of the payload as text.
bool get_text(ByteReader& in, std::size_t most, std::string& text) {
  const auto bytes = in.take(in.left());
  text.assign(bytes.begin(), bytes.end());
  return in.ok() && bytes.size() <= most && is_utf8(bytes);
}

template <typename Enum>
bool get_enum(ByteReader& in, Enum first, Enum last, Enum& value) noexcept {
  std::uint8_t number = 0;
  in.get(number);
  value = static_cast<Enum>(number);
  return in.ok() && value >= first && value <= last;
}

}  // namespace

const char* describe(Role role) noexcept {
  switch (role) {
    case Role::Viewer:
      return "viewer";
    case Role::Student:
      return "student";
    case Role::Instructor:
      return "instructor";
  }
  return "nobody";
}

SmallFrame encode(const Hello& hello) {
  const auto wants = static_cast<std::uint8_t>((hello.wants.hand ? 1 : 0) | (hello.wants.frames ? 2 : 0) |
                                               (hello.wants.readings ? 4 : 0) | (hello.wants.meshes ? 8 : 0) |
                                               (hello.wants.in_force ? 16 : 0) | (hello.wants.pictures ? 32 : 0) |
                                               (hello.wants.announcements ? 64 : 0));
  return Payload(FrameType::Hello)
      .put(hello.version, static_cast<std::uint8_t>(hello.role), wants, static_cast<std::uint8_t>(hello.hand),
           hello.resume_id, hello.token)
      .put_text(hello.name, kMostName)
      .frame();
}

bool decode(std::span<const std::uint8_t> payload, Hello& hello) {
  ByteReader in(payload);
  std::uint8_t wants = 0;
  in.get(hello.version);
  const bool has_role = get_enum(in, Role::Viewer, Role::Instructor, hello.role);
  in.get(wants);
  const bool has_hand = get_enum(in, HandWish::Any, HandWish::Right, hello.hand);
  in.get(hello.resume_id);
  in.get(hello.token);
  hello.wants = {(wants & 1) != 0,  (wants & 2) != 0,  (wants & 4) != 0, (wants & 8) != 0,
                 (wants & 16) != 0, (wants & 32) != 0, (wants & 64) != 0};
  return has_role && has_hand && wants < 128 && get_text(in, kMostName, hello.name);
}

SmallFrame encode(const Welcome& welcome) noexcept {
  return Payload(FrameType::Welcome)
      .put(welcome.client, welcome.resume_id, welcome.hand, static_cast<std::uint8_t>(welcome.role),
           static_cast<std::uint8_t>(welcome.lockstep ? 1 : 0), welcome.step_ns, welcome.server_time_ns)
      .frame();
}

bool decode(std::span<const std::uint8_t> payload, Welcome& welcome) noexcept {
  ByteReader in(payload);
  std::uint8_t lockstep = 0;
  in.get(welcome.client);
  in.get(welcome.resume_id);
  in.get(welcome.hand);
  const bool has_role = get_enum(in, Role::Viewer, Role::Instructor, welcome.role);
  in.get(lockstep);
  in.get(welcome.step_ns);
  in.get(welcome.server_time_ns);
  welcome.lockstep = lockstep != 0;
  return in.done() && has_role && lockstep <= 1 && welcome.hand >= -1;
}

SmallFrame encode(const ForceAnswer& force) noexcept {
  return Payload(FrameType::Force).put(force.tool_sequence, force.step, force.force_world_N).frame();
}

bool decode(std::span<const std::uint8_t> payload, ForceAnswer& force) noexcept {
  ByteReader in(payload);
  in.get(force.tool_sequence);
  in.get(force.step);
  in.get(force.force_world_N);
  return in.done() && std::all_of(force.force_world_N.begin(), force.force_world_N.end(),
                                  [](double newtons) { return std::isfinite(newtons); });
}

SmallFrame encode(const Event& event) {
  return Payload(FrameType::Event)
      .put(static_cast<std::uint8_t>(event.code), event.value)
      .put_text(event.text, kMostText)
      .frame();
}

bool decode(std::span<const std::uint8_t> payload, Event& event) {
  ByteReader in(payload);
  const bool has_code = get_enum(in, EventCode::Stop, EventCode::Refused, event.code);
  in.get(event.value);
  return has_code && get_text(in, kMostText, event.text);
}

SmallFrame encode(const PictureSeen& seen) noexcept {
  return Payload(FrameType::PictureSeen).put(seen.sequence).frame();
}

bool decode(std::span<const std::uint8_t> payload, PictureSeen& seen) noexcept {
  ByteReader in(payload);
  in.get(seen.sequence);
  return in.done();
}

SmallFrame encode(const Ping& ping) noexcept {
  return Payload(FrameType::Ping).put(ping.sent_ns).frame();
}

bool decode(std::span<const std::uint8_t> payload, Ping& ping) noexcept {
  ByteReader in(payload);
  in.get(ping.sent_ns);
  return in.done();
}

SmallFrame encode(const Pong& pong) noexcept {
  return Payload(FrameType::Pong).put(pong.ping_ns, pong.arrived_ns, pong.left_ns).frame();
}

bool decode(std::span<const std::uint8_t> payload, Pong& pong) noexcept {
  ByteReader in(payload);
  in.get(pong.ping_ns);
  in.get(pong.arrived_ns);
  in.get(pong.left_ns);
  return in.done();
}

SmallFrame encode(const Bye& bye) {
  return Payload(FrameType::Bye).put(static_cast<std::uint8_t>(bye.reason)).put_text(bye.text, kMostText).frame();
}

bool decode(std::span<const std::uint8_t> payload, Bye& bye) {
  ByteReader in(payload);
  return get_enum(in, ByeReason::Leaving, ByeReason::Closing, bye.reason) && get_text(in, kMostText, bye.text);
}

}  // namespace myotact::net
