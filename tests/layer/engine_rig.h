#pragma once

#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "layer/bullet_engine.h"
#include "layer/simulation_engine.h"

// The plain specimens behind both engines.

namespace myotact::layer::testing {

inline constexpr double kRadius_m = 0.005;
inline constexpr double kGravity_m_s2 = 9.81;
inline const Vec3 kDown_m_s2(0.0, 0.0, -kGravity_m_s2);

inline anatomy::Specimen plain_specimen(const char* name) {
  return anatomy::load_specimen(data_folder() / "meshes" / name);
}

/// The plate as a pendulum: free to swing either way, no damper.
inline anatomy::Specimen pendulum() {
  anatomy::Specimen specimen = plain_specimen("plate");
  specimen.joints[0].range_rad = {{-0.5, 0.5}};
  specimen.joints[0].damping_Nms_rad = 0.0;
  return specimen;
}

enum class Kind { Bullet, Simulation };

inline std::unique_ptr<Engine> make_engine(Kind kind, const anatomy::Specimen& specimen,
                                           const Vec3& gravity_m_s2 = kDown_m_s2) {
  if (kind == Kind::Bullet) {
    return make_bullet_engine(specimen,
                              {.gravity_m_s2 = gravity_m_s2, .tools = {{ToolBody::Shape::Sphere, kRadius_m}}});
  }
  simulation::SimulationSettings settings;
  settings.dt_s = 1.0 / 60.0;
  settings.gravity_m_s2 = gravity_m_s2;
  settings.workers = 1;
  return std::make_unique<SimulationEngine>(specimen, settings, std::vector{kRadius_m});
}

inline messages::ToolState tool_at(const Vec3& middle_m) {
  messages::ToolState tool;
  tool.tool_position_world_m = tool.proxy_position_world_m = to_array(middle_m);
  return tool;
}

inline messages::ReportedContacts report_at(Engine& engine, const Vec3& middle_m) {
  engine.move_tool(0, tool_at(middle_m));
  messages::ReportedContacts reported;
  engine.report_contacts(0, reported);
  return reported;
}

/// Every case runs on both engines; that of Bullet is left out where the program was built without it.
class BothEngines : public ::testing::TestWithParam<Kind> {
 protected:
  void SetUp() override {
    if (GetParam() == Kind::Bullet && !has_bullet()) GTEST_SKIP() << "built without Bullet (libbullet-dev)";
  }
};

}  // namespace myotact::layer::testing
