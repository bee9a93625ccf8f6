#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "device/drivers/inverse/messages.h"
#include "device/drivers/inverse/settings.h"
#include "device/hardware_device.h"
#include "realtime/latest_value.h"

namespace myotact::device::inverse {

/// Silence of the service beyond which there is no force.
inline constexpr std::uint64_t kSilence_ns = 30'000'000;
/// Between commands: up to 5000 exchanges a second, more than the 1000 ticks need and less than a processor's time.
inline constexpr std::uint64_t kExchange_ns = 200'000;
/// States in a row without a fault, all answered by zero force, before Ready.
inline constexpr int kGoodBeforeReady = 10;

/// The talk with one Inverse3 without sockets and clocks: what every message, silence and tick does to the device's
/// phase and to the force that is sent.
///
///   service --state--> take() --Sample (newest)--> read()  haptic tick
///   service <-command- next_command() <--Answer (newest)-- write()
///
/// A sample has the epoch of the Ready phase in which it came, an answer that of the sample it answers: a force is sent
/// only when it answers a sample, at most 20 ms old, of the phase that still lasts. Every fault ends the phase.
class Exchange {
 public:
  /// `id` of the device, `place` of its grip in the list of grips.
  Exchange(std::string id, std::size_t place, const InverseSettings& settings);

  // ---- I/O thread; times are the steady clock [ns] and never run backwards
  /// A connection is open, commands take this form (not ByVersion).
  void begin(CommandForm form, std::uint64_t now_ns);
  /// A message came: any bytes. What is wrong with it; empty: nothing.
  std::string take(std::string_view text, std::uint64_t now_ns);
  /// The connection has ended: Lost, or Closed when we ended it.
  void end(DevicePhase phase);
  /// To be called at least every kSilence_ns: notices silence. The time since a state was heard.
  std::uint64_t silence_ns(std::uint64_t now_ns);
  /// When the next command is due. Where an answer fails to come for kSilence_ns, one of no force; then none until the
  /// service has answered both, or one and then nothing for as long: it is never behind.
  std::uint64_t due_ns() const;
  /// The command to send now; valid until the next call.
  const std::string& next_command(std::uint64_t now_ns);

  // ---- haptic tick, real-time safe
  messages::DeviceState read(std::uint64_t now_ns) noexcept;
  void write(const messages::DeviceCommand& command) noexcept;

  // ---- any thread
  bool connected() const noexcept { return is_fresh_ && phase_ == DevicePhase::Ready; }
  DeviceReport report() const noexcept;

 private:
  /// In the device's frame.
  struct Sample {
    std::array<double, 3> position_m{};
    std::array<double, 3> velocity_m_s{};
    std::uint32_t buttons = 0;
    std::uint64_t received_ns = 0;
    std::uint64_t epoch = 0;  // 0: not Ready
  };
  struct Answer {
    std::array<double, 3> force_N{};
    std::uint64_t received_ns = 0;  // of the sample
    std::uint64_t epoch = 0;        // of the sample
  };

  std::string take_device(const DeviceEntry& device, std::uint64_t now_ns);
  void fault(const char* hint);
  Vec3 force_to_send_N(std::uint64_t now_ns);
  void count(std::uint64_t now_ns);

  const std::string id_;
  const std::size_t place_;
  const InverseSettings settings_;

  std::atomic<DevicePhase> phase_{DevicePhase::Closed};
  std::atomic<const char*> hint_{""};
  std::atomic<double> rate_Hz_{0.0};
  std::atomic<bool> is_fresh_{false};
  realtime::LatestValue<Sample> samples_;
  realtime::LatestValue<Answer> answers_;

  // ---- I/O thread
  CommandForm form_ = CommandForm::Vector;
  ServiceMessage message_;
  std::string command_;
  Sample sample_;
  Vec3 position_service_m_ = Vec3::Zero();       // not a number until this connection reported it
  std::uint64_t epoch_ = 0;                      // of the Ready phases
  int good_ = 0;                                 // states in a row without a fault
  int owed_ = 0;                                 // commands that the service has not answered
  std::uint64_t sent_ns_ = 0, answered_ns_ = 0;  // the newest command, the newest message
  std::uint64_t heard_ns_ = 0;
  std::uint64_t counted_from_ns_ = 0;
  int exchanges_ = 0;  // since then
};

}  // namespace myotact::device::inverse
