#include "device/drivers/spacemouse/spacemouse_device.h"

#include <array>
#include <chrono>
#include <exception>
#include <utility>

namespace myotact::device::spacemouse {

namespace {

/// A quarter of the shortest time between reports: what it adds to their age is small.
constexpr std::chrono::milliseconds kLook(2);
constexpr std::chrono::milliseconds kLookForLost(500);
/// hidraw keeps 64 reports for a reader; taking no more at once keeps close() prompt whatever the device sends.
constexpr int kMostReportsAtOnce = 64;
constexpr std::uint64_t kRateSpan_ns = 1'000'000'000;
constexpr int kWeakBattery_percent = 10;

std::uint64_t steady_ns() {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1));
}

}  // namespace

SpaceMouseDevice::SpaceMouseDevice(std::string name, PortOpener opener, const MotionSettings& settings)
    : name_(std::move(name)), opener_(std::move(opener)), motion_(settings) {
  profile_.shows_force_only = true;
  profile_.resolution_m = 0.0;                          // the lag makes positions continuous
  profile_.continuous_force_N = profile_.peak_force_N;  // no motor that could grow hot
  const double reach_m = settings.mode == MotionMode::Rate ? settings.half_workspace_m : settings.full_offset_m;
  profile_.workspace_m.fill(2.0 * reach_m);
}

void SpaceMouseDevice::open() {
  if (thread_.joinable()) return;
  port_ = opener_();
  port_->write(light_report(true));  // models without a light refuse it
  cap_ = {};
  caps_.publish(cap_);
  counted_from_ns_ = steady_ns();
  reports_ = 0;
  closing_ = false;
  try {
    thread_ = std::thread([this] { watch(); });
  } catch (...) {
    port_.reset();
    throw;
  }
  phase_ = DevicePhase::Ready;
}

void SpaceMouseDevice::close() noexcept {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  thread_.join();
  phase_ = DevicePhase::Closed;
  rate_Hz_ = 0.0;
  if (port_ != nullptr) port_->write(light_report(false));
  port_.reset();
}

void SpaceMouseDevice::watch() {
  std::unique_lock lock(mutex_);
  while (!closing_) {
    lock.unlock();
    if (port_ != nullptr) {
      take_reports();
    } else {
      find_again();
    }
    count_rate();
    lock.lock();
    wake_.wait_for(lock, port_ != nullptr ? kLook : kLookForLost, [this] { return closing_; });
  }
}

void SpaceMouseDevice::take_reports() {
  std::array<std::uint8_t, kLongestReport> bytes{};
  bool is_new = false;
  for (int i = 0; i < kMostReportsAtOnce; ++i) {
    const int length = port_->read(bytes);
    if (length < 0) return lose();
    if (length == 0) break;
    ++reports_;
    is_new |= apply_report(std::span(bytes).first(static_cast<std::size_t>(length)), cap_);
  }
  if (!is_new) return;
  caps_.publish(cap_);
  battery_percent_ = cap_.battery_percent;
}

void SpaceMouseDevice::lose() {
  phase_ = DevicePhase::Lost;
  port_.reset();
  cap_ = {};
  caps_.publish(cap_);
}

void SpaceMouseDevice::find_again() {
  try {
    port_ = opener_();
  } catch (const std::exception&) {
    return;  // not plugged in yet
  }
  port_->write(light_report(true));
  phase_ = DevicePhase::Ready;
}

void SpaceMouseDevice::count_rate() {
  const std::uint64_t now_ns = steady_ns();
  if (now_ns - counted_from_ns_ < kRateSpan_ns) return;
  rate_Hz_ = 1e9 * reports_ / static_cast<double>(now_ns - counted_from_ns_);
  counted_from_ns_ = now_ns;
  reports_ = 0;
}

messages::DeviceState SpaceMouseDevice::read(std::uint64_t now_ns) noexcept {
  caps_.update();
  const double dt_s = started_ && now_ns > last_ns_ ? 1e-9 * static_cast<double>(now_ns - last_ns_) : 0.0;
  started_ = true;
  last_ns_ = now_ns;
  if (!connected()) {
    motion_.halt();
    return {to_array(motion_.position_m()), {}, now_ns, 0};
  }
  const Cap& cap = caps_.front();
  motion_.advance(cap, dt_s);
  return {to_array(motion_.position_m()), to_array(motion_.velocity_m_s()), now_ns, stylus_buttons(cap.keys)};
}

DeviceReport SpaceMouseDevice::report() const noexcept {
  DeviceReport report;
  report.phase = phase_;
  report.rate_Hz = rate_Hz_;
  const int battery_percent = battery_percent_;
  if (report.phase == DevicePhase::Lost) {
    report.hint = "Plug the SpaceMouse in again.";
  } else if (battery_percent >= 0 && battery_percent < kWeakBattery_percent) {
    report.hint = "Charge the SpaceMouse.";
  }
  return report;
}

}  // namespace myotact::device::spacemouse
