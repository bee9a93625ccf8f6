// Limbs written as models and read again: the same moment arms and the same forces.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "anatomy/hinge_chains.h"
#include "core/data_folder.h"
#include "exchange/opensim.h"
#include "simulation/line/line_model.h"
#include "support/temporary_folder.h"

namespace myotact::testing {
namespace {

using anatomy::Specimen;
using exchange::opensim::Import;

/// Of a line, its length from its points and wraps alone, with the bodies where the skeleton has them: straight ways,
/// and geodesics of which only the length is taken.
double length_m(const anatomy::MuscleLine& line, const simulation::Skeleton& skeleton) {
  double sum_m = 0.0;
  const auto place = [&](const anatomy::LinePoint& p) { return skeleton.body_pose(p.body) * p.position_m; };
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const Vec3 p = place(line.points[i]), q = place(line.points[i + 1]);
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i);
    if (wrap == nullptr) {
      sum_m += (q - p).norm();
      continue;
    }
    const Pose X_LW = skeleton.body_pose(wrap->body).inverse();
    sum_m +=
        geometry::wrap_path(surface_of(*wrap), in_frame_of(*wrap, X_LW * p), in_frame_of(*wrap, X_LW * q)).length_m;
  }
  return sum_m;
}

struct Worst {
  double arm_m = 0.0, difference_m = 0.0, force = 0.0;
};

/// The lines of both in one pose: moment arms about a joint against each other and against the difference of lengths.
void compare_lines(const Specimen& before, const Specimen& after, std::vector<double> q, std::size_t joint,
                   Worst& worst) {
  constexpr double kStep_rad = 1e-5;
  simulation::Skeleton one(before), other(after);
  simulation::LineGeometry a, b;
  for (std::size_t l = 0; l < before.lines.size(); ++l) {
    const anatomy::MuscleLine &line = before.lines[l], &again = after.lines[l];
    one.set_pose(q);
    other.set_pose(q);
    simulation::measure_line(line, one, a);
    simulation::measure_line(again, other, b);
    const auto j = static_cast<Eigen::Index>(joint);
    worst.arm_m = std::max(worst.arm_m, std::abs(a.slope_m_rad[j] - b.slope_m_rad[j]));
    std::vector<double> ahead = q, behind = q;
    ahead[joint] += kStep_rad;
    behind[joint] -= kStep_rad;
    other.set_pose(ahead);
    const double longer_m = length_m(again, other);
    other.set_pose(behind);
    const double slope_m = (longer_m - length_m(again, other)) / (2.0 * kStep_rad);
    worst.difference_m = std::max(worst.difference_m, std::abs(slope_m - a.slope_m_rad[j]));
    const auto m = static_cast<std::size_t>(line.muscle);
    const auto force = [&](const Specimen& s, const simulation::LineGeometry& g, const anatomy::MuscleLine& of) {
      simulation::Skeleton still(s);
      return simulation::line_force(s.muscles[m], g.length_m - length_m(of, still), 0.0, 0.5).force_N;
    };
    const double f = force(before, a, line), g = force(after, b, again);
    worst.force = std::max(worst.force, std::abs(f - g) / std::max(f, 1e-3 * before.muscles[m].peak_force_N));
  }
}

void keeps_moment_arms_and_forces(const Specimen& before) {
  TemporaryFolder folder;
  exchange::opensim::save_model(before, folder / "limb.osim");
  const Import import = exchange::opensim::read_model(folder / "limb.osim");
  const Specimen& after = import.specimen;
  ASSERT_EQ(after.bodies.size(), before.bodies.size());
  ASSERT_EQ(after.joints.size(), before.joints.size());
  ASSERT_EQ(after.muscles.size(), before.muscles.size());
  EXPECT_EQ(after.bones.size(), before.bones.size());
  EXPECT_TRUE(import.not_taken.empty()) << import.not_taken.front().element << ": " << import.not_taken.front().reason;
  for (std::size_t l = 0; l < before.lines.size(); ++l) {
    EXPECT_EQ(after.muscles[l].key, before.muscles[static_cast<std::size_t>(before.lines[l].muscle)].key);
    EXPECT_EQ(after.lines[l].wraps.size(), before.lines[l].wraps.size()) << after.muscles[l].key;
  }
  Specimen sorted = after;  // the file has muscles in the order of their lines
  for (std::size_t l = 0; l < before.lines.size(); ++l) {
    sorted.lines[l].muscle = before.lines[l].muscle;
    sorted.muscles[static_cast<std::size_t>(before.lines[l].muscle)] = after.muscles[l];
  }
  const Specimen one = anatomy::with_hinge_chains(before), other = anatomy::with_hinge_chains(sorted);
  Worst worst;
  for (std::size_t j = 0; j < one.joints.size(); ++j) {
    if (one.joints[j].axes.empty()) continue;
    const auto& [lowest, highest] = one.joints[j].range_rad[0];
    EXPECT_NEAR(other.joints[j].range_rad[0].first, lowest, 1e-12);
    EXPECT_NEAR(other.joints[j].stiffness_Nm_rad, one.joints[j].stiffness_Nm_rad, 1e-12);
    for (int step = 0; step <= 20; ++step) {
      std::vector<double> q(one.joints.size(), 0.0);
      q[j] = lowest + (highest - lowest) * step / 20.0;
      compare_lines(one, other, q, j, worst);
    }
  }
  EXPECT_LT(worst.arm_m, 1e-4);
  EXPECT_LT(worst.difference_m, 1e-4);
  EXPECT_LT(worst.force, 1e-6);
  std::printf("%s: moment arms within %.2e m, against differences of lengths %.2e m, forces within %.2e\n",
              before.name.c_str(), worst.arm_m, worst.difference_m, worst.force);
}

class RoundTrip : public ::testing::TestWithParam<const char*> {};

TEST_P(RoundTrip, KeepsMomentArmsAndForces) {
  keeps_moment_arms_and_forces(anatomy::load_specimen(data_folder() / "meshes" / GetParam()));
}

/// The elbow as a joint of two and of three axes that are not at right angles.
TEST(RoundTripOfAxes, KeepsUniversalAndBallJoints) {
  for (const std::size_t axes : {2u, 3u}) {
    Specimen limb = anatomy::load_specimen(data_folder() / "meshes" / "canine_elbow");
    anatomy::Joint& joint = limb.joints[static_cast<std::size_t>(anatomy::find_joint(limb, "elbow"))];
    joint.type = axes == 2 ? anatomy::JointType::Universal : anatomy::JointType::Ball;
    joint.axes.push_back(Vec3(0.8, 0.2, 0.1).normalized());
    if (axes == 3) joint.axes.push_back(Vec3(0.1, -0.1, 0.9).normalized());
    joint.range_rad.resize(axes, {-0.3, 0.2});
    keeps_moment_arms_and_forces(limb);
  }
}

INSTANTIATE_TEST_SUITE_P(Limbs, RoundTrip,
                         ::testing::Values("canine_elbow", "canine_forelimb", "canine_hindlimb",
                                           "canine_whole_forelimb", "canine_whole_hindlimb"));

TEST(OpenSimWriter, IsWhatOpenSim4Documents) {
  const Specimen limb = anatomy::load_specimen(data_folder() / "meshes" / "canine_elbow");
  const std::string text = exchange::opensim::write_model(limb, "bones").osim;
  for (const char* part : {"<OpenSimDocument Version=\"40000\">", "<socket_parent_frame>/ground</socket_parent_frame>",
                           "<PinJoint name=\"elbow\">", "<Coordinate name=\"elbow_flexion\">",
                           "<Millard2012EquilibriumMuscle name=\"biceps_brachii\">", "<mesh_file>bones/"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace myotact::testing
