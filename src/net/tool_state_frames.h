#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "messages/tool_state.h"
#include "net/small_frames.h"

namespace myotact::net {

inline constexpr std::uint8_t kWithContact = 1, kWithGrip = 2;  // flags of a ToolState frame

/// A tool state as frames: what it touches and what it holds come first, where there is something, then the state.
struct ToolStateFrames {
  std::array<SmallFrame, 3 + messages::kMaxContactsBeside> frames;
  std::size_t count = 0;

  std::span<const SmallFrame> used() const& noexcept { return std::span(frames).first(count); }
  void used() const&& = delete;  // a span of what a loop over a temporary has already lost
};
ToolStateFrames encode(const messages::ToolState& state) noexcept;

/// Puts the frames of tool states together again, without loss.
class ToolStateJoiner {
 public:
  /// False: a number out of its range; state() stays what it was. After a ToolState frame state() is whole.
  bool take(const Frame& frame) noexcept;
  const messages::ToolState& state() const noexcept { return state_; }

 private:
  bool take_state(const Frame& frame, messages::ToolState& state) const noexcept;
  bool take_contact(const Frame& frame) noexcept;
  bool take_grip(std::span<const std::uint8_t> payload) noexcept;

  messages::ToolState state_;
  messages::ToolState parts_;  // contact and grips of the frames before
};

}  // namespace myotact::net
