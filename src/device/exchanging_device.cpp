#include "device/exchanging_device.h"

#include <chrono>
#include <utility>

#include "realtime/real_time_thread.h"

namespace myotact::device {

namespace {

constexpr std::uint64_t kPoseLife_ns = 30'000'000;  // as the force gate takes a stale model
constexpr std::uint64_t kRateWindow_ns = 1'000'000'000;
constexpr auto kLookAgain = std::chrono::milliseconds(500);

}  // namespace

ExchangingDevice::ExchangingDevice(std::string name, std::string thread_name)
    : name_(std::move(name)), thread_name_(std::move(thread_name)) {}

void ExchangingDevice::open() {
  if (thread_.joinable()) return;
  phase_ = DevicePhase::Opening;
  stopping_ = false;
  bool is_connected = false;
  try {
    connect();
    is_connected = true;
    thread_ = std::thread([this] {
      realtime::name_this_thread(thread_name_.c_str());
      realtime::make_this_thread_real_time();
      run();
    });
  } catch (...) {
    if (is_connected) disconnect();
    phase_ = DevicePhase::Closed;
    throw;
  }
}

void ExchangingDevice::close() noexcept {
  if (!thread_.joinable()) return;
  stopping_ = true;
  thread_.join();
  disconnect();
  phase_ = DevicePhase::Closed;
  is_ready_ = false;
}

void ExchangingDevice::run() noexcept {
  for (;;) {
    exchange_until_gone();
    leave_gone();
    if (stopping_) return;
    publish({}, DevicePhase::Lost);
    rate_Hz_ = 0.0;
    while (!reopen()) {
      if (stopping_) return;
      std::this_thread::sleep_for(kLookAgain);
    }
  }
}

void ExchangingDevice::publish(const messages::DeviceState& state, DevicePhase phase) noexcept {
  phase_ = phase;
  poses_.publish({state, phase == DevicePhase::Ready});
}

const WantedForce& ExchangingDevice::wanted() noexcept {
  forces_.update();
  return forces_.front();
}

messages::DeviceState ExchangingDevice::read(std::uint64_t now_ns) noexcept {
  read_ns_ = now_ns;
  poses_.update();
  const Pose& pose = poses_.front();
  const std::uint64_t at_ns = pose.state.sampled_at_ns;
  is_ready_ = pose.is_ready && (now_ns < at_ns || now_ns - at_ns <= kPoseLife_ns);
  return pose.state;
}

void ExchangingDevice::write(const messages::DeviceCommand& command) noexcept {
  forces_.publish({is_ready_ ? command.force_world_N : std::array<double, 3>{}, read_ns_});
}

bool ExchangeRate::count(std::uint64_t exchanges, std::uint64_t now_ns) noexcept {
  if (now_ns - since_ns_ < kRateWindow_ns) return false;
  rate_Hz_ = 1e9 * static_cast<double>(exchanges - counted_) / static_cast<double>(now_ns - since_ns_);
  since_ns_ = now_ns;
  counted_ = exchanges;
  return true;
}

}  // namespace myotact::device
