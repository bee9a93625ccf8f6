#include "device/placed_device.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/LU>
#include <fmt/format.h>

namespace myotact::device {

namespace {

constexpr double kSmallestScale = 0.05, kLargestScale = 20.0;
constexpr double kLargestBubble_m = 1.0;  // no arm on a table reaches further
/// Half a radius outside the bubble the middle moves at a walking hand's pace through the world; it grows with the
/// cube.
constexpr double kPaceHalfOut_m_s = 0.05;
constexpr double kFastestPace_m_s = 0.3;  // well below the gate's cut-off, 1 m/s of the hand
constexpr double kFelt_N = 0.05;          // about what a fingertip on a stylus notices
constexpr double kLongestTick_s = 5e-3;   // after a pause the middle does not jump

void check(const Placement& placement) {
  if (!(placement.scale >= kSmallestScale && placement.scale <= kLargestScale)) {
    throw std::invalid_argument(
        fmt::format("a motion scale of {}; must be in {} .. {}", placement.scale, kSmallestScale, kLargestScale));
  }
  if (!(placement.bubble_radius_m >= 0.0 && placement.bubble_radius_m <= kLargestBubble_m)) {
    throw std::invalid_argument(
        fmt::format("a bubble of {} m; must be in 0 .. {} m", placement.bubble_radius_m, kLargestBubble_m));
  }
  const Mat3& rotation = placement.world_from_device;
  if (!((rotation * rotation.transpose() - Mat3::Identity()).norm() < 1e-9 && rotation.determinant() > 0.0 &&
        placement.middle_world_m.allFinite())) {
    throw std::invalid_argument("a device's placement must be a rotation matrix and a finite point");
  }
}

DeviceProfile as_the_world_sees(DeviceProfile profile, double scale) {
  profile.max_stiffness_N_m /= scale;
  profile.inertia_kg /= scale;
  profile.viscous_Ns_m /= scale;
  profile.resolution_m *= scale;
  profile.motion_scale *= scale;
  for (double& edge_m : profile.workspace_m) edge_m *= scale;
  return profile;
}

}  // namespace

PlacedDevice::PlacedDevice(HardwareDevice& device, const Placement& placement)
    : device_(device),
      placement_(placement),
      middle_m_(placement.middle_world_m),
      rotations_(placement.world_from_device) {
  check(placement);
  profile_ = as_the_world_sees(device.profile(), placement.scale);
}

void PlacedDevice::open() {
  device_.open();
  profile_ = as_the_world_sees(device_.profile(), placement_.scale);
}

void PlacedDevice::follow_rotation(const Vec3& on_table_m) noexcept {
  rotations_.update();
  if (feels_force_ || rotations_.front() == rotation()) return;
  const Vec3 tool_m = in_world(on_table_m);
  placement_.world_from_device = rotations_.front();
  middle_m_ = tool_m - placement_.scale * (rotation() * on_table_m);
}

void PlacedDevice::follow_clutch(bool clutched, const Vec3& on_table_m) noexcept {
  if (clutched && !is_clutched_) held_at_m_ = in_world(on_table_m);
  if (clutched) middle_m_ = held_at_m_ - placement_.scale * (rotation() * on_table_m);
  is_clutched_ = clutched;
}

void PlacedDevice::drive_bubble(const Vec3& on_table_m, double dt_s) noexcept {
  const double radius_m = placement_.bubble_radius_m, way_m = on_table_m.norm();
  if (radius_m <= 0.0 || way_m <= radius_m || feels_force_) return;
  const double out = (way_m - radius_m) / (0.5 * radius_m);
  const double slower = std::min(1.0, placement_.scale);  // as the gate's cut-off is
  const double pace_m_s = slower * std::min(kFastestPace_m_s, kPaceHalfOut_m_s * out * out * out);
  middle_m_ += (pace_m_s * dt_s / way_m) * (rotation() * on_table_m);
}

messages::DeviceState PlacedDevice::read(std::uint64_t now_ns) noexcept {
  messages::DeviceState state = device_.read(now_ns);
  if (asked_clutch_) state.buttons |= messages::kClutchButton;
  const Vec3 on_table_m = to_vec3(state.stylus_position_world_m);
  if (!on_table_m.allFinite()) return state;  // the loop sees what is wrong with it
  const double dt_s = now_ns > last_ns_ ? std::min(1e-9 * static_cast<double>(now_ns - last_ns_), kLongestTick_s) : 0.0;
  last_ns_ = now_ns;
  follow_rotation(on_table_m);
  follow_clutch((state.buttons & messages::kClutchButton) != 0, on_table_m);
  if (device_.connected() && !is_clutched_)
    drive_bubble(on_table_m, dt_s);  // a place from before it was lost drives nothing
  const Vec3 velocity_m_s = placement_.scale * (rotation() * to_vec3(state.stylus_velocity_world_m_s));
  state.stylus_position_world_m = to_array(is_clutched_ ? held_at_m_ : in_world(on_table_m));
  state.stylus_velocity_world_m_s = to_array(is_clutched_ ? Vec3::Zero() : velocity_m_s);
  return state;
}

void PlacedDevice::write(const messages::DeviceCommand& command) noexcept {
  const Vec3 force_N = to_vec3(command.force_world_N);
  feels_force_ = !(force_N.norm() < kFelt_N);
  device_.write({to_array(rotation().transpose() * force_N)});
}

}  // namespace myotact::device
