#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "core/vector.h"
#include "device/drivers/falcon/packet.h"
#include "device/drivers/falcon/transport.h"

namespace myotact::device::falcon {

enum class Fault { None, NoReply, StatusOnly, Split, TwoAtOnce, GarbageBefore, HomedDrops, EncoderLeaps, Stall, Gone };

/// A Falcon in software, made from the published protocol, without anything of the maker's: it greets, echoes its
/// upload, homes, and answers each command by where a virtual hand holds the grip. Its clock is virtual: a millisecond
/// a wait.
class FakeFalcon : public Transport {
 public:
  // ---- what the test does with it
  void hold(const Vec3& grip_m) { grip_m_ = grip_m; }  // in the frame of the legs
  void home() { was_at_stops_ = true; }
  void boot_with_firmware() { runs_ = true; }
  /// Its processor goes blank; the serial chip, which has the cable's power, stays.
  void lose_power() {
    runs_ = was_greeted_ = was_at_stops_ = false;
    uploaded_.clear();
    to_host_.clear();
    last_ = {};
  }
  void spoil_block(int block) { spoiled_block_ = block; }
  void greet_with_zero() { greets_with_zero_ = true; }
  void set(Fault fault) { fault_ = fault; }
  void press(std::uint8_t buttons) { buttons_ = buttons; }
  void pass(std::uint64_t duration_ns) { now_ns_ += duration_ns; }

  // ---- what it found
  std::uint64_t now_ns() const { return now_ns_; }
  static std::uint64_t clock(void* fake) { return static_cast<FakeFalcon*>(fake)->now_ns(); }
  const std::vector<std::uint8_t>& uploaded() const { return uploaded_; }
  /// What the motors push with at the grip, by the counts of the newest command [N].
  Vec3 force_N(double counts_per_Nm) const;
  const Command& last_command() const { return last_; }
  int commands() const { return commands_; }

  bool request(std::uint8_t number, std::uint16_t value) noexcept override;
  bool send(std::span<const std::uint8_t> bytes) noexcept override;
  std::size_t receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept override;
  bool is_gone() const noexcept override { return fault_ == Fault::Gone; }

 private:
  void answer(std::vector<std::uint8_t> payload);
  void answer_command(const Packet& packet);
  void take_upload(std::span<const std::uint8_t> bytes);
  Report report() const;

  std::deque<std::vector<std::uint8_t>> to_host_;
  std::vector<std::uint8_t> uploaded_;
  Vec3 grip_m_{0.0, 0.0, 0.125};
  Command last_;
  std::uint16_t baud_ = 0;
  std::uint64_t now_ns_ = 1'000'000'000;
  Fault fault_ = Fault::None;
  std::uint8_t buttons_ = 0;
  int commands_ = 0, blocks_ = 0, spoiled_block_ = -1;
  bool runs_ = false, was_greeted_ = false, was_at_stops_ = false, greets_with_zero_ = false;
};

}  // namespace myotact::device::falcon
