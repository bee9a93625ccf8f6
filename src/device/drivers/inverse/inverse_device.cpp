#include "device/drivers/inverse/inverse_device.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "device/drivers/inverse/greeting.h"
#include "realtime/real_time_thread.h"

namespace myotact::device::inverse {

namespace {

/// Then the connection is made anew: a service that was restarted may have left the old one open.
constexpr std::uint64_t kLongestSilence_ns = 1'000'000'000;
constexpr std::chrono::milliseconds kTryAgain(500);

std::uint64_t steady_ns() {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1));
}

}  // namespace

InverseDevice::InverseDevice(std::string name, std::string id, std::size_t place, const InverseSettings& settings,
                             std::unique_ptr<ServiceLink> link)
    : name_(std::move(name)),
      id_(std::move(id)),
      settings_(settings),
      link_(std::move(link)),
      exchange_(id_, place, settings) {}

void InverseDevice::open() {
  if (thread_.joinable()) return;
  const Greeting greeting = greet(*link_, settings_);
  const auto& devices = greeting.inventory.devices;
  if (std::none_of(devices.begin(), devices.end(), [&](const DeviceEntry& entry) { return entry.id == id_; })) {
    link_->close();
    throw ServiceError(fmt::format("the Inverse Service no longer knows the Inverse3 {}", id_),
                       "check its power and its USB cable");
  }
  exchange_.begin(greeting.form, steady_ns());
  is_linked_ = true;
  closing_ = false;
  try {
    thread_ = std::thread([this] { talk(); });
  } catch (...) {
    link_->close();
    exchange_.end(DevicePhase::Closed);
    throw;
  }
}

void InverseDevice::close() noexcept {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void InverseDevice::talk() {
  realtime::name_this_thread("inverse");
  realtime::make_this_thread_real_time();  // where it is refused, forces come as late as the system lets them
  std::string text;
  while (!is_closing()) {
    if (is_linked_ && !is_alive(text)) {
      is_linked_ = false;
      link_->close();
      exchange_.end(DevicePhase::Lost);
    }
    if (!is_linked_ && !wait_or_closing()) connect_again();
  }
  say_goodbye();
}

/// As exchange_once(); whatever it throws, as for want of memory, ends the connection and not the program.
bool InverseDevice::is_alive(std::string& text) noexcept {
  try {
    return exchange_once(text);
  } catch (const std::exception&) {
    return false;
  }
}

/// Sends a command when one is due and takes what comes until the next is. False: the connection has ended.
bool InverseDevice::exchange_once(std::string& text) {
  std::uint64_t now_ns = steady_ns();
  if (now_ns >= exchange_.due_ns() && !link_->send(exchange_.next_command(now_ns))) return false;
  now_ns = steady_ns();
  const std::uint64_t due_ns = exchange_.due_ns();
  const auto wait = std::chrono::nanoseconds(due_ns > now_ns ? std::min(due_ns - now_ns, kSilence_ns) : 0);
  const LinkEvent event = link_->receive(text, wait);
  now_ns = steady_ns();
  if (event == LinkEvent::Message) exchange_.take(text, now_ns);
  return event != LinkEvent::Ended && exchange_.silence_ns(now_ns) < kLongestSilence_ns;
}

void InverseDevice::connect_again() {
  try {
    const Greeting greeting = greet(*link_, settings_);
    exchange_.begin(greeting.form, steady_ns());
    is_linked_ = true;
  } catch (const std::exception&) {
    link_->close();  // not yet
  }
}

bool InverseDevice::wait_or_closing() {
  std::unique_lock lock(mutex_);
  return wake_.wait_for(lock, kTryAgain, [this] { return closing_; });
}

bool InverseDevice::is_closing() {
  const std::lock_guard lock(mutex_);
  return closing_;
}

/// The last command is one of zero force, and the service has read it.
void InverseDevice::say_goodbye() noexcept {
  exchange_.end(DevicePhase::Closed);
  try {
    std::string text;
    if (is_linked_ && link_->send(exchange_.next_command(steady_ns()))) {
      link_->receive(text, std::chrono::nanoseconds(kSilence_ns));
    }
  } catch (const std::exception&) {  // out of memory: the service idles the device by itself
  }
  is_linked_ = false;
  link_->close();
}

}  // namespace myotact::device::inverse
