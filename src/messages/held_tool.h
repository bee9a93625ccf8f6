#pragma once

#include <cstdint>
#include <type_traits>

namespace myotact::messages {

/// What a tool looks and feels like: a fingertip, the tip of a stylus, a clamp that takes bones.
enum class ToolShape : std::uint8_t { Ball, Point, Clamp };

/// The tool in a hand.
struct HeldTool {
  ToolShape shape = ToolShape::Ball;
  double radius_m = 3e-3;  // of its sphere; 0: a point

  bool operator==(const HeldTool&) const = default;
};
static_assert(std::is_trivially_copyable_v<HeldTool>);

}  // namespace myotact::messages
