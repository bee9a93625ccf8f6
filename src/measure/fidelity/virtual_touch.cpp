#include "measure/fidelity/virtual_touch.h"

#include <cmath>
#include <numbers>

namespace myotact::measure {

namespace {

constexpr std::uint64_t kTick_ns = 1'000'000, kStep_ns = 10 * kTick_ns;
constexpr double kSide_m = 0.1;
constexpr int kCells = 10;  // 200 triangles, 121 corners: what a model holds

double height_m(const TouchedPatch& patch, double x_m, double y_m) {
  constexpr double kWave_1_m = 2.0 * std::numbers::pi / 0.033;
  return patch.waves ? 2e-3 * std::sin(kWave_1_m * x_m) * std::sin(kWave_1_m * y_m) : 0.0;
}

void write_corners(const TouchedPatch& patch, messages::LocalModel& model) {
  for (int row = 0; row <= kCells; ++row) {
    for (int column = 0; column <= kCells; ++column) {
      const double x_m = kSide_m * (static_cast<double>(column) / kCells - 0.5);
      const double y_m = kSide_m * (static_cast<double>(row) / kCells - 0.5);
      model.current_world_m[static_cast<std::size_t>(model.vertex_count++)] = {x_m, y_m, height_m(patch, x_m, y_m)};
    }
  }
  model.previous_world_m = model.current_world_m;
}

messages::LocalModel model_of(const TouchedPatch& patch) {
  messages::LocalModel model;
  write_corners(patch, model);
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) {
      const int corner = row * (kCells + 1) + column;
      for (const std::array<std::int32_t, 3>& vertices :
           {std::array{corner, corner + 1, corner + kCells + 2}, {corner, corner + kCells + 2, corner + kCells + 1}}) {
        auto& triangle = model.triangles[static_cast<std::size_t>(model.triangle_count)];
        triangle.surface = 0;
        triangle.triangle = model.triangle_count++;
        triangle.vertices = vertices;
      }
    }
  }
  model.coverage_radius_m = 1.0;  // there is nothing else
  if (patch.line) {
    model.line.muscle = 0;
    model.line.proximal_point_world_m = {-0.1, 0.0, 0.04};
    model.line.distal_point_world_m = {0.1, 0.0, 0.04};
    model.line.length_m = 0.2;
    model.line.tension_N = 4.0;
    model.line.stiffness_N_m = 300.0;
  }
  if (patch.bone) {
    model.grip.body = 0;
    model.grip.point_rest_m = model.grip.position_world_m = {0.0, 0.0, 0.06};
  }
  return model;
}

}  // namespace

VirtualTouch::VirtualTouch(const TouchedPatch& patch, const Vec3& start_m, const device::DeviceProfile& profile,
                           const device::HandProfile& hand, const haptics::HapticSettings& settings)
    : device("simulated", start_m, profile, hand), loop(device, settings), model(model_of(patch)), last_m_(start_m) {
  device.set_hand_target({to_array(start_m), {}, 0});
  loop.prepare(now_ns_ = kTick_ns);
  publish();
}

void VirtualTouch::publish() {
  messages::LocalModel& next = loop.models().back();
  next = model;
  next.sequence = ++sequence_;
  next.published_at_ns = now_ns_;
  next.dt_ns = kStep_ns;
  next.tool_sequence = loop.tool_state().sequence;
  loop.models().publish();
}

void VirtualTouch::tick(bool publishes) {
  now_ns_ += kTick_ns;
  const Vec3 held_N = device.motor_force_N();
  loop.tick(now_ns_);
  work_J_ = held_N.dot(device.position_world_m() - last_m_);
  last_m_ = device.position_world_m();
  if (publishes && now_ns_ % kStep_ns == 0) publish();
  for (haptics::HapticTick tick; loop.ticks().pop(tick);) {  // the only reader of the queue
  }
}

}  // namespace myotact::measure
