#include "net/tool_state_frames.h"

#include <algorithm>
#include <cmath>

#include "net/byte_cursor.h"

namespace myotact::net {

namespace {

constexpr double kRounding = 1e-6;                                            // of what is 1 at most
constexpr double kFarthest_m = 1e3, kMostForce_N = 1e6, kStiffest_N_m = 1e7;  // beyond all that a hand can be about

template <std::size_t N>
bool within(const std::array<double, N>& values, double most) noexcept {
  return std::all_of(values.begin(), values.end(), [most](double value) { return std::abs(value) <= most; });
}

bool is_share(double value) noexcept {
  return value >= 0.0 && value <= 1.0;
}

template <typename... T>
SmallFrame small(FrameType type, std::uint8_t flags, const T&... values) noexcept {
  SmallFrame frame;
  frame.type = type;
  frame.flags = flags;
  ByteWriter out(frame.bytes);
  (out.put(values), ...);
  frame.size = static_cast<std::uint8_t>(out.size());
  return frame;
}

/// `place`: 0 that which carries most, then those beside.
SmallFrame contact_frame(std::uint8_t place, const messages::ToolContact& contact,
                         const std::array<double, 3>& touched_world_m) noexcept {
  return small(FrameType::ToolContact, place, contact.surface, contact.triangle, contact.barycentric[0],
               contact.barycentric[1], contact.normal_world, contact.target_world_m, contact.stiffness_N_m,
               touched_world_m);
}

}  // namespace

ToolStateFrames encode(const messages::ToolState& state) noexcept {
  ToolStateFrames out;
  std::uint8_t flags = 0;
  const messages::ToolContact& contact = state.contact;
  if (contact.surface >= 0 || contact.stiffness_N_m > 0.0) {
    flags |= kWithContact;
    for (std::size_t i = state.beside.size(); i-- > 0;) {
      if (state.beside[i].stiffness_N_m > 0.0)
        out.frames[out.count++] = contact_frame(static_cast<std::uint8_t>(i + 1), state.beside[i], {});
    }
    out.frames[out.count++] = contact_frame(0, contact, state.touched_world_m);
  }
  if (state.grabbed_line >= 0 || state.grabbed_body >= 0) {
    flags |= kWithGrip;
    out.frames[out.count++] =
        small(FrameType::ToolGrip, 0, state.grabbed_line, state.grabbed_body, state.grab_fraction,
              state.line_stiffness_N_m, state.body_point_rest_m, state.body_target_world_m, state.body_stiffness_N_m);
  }
  out.frames[out.count++] =
      small(FrameType::ToolState, flags, state.tool_position_world_m, state.proxy_position_world_m, state.force_world_N,
            state.sequence, state.model_sequence, state.buttons, state.faults, contact.barycentric[2]);
  return out;
}

bool ToolStateJoiner::take(const Frame& frame) noexcept {
  bool sound = false;
  messages::ToolState whole = state_;
  if (frame.header.type == FrameType::ToolContact) sound = take_contact(frame);
  if (frame.header.type == FrameType::ToolGrip) sound = take_grip(frame.payload);
  if (frame.header.type == FrameType::ToolState) sound = take_state(frame, whole);
  if (sound) state_ = whole;
  if (!sound || frame.header.type == FrameType::ToolState) parts_ = {};
  return sound;
}

bool ToolStateJoiner::take_state(const Frame& frame, messages::ToolState& state) const noexcept {
  state = {};
  if ((frame.header.flags & kWithContact) != 0) {
    state.contact = parts_.contact;
    state.beside = parts_.beside;
    state.touched_world_m = parts_.touched_world_m;
  }
  if ((frame.header.flags & kWithGrip) != 0) {
    state.grabbed_line = parts_.grabbed_line;
    state.grabbed_body = parts_.grabbed_body;
    state.grab_fraction = parts_.grab_fraction;
    state.line_stiffness_N_m = parts_.line_stiffness_N_m;
    state.body_point_rest_m = parts_.body_point_rest_m;
    state.body_target_world_m = parts_.body_target_world_m;
    state.body_stiffness_N_m = parts_.body_stiffness_N_m;
  }
  ByteReader in(frame.payload);
  in.get(state.tool_position_world_m);
  in.get(state.proxy_position_world_m);
  in.get(state.force_world_N);
  in.get(state.sequence);
  in.get(state.model_sequence);
  in.get(state.buttons);
  in.get(state.faults);
  double third = 0.0;  // barycentric coordinate: a contact's own frame has no room for it
  in.get(third);
  if ((frame.header.flags & kWithContact) != 0) state.contact.barycentric[2] = third;
  state.time_ns = frame.header.time_ns;
  return in.done() && (frame.header.flags & ~(kWithContact | kWithGrip)) == 0 && std::abs(third) <= 1.0 + kRounding &&
         within(state.tool_position_world_m, kFarthest_m) && within(state.proxy_position_world_m, kFarthest_m) &&
         within(state.force_world_N, kMostForce_N);
}

bool ToolStateJoiner::take_contact(const Frame& frame) noexcept {
  const std::uint8_t place = frame.header.flags;
  if (place > messages::kMaxContactsBeside) return false;
  messages::ToolContact& contact = place == 0 ? parts_.contact : parts_.beside[place - 1u];
  ByteReader in(frame.payload);
  in.get(contact.surface);
  in.get(contact.triangle);
  in.get(contact.barycentric[0]);
  in.get(contact.barycentric[1]);
  in.get(contact.normal_world);
  in.get(contact.target_world_m);
  in.get(contact.stiffness_N_m);
  in.get(parts_.touched_world_m);
  if (place > 0) contact.barycentric[2] = 1.0 - contact.barycentric[0] - contact.barycentric[1];
  return in.done() && contact.surface >= -1 && contact.triangle >= -1 && within(contact.barycentric, 1.0 + kRounding) &&
         within(contact.normal_world, 1.0 + kRounding) && within(contact.target_world_m, kFarthest_m) &&
         within(parts_.touched_world_m, kFarthest_m) && contact.stiffness_N_m >= 0.0 &&
         contact.stiffness_N_m <= kStiffest_N_m;
}

bool ToolStateJoiner::take_grip(std::span<const std::uint8_t> payload) noexcept {
  ByteReader in(payload);
  in.get(parts_.grabbed_line);
  in.get(parts_.grabbed_body);
  in.get(parts_.grab_fraction);
  in.get(parts_.line_stiffness_N_m);
  in.get(parts_.body_point_rest_m);
  in.get(parts_.body_target_world_m);
  in.get(parts_.body_stiffness_N_m);
  const auto is_stiffness = [](double value) { return value >= 0.0 && value <= kStiffest_N_m; };
  return in.done() && parts_.grabbed_line >= -1 && parts_.grabbed_body >= -1 && is_share(parts_.grab_fraction) &&
         is_stiffness(parts_.line_stiffness_N_m) && is_stiffness(parts_.body_stiffness_N_m) &&
         within(parts_.body_point_rest_m, kFarthest_m) && within(parts_.body_target_world_m, kFarthest_m);
}

}  // namespace myotact::net
