#include "net/control_state_codec.h"

#include "net/byte_cursor.h"

namespace myotact::net {

namespace {

using messages::Commander;
using messages::ControlState;
using messages::Drive;

constexpr std::uint8_t kHoldPosture = 1, kGravity = 2, kPaused = 4, kRecording = 8;

bool is_between(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;  // false for what is not a number
}

}  // namespace

void encode_control_state(const ControlState& state, Bytes& out) {
  ByteWriter writer(out);
  writer.put(static_cast<std::uint8_t>(state.drive));
  writer.put(static_cast<std::uint8_t>(state.driver));
  writer.put(static_cast<std::uint8_t>((state.hold_posture ? kHoldPosture : 0) | (state.gravity ? kGravity : 0) |
                                       (state.paused ? kPaused : 0) | (state.recording ? kRecording : 0)));
  for (const double level : {state.flexors, state.extensors, state.common, state.difference, state.common_now}) {
    writer.put(level);
  }
}

bool decode_control_state(std::span<const std::uint8_t> payload, ControlState& state) {
  ByteReader in(payload);
  ControlState read;
  std::uint8_t drive = 0, driver = 0, flags = 0;
  in.get(drive);
  in.get(driver);
  in.get(flags);
  for (double* level : {&read.flexors, &read.extensors, &read.common, &read.difference, &read.common_now}) {
    in.get(*level);
  }
  const bool levels_fit = is_between(read.flexors, 0.0, 1.0) && is_between(read.extensors, 0.0, 1.0) &&
                          is_between(read.common, 0.0, 1.0) && is_between(read.difference, -1.0, 1.0) &&
                          is_between(read.common_now, 0.0, 1.0);
  const bool sound = in.done() && levels_fit && drive <= static_cast<std::uint8_t>(Drive::Balance) &&
                     driver <= static_cast<std::uint8_t>(Commander::Network) && flags < 2 * kRecording;
  if (!sound) return false;
  read.drive = static_cast<Drive>(drive);
  read.driver = static_cast<Commander>(driver);
  read.hold_posture = (flags & kHoldPosture) != 0;
  read.gravity = (flags & kGravity) != 0;
  read.paused = (flags & kPaused) != 0;
  read.recording = (flags & kRecording) != 0;
  state = read;
  return true;
}

}  // namespace myotact::net
