#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include "core/vector.h"
#include "device/hardware_device.h"
#include "realtime/latest_value.h"

namespace myotact::device {

/// How the workspace of a device lies in the world.
struct Placement {
  /// A rotation: columns are the device's right, up and towards the person. At first; ask_rotation() changes it.
  Mat3 world_from_device = Mat3::Identity();
  Vec3 middle_world_m = Vec3::Zero();  // where the middle of the workspace lies at first
  double scale = 1.0;                  // metres in the world for a metre on the table, 0.05 .. 20
  /// Radius on the table within which the hand moves the tool, and beyond which it drives the workspace through the
  /// world, ever faster; 0: the workspace stays, and only the clutch takes it further.
  double bubble_radius_m = 0.0;
};

/// A device on the table as one in the world: rotated, scaled, moved on by clutch and bubble.
///
/// Rotation (ask_rotation): the workspace rotates about the tool, which stays where it is, as soon as no force is felt:
/// one that rotated under the hand would do work that no hand did.
///
/// Clutch (kClutchButton held): the tool stays, the hand goes back to where it has room. Bubble (Dominjon et al. 2005,
/// after its idea): outside the radius the middle moves outwards with a speed that grows with the cube of the distance
/// beyond it. The middle rests while a force is felt: it would do work on the tissue that no hand did.
///
/// The force on the table is the force in the world. A step on the table is `scale` steps in the world, so that what
/// the world calls stiffness, damping and inertia of this device are its own divided by the scale: profile() returns
/// these, and every bound made from it holds on the table; the gate's own of speed and energy by motion_scale. A
/// constant scale keeps a passive force passive: both works differ by that factor.
class PlacedDevice : public Device {
 public:
  /// `device` outlives this. Throws std::invalid_argument: a scale or radius out of its range, no rotation.
  PlacedDevice(HardwareDevice& device, const Placement& placement);

  const std::string& name() const override { return device_.name(); }
  const DeviceProfile& profile() const override { return profile_; }  // as the world sees it
  void open() override;  // afterwards profile() has what the device reported of itself
  void close() noexcept override { device_.close(); }
  bool connected() const noexcept override { return device_.connected(); }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override;
  void write(const messages::DeviceCommand& command) noexcept override;

  /// Any thread. Held: as if the device's own clutch button were down, for devices that have too few.
  void ask_clutch(bool held) noexcept { asked_clutch_ = held; }
  /// One thread, any: from then on the hand's right, up and towards the person are these columns of a rotation, as of a
  /// view that was rotated.
  void ask_rotation(const Mat3& world_from_device) noexcept { rotations_.publish(world_from_device); }
  /// Any thread: whether the last read() found it held, here or on the device.
  bool is_clutched() const noexcept { return is_clutched_; }

 private:
  void follow_rotation(const Vec3& on_table_m) noexcept;
  void follow_clutch(bool clutched, const Vec3& on_table_m) noexcept;
  void drive_bubble(const Vec3& on_table_m, double dt_s) noexcept;
  Vec3 in_world(const Vec3& on_table_m) const { return middle_m_ + placement_.scale * (rotation() * on_table_m); }
  const Mat3& rotation() const { return placement_.world_from_device; }

  HardwareDevice& device_;
  Placement placement_;
  DeviceProfile profile_;
  Vec3 middle_m_;  // of the workspace, in the world
  Vec3 held_at_m_ = Vec3::Zero();
  realtime::LatestValue<Mat3> rotations_;
  std::atomic<bool> asked_clutch_{false};
  std::atomic<bool> is_clutched_{false};
  bool feels_force_ = false;
  std::uint64_t last_ns_ = 0;
};

}  // namespace myotact::device
