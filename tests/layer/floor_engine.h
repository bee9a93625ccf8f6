#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "geometry/plain_surfaces.h"
#include "layer/engine.h"

namespace myotact::layer {

inline constexpr double kRadius_m = 3e-3;  // of the tools
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// A horizontal floor, at z = 0 unless it moves: all that it does is known in closed form. It may spoil what it
/// reports.
class FloorEngine : public Engine {
 public:
  std::string_view name() const override { return "floor"; }
  double step_s() const override { return 1.0 / 60.0; }
  int surface_count() const override { return 1; }

  void move_tool(int tool, const messages::ToolState& state) override {
    states_.resize(std::max(states_.size(), static_cast<std::size_t>(tool) + 1));
    states_[static_cast<std::size_t>(tool)] = state;
  }
  void advance() override {
    previous_m_ = height_m_;
    height_m_ += speed_m_s * step_s();
    ++steps;
  }
  void report_contacts(int tool, messages::ReportedContacts& reported) const override {
    const auto& at_m = state(tool).tool_position_world_m;
    reported.tool_world_m = at_m;
    const double depth_m = kRadius_m - (at_m[2] - height_m_);
    if (depth_m >= 0.0) {
      reported.count = 1;
      reported.contacts[0] = {0, {at_m[0], at_m[1], height_m_}, {0, 0, 1}, depth_m};
    }
    if (spoil_report) spoil_report(reported);
  }
  Pose body_pose(int) const override { return {Mat3::Identity(), lost ? Vec3(0, 0, kNaN) : Vec3(0, 0, height_m_)}; }
  void write_surface(int, messages::LocalModel& model) const override {
    model.coverage_radius_m = 0.25;
    for (std::size_t i = 0; i < floor_.positions_m.size(); ++i) {
      model.previous_world_m[i] = to_array(floor_.positions_m[i] + Vec3(0, 0, previous_m_));
      model.current_world_m[i] = to_array(floor_.positions_m[i] + Vec3(0, 0, height_m_));
    }
    model.vertex_count = static_cast<std::int32_t>(floor_.positions_m.size());
    for (const std::array<int, 3>& corners : floor_.triangles) {
      auto& triangle = model.triangles[static_cast<std::size_t>(model.triangle_count)];
      triangle.surface = 0;
      triangle.triangle = model.triangle_count++;
      triangle.vertices = {corners[0], corners[1], corners[2]};
    }
    model.grip.body = 0;  // of the floor: what a hand may hold is its middle
    model.grip.position_world_m = {0, 0, height_m_};
    if (spoil_model) spoil_model(model);
  }

  const messages::ToolState& state(int tool) const { return states_[static_cast<std::size_t>(tool)]; }
  double height_m() const { return height_m_; }

  double speed_m_s = 0.0;  // upwards
  bool lost = false;       // the engine lost its body
  std::function<void(messages::ReportedContacts&)> spoil_report;
  std::function<void(messages::LocalModel&)> spoil_model;
  int steps = 0;

 private:
  geometry::TriangleMesh floor_ = geometry::make_plane(0.12, 9);
  std::vector<messages::ToolState> states_;
  double height_m_ = 0.0, previous_m_ = 0.0;
};

}  // namespace myotact::layer
