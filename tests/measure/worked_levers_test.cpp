#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "measure/line/line_model_file.h"
#include "simulation/line/line_model.h"

// Moment arms of the embedded limbs' muscle lines beside those of the worked one-dimensional joints (assets/cases),
// whose paths were taken from the same dog's full sections, before there was a program that traces lines.

namespace myotact::measure {
namespace {

/// Half of what the joints' axes are known to. Measured points are rounded to 0.1 mm; lines end on the bone where the
/// dog's authors put a marker, the worked paths in the middle of a contact or of markers.
constexpr double kMomentArm_m = 1.5e-3;
/// Such a difference of moment arms, made within 30 degrees.
constexpr double kMomentArmSlope_m_rad = 3e-3;

struct Worked {
  const char* model;
  const char* specimen;
  const char* joint;
};

class WorkedMomentArms : public ::testing::TestWithParam<Worked> {};
INSTANTIATE_TEST_SUITE_P(Canine, WorkedMomentArms,
                         ::testing::Values(Worked{"line_elbow", "canine_elbow", "elbow"},
                                           Worked{"line_stifle", "canine_hindlimb", "stifle"},
                                           Worked{"line_hock", "canine_hindlimb", "tarsus"}));

/// The specimen's key of a muscle: the model of the hock has English ones.
std::string key_of(const std::string& worked) {
  static const std::map<std::string, std::string> kKeys = {
      {"cranial_tibial", "tibialis_cranialis"},
      {"long_digital_extensor", "extensor_digitorum_longus"},
      {"superficial_digital_flexor", "hind.flexor_digitorum_superficialis"}};
  const auto known = kKeys.find(worked);
  return known == kKeys.end() ? worked : known->second;
}

TEST_P(WorkedMomentArms, AreThoseOfTheEmbeddedLines) {
  const LineModel model = load_line_model(data_folder() / "assets/cases" / (std::string(GetParam().model) + ".json"));
  const auto specimen = anatomy::load_specimen(data_folder() / "meshes" / GetParam().specimen);
  simulation::Skeleton skeleton(specimen);
  const int joint = anatomy::find_joint(specimen, GetParam().joint);
  const double q_rad = model.q_rad.front();
  std::vector<double> angles(static_cast<std::size_t>(skeleton.joint_count()), 0.0);
  angles[static_cast<std::size_t>(joint)] = q_rad;
  skeleton.set_pose(angles);
  fmt::print("moment arm [mm] and its slope [mm/rad], of the line / of the worked model, at {:.2f} rad\n", q_rad);
  for (const LineMuscle& muscle : model.joint.muscles) {
    const int index = anatomy::find_muscle(specimen, key_of(muscle.key));
    const auto line = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                   [&](const anatomy::MuscleLine& known) { return known.muscle == index; });
    ASSERT_TRUE(index >= 0 && line != specimen.lines.end()) << muscle.key;
    simulation::LineGeometry ours;
    simulation::measure_line(*line, skeleton, ours);
    const PathGeometry worked = measure_path(muscle.path, q_rad);
    const double moment_arm_m = -ours.slope_m_rad[joint], slope_m_rad = -ours.curvature_m_rad2(joint, joint);
    fmt::print("{:32} {:6.2f} / {:6.2f}  {:6.2f} / {:6.2f}\n", muscle.key, 1e3 * moment_arm_m, 1e3 * worked.arm_m,
               1e3 * slope_m_rad, 1e3 * worked.arm_slope_m_rad);
    EXPECT_NEAR(moment_arm_m, worked.arm_m, kMomentArm_m) << muscle.key;
    EXPECT_NEAR(slope_m_rad, worked.arm_slope_m_rad, kMomentArmSlope_m_rad) << muscle.key;
  }
}

}  // namespace
}  // namespace myotact::measure
