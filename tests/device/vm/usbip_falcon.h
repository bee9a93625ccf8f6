#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "device/drivers/falcon/fake_falcon.h"

namespace myotact::device::falcon {

/// A Falcon in software on the kernel's own virtual USB host controller (vhci_hcd), by the protocol of usbip: the
/// kernel asks for transfers on one end of a socket, this answers on the other.
class UsbipFalcon {
 public:
  /// Plugs it in. Throws std::runtime_error: no such controller, or no right to use it.
  UsbipFalcon();
  ~UsbipFalcon();
  UsbipFalcon(const UsbipFalcon&) = delete;
  UsbipFalcon& operator=(const UsbipFalcon&) = delete;

  /// As when the cable is pulled.
  void unplug();

  template <typename Use>
  auto with(Use&& use) {
    const std::lock_guard lock(mutex_);
    return use(fake_);
  }

 private:
  static constexpr std::size_t kHeaderBytes = 48;
  using Header = std::array<std::uint8_t, kHeaderBytes>;

  void run();
  bool take_request();
  void submit(const Header& header, const std::vector<std::uint8_t>& sent);
  std::vector<std::uint8_t> control(const Header& header, std::uint32_t& status);
  void unlink(const Header& header);
  void give_receipts();
  void answer(std::uint32_t sequence, std::uint32_t status, std::span<const std::uint8_t> data, std::uint32_t length);
  void say(std::span<const std::uint8_t> bytes);
  bool read_all(std::span<std::uint8_t> bytes) const;

  int ours_ = -1, kernels_ = -1;
  std::mutex mutex_;
  FakeFalcon fake_;
  struct Receipt {
    std::uint32_t sequence, length;
  };
  std::deque<Receipt> receipts_;  // that the kernel waits for
  std::chrono::steady_clock::time_point last_receipt_;
  std::chrono::milliseconds latency_{16};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace myotact::device::falcon
