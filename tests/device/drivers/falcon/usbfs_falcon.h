#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>

#include <umockdev.h>

#include "fake_falcon.h"

namespace myotact::device::falcon {

/// The software Falcon behind the kernel's USB files: what libusb asks of /dev/bus/usb by ioctl is answered here, in a
/// thread of umockdev's. Only under umockdev-wrapper.
class UsbfsFalcon {
 public:
  UsbfsFalcon();
  ~UsbfsFalcon();
  UsbfsFalcon(const UsbfsFalcon&) = delete;
  UsbfsFalcon& operator=(const UsbfsFalcon&) = delete;

  void plug();
  /// As when the cable is pulled: what is queued ends, nothing more is taken.
  void unplug();
  /// The endpoint fails one transfer and takes no more until its halt is cleared, which is to be asked for while
  /// nothing is queued on it: the kernel complains otherwise.
  void stall_in();
  void stall_out();
  /// Another program has the interface.
  void let_another_have_it(bool has);

  template <typename Action>
  auto with(Action action) {
    const std::lock_guard lock(mutex_);
    return action(fake_);
  }
  int cleared_halts() {
    const std::lock_guard lock(mutex_);
    return cleared_halts_;
  }
  /// The most IN transfers that were queued at once.
  std::size_t most_queued() {
    const std::lock_guard lock(mutex_);
    return most_queued_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// A request block that the host has submitted and not yet reaped.
  struct Block {
    UMockdevIoctlClient* client = nullptr;
    UMockdevIoctlData* urb = nullptr;
    UMockdevIoctlData* buffer = nullptr;
    bool is_receipt = false, is_done = false;
  };
  struct Answer {
    long result;
    int error;
  };

  static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, UsbfsFalcon* self);
  static void on_vanished(UMockdevIoctlBase*, UMockdevIoctlClient* client, UsbfsFalcon* self);
  Answer answer(UMockdevIoctlClient* client);
  Answer capabilities(UMockdevIoctlClient* client);
  Answer claim(UMockdevIoctlClient* client);
  Answer submit(UMockdevIoctlClient* client);
  Answer reap(UMockdevIoctlClient* client);
  Answer discard(UMockdevIoctlClient* client);
  Answer clear_halt(UMockdevIoctlClient* client);
  void serve(Block& block);
  void fill_receipt(Block& block);
  static void finish(Block& block, int status, int actual_length);
  static void drop(Block& block);

  std::mutex mutex_;
  FakeFalcon fake_;
  UMockdevTestbed* bed_;
  UMockdevIoctlBase* handler_;
  std::deque<Block> blocks_;
  UMockdevIoctlClient* owner_ = nullptr;  // who has claimed the interface
  Clock::time_point last_receipt_{};
  std::chrono::milliseconds latency_{16};
  std::size_t most_queued_ = 0;
  int cleared_halts_ = 0;
  bool is_plugged_ = false, in_stalls_ = false, in_is_halted_ = false, out_is_halted_ = false, another_has_it_ = false;
};

}  // namespace myotact::device::falcon
