#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "net/token.h"
#include "net/wire.h"

namespace myotact::net {

inline constexpr std::uint16_t kProtocolVersion = 1;
inline constexpr std::size_t kMostName = 48, kMostText = 96;  // bytes of UTF-8

enum class Role : std::uint8_t { Viewer, Student, Instructor };
const char* describe(Role role) noexcept;
enum class HandWish : std::uint8_t { Any, Left, Right };

/// What a client wants to be sent, besides what it asks for.
struct Wants {
  bool hand = false;           // one of the scene's, with its local models
  bool frames = false;         // skins and bones
  bool readings = false;       // all other numbers of the scene
  bool meshes = false;         // once: triangles of skins and bones, for clients that have no files of them
  bool in_force = false;       // the commands in force of the muscles, and who gave them
  bool pictures = false;       // all of these packed for a screen on a slow line, and a hand without local models
  bool announcements = false;  // what is said to a class
};

struct Hello {
  std::uint16_t version = kProtocolVersion;
  Role role = Role::Viewer;
  Wants wants;
  HandWish hand = HandWish::Any;
  std::uint64_t resume_id = 0;  // of the last Welcome, 0: a new client
  Token token{};
  std::string name;
};

struct Welcome {
  std::uint32_t client = 0;
  std::uint64_t resume_id = 0;
  std::int8_t hand = -1;  // index of the scene's tool, -1: none
  Role role = Role::Viewer;
  bool lockstep = false;
  std::uint64_t step_ns = 0;
  std::uint64_t server_time_ns = 0;
};

/// The newest force of the simulation on a hand, in answer to its state.
struct ForceAnswer {
  std::uint64_t tool_sequence = 0;  // of that state
  std::uint64_t step = 0;           // of the simulation
  std::array<double, 3> force_world_N{};
};

/// What a viewer has taken in: this picture and those before it are no longer on their way.
struct PictureSeen {
  std::uint64_t sequence = 0;  // of the picture
};

enum class EventCode : std::uint8_t { Stop = 1, Refused = 2 };
/// Why a wish is refused, for clients that say it in another language.
enum class Refusal : std::int32_t { Other = 0, NotInstructor = 1, QuestionClosed = 2, TooMuch = 3, NotUnderstood = 4 };
struct Event {
  EventCode code = EventCode::Stop;
  std::int32_t value = 0;  // of a refusal: which one
  std::string text;
};

struct Ping {
  std::uint64_t sent_ns = 0;
};
struct Pong {
  std::uint64_t ping_ns = 0, arrived_ns = 0, left_ns = 0;
};

enum class ByeReason : std::uint8_t { Leaving, BadFrame, Version, Token, Full, Silent, NoHand, Closing };
struct Bye {
  ByeReason reason = ByeReason::Leaving;
  std::string text;
};

/// A frame of at most 128 bytes, without its header.
struct SmallFrame {
  FrameType type = FrameType::Bye;
  std::uint8_t flags = 0;
  std::uint8_t size = 0;
  std::array<std::uint8_t, kSmallPayload> bytes{};

  std::span<const std::uint8_t> payload() const noexcept { return std::span(bytes).first(size); }
};

// Texts are cut where they are too long, between two characters.
SmallFrame encode(const Hello& hello);
SmallFrame encode(const Welcome& welcome) noexcept;
SmallFrame encode(const ForceAnswer& force) noexcept;
SmallFrame encode(const Event& event);
SmallFrame encode(const Ping& ping) noexcept;
SmallFrame encode(const Pong& pong) noexcept;
SmallFrame encode(const PictureSeen& seen) noexcept;
SmallFrame encode(const Bye& bye);

// False: the payload is of another length, or holds a value out of its range or text that is not UTF-8.
bool decode(std::span<const std::uint8_t> payload, Hello& hello);
bool decode(std::span<const std::uint8_t> payload, Welcome& welcome) noexcept;
bool decode(std::span<const std::uint8_t> payload, ForceAnswer& force) noexcept;
bool decode(std::span<const std::uint8_t> payload, Event& event);
bool decode(std::span<const std::uint8_t> payload, Ping& ping) noexcept;
bool decode(std::span<const std::uint8_t> payload, Pong& pong) noexcept;
bool decode(std::span<const std::uint8_t> payload, PictureSeen& seen) noexcept;
bool decode(std::span<const std::uint8_t> payload, Bye& bye);

}  // namespace myotact::net
