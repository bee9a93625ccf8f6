// Public models of OpenSim, which are not part of this project: in a folder that MYOTACT_OPENSIM_MODELS names.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/error.h"
#include "exchange/opensim.h"
#include "simulation/line/line_model.h"

namespace myotact::testing {
namespace {

namespace fs = std::filesystem;

TEST(OpenSimPublic, EveryModelOfTheFolderIsReadOrRefusedForItsVersion) {
  const char* folder = std::getenv("MYOTACT_OPENSIM_MODELS");
  if (folder == nullptr)
    GTEST_SKIP() << "MYOTACT_OPENSIM_MODELS names no folder of .osim files; fetch some of opensim-models";
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".osim") continue;
    try {
      const auto import = exchange::opensim::read_model(entry.path());
      EXPECT_EQ(anatomy::find_defect(import.specimen), "") << entry.path();
      ++read;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("save it"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(read, 0);
}

/// Moment arm of the biceps at this angle, from the numbers of the file in OpenSim's own axes: its last stretch runs
/// from the humerus to the radius, straight.
double biceps_arm_m(double q_rad) {
  const Vec3 axis = Vec3(0.04940001, 0.03660001, 0.99810825).normalized();
  const Vec3 centre(0.0061, -0.2904, -0.0123), on_humerus(0.0228, -0.1754, -0.0063),
      on_radius(0.00751, -0.04839, 0.02179);
  const auto length_m = [&](double angle_rad) {
    return (centre + Eigen::AngleAxisd(angle_rad, axis) * on_radius - on_humerus).norm();
  };
  return -(length_m(q_rad + 1e-6) - length_m(q_rad - 1e-6)) / 2e-6;
}

TEST(OpenSimPublic, TheBicepsActsAsItsNumbersSay) {
  const char* folder = std::getenv("MYOTACT_OPENSIM_MODELS");
  const fs::path file = folder == nullptr ? fs::path() : fs::path(folder) / "arm26.osim";
  if (folder == nullptr || !fs::exists(file)) GTEST_SKIP() << "MYOTACT_OPENSIM_MODELS names no folder with arm26.osim";
  const auto import = exchange::opensim::read_model(file);
  const anatomy::Specimen& arm = import.specimen;
  const int joint = anatomy::find_joint(arm, "r_elbow");
  ASSERT_GE(joint, 0);
  simulation::Skeleton skeleton(arm);
  std::vector<double> q(arm.joints.size(), 0.0);
  q[static_cast<std::size_t>(joint)] = 1.5707963;
  skeleton.set_pose(q);
  for (const anatomy::MuscleLine& line : arm.lines) {
    simulation::LineGeometry geometry;
    simulation::measure_line(line, skeleton, geometry);
    const anatomy::Muscle& muscle = arm.muscles[static_cast<std::size_t>(line.muscle)];
    const double arm_m = -geometry.slope_m_rad[joint];
    std::printf("%s: %.1f N, %.2f mm at 90 degrees\n", muscle.key.c_str(), muscle.peak_force_N, 1e3 * arm_m);
    if (muscle.key == "biclong") {
      EXPECT_DOUBLE_EQ(muscle.peak_force_N, 624.3);
      EXPECT_NEAR(arm_m, biceps_arm_m(q[static_cast<std::size_t>(joint)]), 1e-7);
    }
  }
}

}  // namespace
}  // namespace myotact::testing
