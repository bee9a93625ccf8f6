#pragma once

#include <array>
#include <atomic>
#include <cstddef>

#include "core/vector.h"
#include "realtime/shared_page.h"
#include "realtime/watchdog.h"

namespace myotact::device {

/// The motors of a simulated device, in memory that outlives its process, as a real device's do: the last force acts on
/// until somebody writes another one. Any process and thread; real-time safe.
class SharedMotor : public realtime::ForceCutout {
 public:
  void set_force(const Vec3& force_world_N) noexcept {
    for (int k = 0; k < 3; ++k)
      motor_->force_N[static_cast<std::size_t>(k)].store(force_world_N[k], std::memory_order_release);
  }
  Vec3 force_world_N() const noexcept {
    return {motor_->force_N[0].load(std::memory_order_acquire), motor_->force_N[1].load(std::memory_order_acquire),
            motor_->force_N[2].load(std::memory_order_acquire)};
  }
  void cut() noexcept override { set_force(Vec3::Zero()); }

 private:
  struct Motor {
    std::array<std::atomic<double>, 3> force_N{};
  };
  static_assert(std::atomic<double>::is_always_lock_free);

  realtime::SharedPage<Motor> motor_;
};

/// The motors of the devices in a person's hands: one watchdog takes the force from all of them.
class MotorGroup : public realtime::ForceCutout {
 public:
  SharedMotor& operator[](std::size_t device) noexcept { return motors_[device]; }
  void cut() noexcept override {
    for (SharedMotor& motor : motors_) motor.cut();
  }

 private:
  std::array<SharedMotor, 2> motors_;  // a person has two hands
};

}  // namespace myotact::device
