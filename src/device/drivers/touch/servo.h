#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "device/device.h"
#include "device/drivers/touch/hdapi.h"

namespace myotact::device::touch {

/// One device in the servo thread.
class ServoClient {
 public:
  virtual ~ServoClient() = default;
  /// Before the first frame, not in the servo thread: opens the device anew where it was lost. `hung`: the servo thread
  /// did not end its last frame. Throws Error Unavailable.
  virtual void recover(bool hung) = 0;
  virtual void begin_frame(std::uint64_t now_ns) noexcept = 0;
  /// `is_last`: no force from here on.
  virtual void end_frame(bool is_last) noexcept = 0;
};

/// The scheduler of the maker's library, which a process has once: in each of its ticks all devices begin their frames,
/// our loops tick, and all end their frames.
///
///   servo thread: begin_frame of each --> tick --> end_frame of each
class Servo : public ServoClock {
 public:
  explicit Servo(const Hdapi& api) : api_(api) {}  // outlives this
  ~Servo() override { stop(); }

  void start(std::function<void(std::uint64_t now_ns)> tick) override;
  void stop() noexcept override;
  bool is_ticking() const noexcept { return is_ticking_; }

  bool is_in_use() const noexcept { return !clients_.empty(); }

  /// While it does not tick; remove() stops it.
  void add(ServoClient& client);
  void remove(ServoClient& client) noexcept;

 private:
  static unsigned int on_tick(void* self) noexcept;
  void tick() noexcept;

  const Hdapi& api_;
  std::vector<ServoClient*> clients_;
  std::function<void(std::uint64_t)> tick_;
  unsigned long handle_ = 0;
  std::atomic<bool> is_ticking_{false};
  std::atomic<bool> has_ticked_{false};
  std::atomic<bool> stopping_{false};
  std::atomic<bool> sent_last_{false};
  bool hung_ = false;
};

}  // namespace myotact::device::touch
