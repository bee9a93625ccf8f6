#include "net/readings_codec.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "net/byte_cursor.h"

namespace myotact::net {

namespace {

using messages::JointFrame;
using messages::MuscleJointFrame;
using messages::SceneFrame;
using messages::ToolFrame;

// One list of fields for both directions: a Put or Get visits them in the order of the wire.

class Put {
 public:
  explicit Put(Bytes& out) : out_(out) {}

  template <typename T>
  void number(const T& value) {
    out_.put(value);
  }
  void flag(bool value) { out_.put(static_cast<std::uint8_t>(value ? 1 : 0)); }
  void text(const std::string& value) {
    const auto size = static_cast<std::uint16_t>(std::min<std::size_t>(value.size(), 0xFFFF));
    out_.put(size);
    out_.put_bytes(reinterpret_cast<const std::uint8_t*>(value.data()), size);
  }
  /// A count, then each element by `visit`.
  template <typename T, typename Visit>
  void list(const std::vector<T>& values, std::size_t, const Visit& visit) {
    out_.put(static_cast<std::uint16_t>(values.size()));
    for (const T& value : values) visit(value);
  }

 private:
  ByteWriter out_;
};

class Get {
 public:
  explicit Get(std::span<const std::uint8_t> payload) : in_(payload) {}

  template <typename T>
  void number(T& value) {
    in_.get(value);
  }
  void flag(bool& value) {
    std::uint8_t byte = 0;
    in_.get(byte);
    sound_ = sound_ && byte <= 1;
    value = byte != 0;
  }
  void text(std::string& value) {
    std::uint16_t size = 0;
    in_.get(size);
    const auto bytes = in_.take(size);
    sound_ = sound_ && is_utf8(bytes);
    value.assign(bytes.begin(), bytes.end());
  }
  /// `least`: bytes of an element, so that a count cannot ask for more room than there are bytes.
  template <typename T, typename Visit>
  void list(std::vector<T>& values, std::size_t least, const Visit& visit) {
    std::uint16_t count = 0;
    in_.get(count);
    sound_ = sound_ && count * least <= in_.left();
    values.resize(sound_ ? count : 0);
    for (T& value : values) visit(value);
  }
  bool done() const { return sound_ && in_.done(); }

 private:
  ByteReader in_;
  bool sound_ = true;
};

template <typename Cursor, typename Joint>
void visit_joint(Cursor& cursor, Joint& joint) {
  cursor.number(joint.angle_rad);
  cursor.number(joint.torque_Nm);
  cursor.number(joint.stiffness_Nm_rad);
  cursor.flag(joint.preview);
  cursor.number(joint.passive_Nm_rad);
  cursor.number(joint.contact_Nm_rad);
  constexpr std::size_t kMuscleBytes = 40;
  cursor.list(joint.muscles, kMuscleBytes, [&](auto& part) {
    cursor.number(part.torque_Nm);
    cursor.number(part.stiffness_Nm_rad);
    cursor.number(part.line_muscle_Nm_rad);
    cursor.number(part.line_geometry_Nm_rad);
    cursor.number(part.moment_arm_m);
  });
}

template <typename Cursor, typename Tool>
void visit_tool(Cursor& cursor, Tool& tool, std::uint8_t& shape) {
  cursor.number(tool.tool_world_m);
  cursor.number(tool.proxy_world_m);
  cursor.number(tool.force_world_N);
  cursor.number(tool.radius_m);
  cursor.number(shape);
  cursor.flag(tool.left);
  cursor.flag(tool.in_contact);
  cursor.flag(tool.forces_stopped);
  cursor.number(tool.grabbed_line);
  cursor.number(tool.grabbed_body);
  cursor.number(tool.grip_world_m);
  cursor.number(tool.touched_muscle);
  cursor.number(tool.touched_body);
  auto& parts = tool.parts;
  for (auto* part : {&parts.contact, &parts.friction, &parts.texture, &parts.line, &parts.bone, &parts.tether,
                     &parts.damping, &parts.limits}) {
    cursor.number(*part);
  }
  cursor.number(tool.line_tension_N);
  cursor.number(tool.force_scale);
  cursor.number(tool.motion_scale);
  cursor.number(tool.model_age_s);
}

template <typename Cursor, typename Frame>
void visit_frame(Cursor& cursor, Frame& frame) {
  constexpr std::size_t kNumber = 8, kPoint = 24, kJointBytes = 43, kLineBytes = 2;
  const auto number = [&](auto& value) { cursor.number(value); };
  cursor.number(frame.sequence);
  cursor.number(frame.time_s);
  cursor.number(frame.residual_share);
  for (auto* values :
       {&frame.activations, &frame.tensions_N, &frame.stretches, &frame.volume_ratios, &frame.smallest_volume_ratios}) {
    cursor.list(*values, kNumber, number);
  }
  cursor.list(frame.lines_world_m, kLineBytes, [&](auto& line) { cursor.list(line, kPoint, number); });
  cursor.list(frame.springs_world_m, 2 * kPoint, number);
  cursor.list(frame.joints, kJointBytes, [&](auto& joint) { visit_joint(cursor, joint); });
  cursor.number(frame.rates.simulation_hz);
  cursor.number(frame.rates.haptic_hz);
  cursor.number(frame.rates.missed_ticks);
  cursor.number(frame.rates.time_factor);
  cursor.text(frame.notice);
}

constexpr std::size_t kToolBytes = 300;  // at least

}  // namespace

void encode_readings(const SceneFrame& frame, Bytes& out) {
  Put put(out);
  visit_frame(put, frame);
  put.list(frame.tools, kToolBytes, [&](const ToolFrame& tool) {
    auto shape = static_cast<std::uint8_t>(tool.shape);
    visit_tool(put, tool, shape);
  });
}

bool decode_readings(std::span<const std::uint8_t> payload, SceneFrame& frame) {
  Get get(payload);
  bool shapes_known = true;
  visit_frame(get, frame);
  get.list(frame.tools, kToolBytes, [&](ToolFrame& tool) {
    std::uint8_t shape = 0;
    visit_tool(get, tool, shape);
    shapes_known = shapes_known && shape <= static_cast<std::uint8_t>(messages::ToolShape::Clamp);
    tool.shape = static_cast<messages::ToolShape>(shapes_known ? shape : 0);
  });
  return shapes_known && get.done();
}

}  // namespace myotact::net
