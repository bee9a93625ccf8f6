// Muscles that nothing moves are not solved for. Against the same limb with all of them awake: what is seen and what is
// felt is the same.

#include "simulation/limb/sleep.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/limb/settle.h"
#include "simulation/simulation.h"
#include "support/skin_places.h"
#include "support/source_folder.h"

namespace myotact::simulation {
namespace {

using messages::ToolState;
using testing::press_tool, testing::skin_centre_m, testing::skin_triangle_near;

constexpr int kRest = 20, kPress = 80, kHold = 140, kFlexed = 290, kEnd = 540;  // steps at which each part ends
constexpr double kDepth_m = 3e-3, kCoupling_N_m = 800.0, kTorque_Nm = 0.06;

/// As in the scene `forelimb`.
const std::vector<std::string> kRigid = {
    "extensor_carpi_ulnaris",          "pronator_quadratus", "fore.flexor_digitorum_superficialis",
    "fore.flexor_digitorum_profundus", "rhomboideus",        "fore.extensor_digitorum_lateralis"};

const anatomy::Specimen& forelimb() {
  static const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_whole_forelimb");
  return specimen;
}

SimulationSettings settings_of(bool sleep, int workers = 2, Contact contact = Contact::None) {
  SimulationSettings settings;
  settings.contact = contact;
  settings.sleep = sleep;
  settings.workers = workers;
  settings.shapes = false;  // of those that follow their bones, which are not looked at
  for (const anatomy::Muscle& muscle : forelimb().muscles) {
    const bool soft = std::find(kRigid.begin(), kRigid.end(), muscle.key) == kRigid.end();
    settings.tissue.push_back(soft ? TissueModel::Fem : TissueModel::Rigid);
  }
  return settings;
}

/// A hand that presses the lateral head of triceps; then a torque flexes the elbow by some degrees, and lets it go
/// back.
class Forearm {
 public:
  explicit Forearm(const SimulationSettings& settings) : simulation_(forelimb(), settings) {
    const std::vector<double> angles(forelimb().joints.size(), 0.0);
    EXPECT_TRUE(simulation_.settle(angles, {}));
    for (int j = 0; j < static_cast<int>(angles.size()); ++j) {
      if (j != elbow_) simulation_.set_joint_locked(j, true);
    }
    balance_Nm_ = -elbow().net_torque_Nm - elbow().own_torque_Nm;
    simulation_.set_joint_torque(elbow_, balance_Nm_);
    const std::span<const Vec3> skin = simulation_.skin_world_m(muscle_);
    const auto outermost =
        std::max_element(skin.begin(), skin.end(), [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
    triangle_ = skin_triangle_near(simulation_, forelimb(), muscle_, *outermost);
    start_m_ = skin_centre_m(simulation_, forelimb(), muscle_, triangle_);
  }

  void step(int index) {
    const double flexing =
        std::sin(3.14159265358979 * std::clamp(index - kHold, 0, 2 * (kFlexed - kHold)) / (2.0 * (kFlexed - kHold)));
    simulation_.set_joint_torque(elbow_, balance_Nm_ + kTorque_Nm * flexing * flexing);
    if (index < kRest || index >= kHold) return simulation_.step({});
    const double share = std::min(1.0, static_cast<double>(index - kRest) / (kPress - kRest));
    const Vec3 target_m = start_m_ - share * kDepth_m * Vec3::UnitY();
    const ToolState tool = press_tool(muscle_, triangle_, target_m, kCoupling_N_m);
    simulation_.step({&tool, 1});
    messages::LocalModel model;
    simulation_.write_local_model(tool, model);
    force_N_ = to_vec3(model.contact.force_world_N).norm();
  }

  const Simulation& simulation() const { return simulation_; }
  double force_N() const { return force_N_; }
  JointReadout elbow() const { return simulation_.joint(elbow_); }
  int asleep() const {
    int count = 0;
    for (int m = 0; m < simulation_.muscle_count(); ++m) count += simulation_.asleep(m);
    return count;
  }

 private:
  Simulation simulation_;
  const int muscle_ = anatomy::find_muscle(forelimb(), "triceps_brachii_lateral");
  const int elbow_ = anatomy::find_joint(forelimb(), "elbow");
  int triangle_ = 0;
  Vec3 start_m_ = Vec3::Zero();
  double balance_Nm_ = 0.0;  // that holds the elbow at the start
  double force_N_ = 0.0;
};

double farthest_m(const Simulation& a, const Simulation& b) {
  double farthest_m = 0.0;
  for (int m = 0; m < a.muscle_count(); ++m) {
    for (std::size_t v = 0; v < a.skin_world_m(m).size(); ++v) {
      farthest_m = std::max(farthest_m, (a.skin_world_m(m)[v] - b.skin_world_m(m)[v]).norm());
    }
  }
  return farthest_m;
}

class SleepIn : public ::testing::TestWithParam<Contact> {};
INSTANTIATE_TEST_SUITE_P(Contact, SleepIn, ::testing::Values(Contact::None, Contact::Bones),
                         [](const auto& contact) { return contact.param == Contact::None ? "None" : "Bones"; });

TEST_P(SleepIn, IsNeitherSeenNorFelt) {
  Forearm sleeping(settings_of(true, 2, GetParam())), awake(settings_of(false, 2, GetParam()));
  double apart_m = 0.0, force_error = 0.0, stiffness_error = 0.0, angle_rad = 0.0;
  long slept = 0;
  for (int step = 0; step < kEnd; ++step) {
    sleeping.step(step);
    awake.step(step);
    apart_m = std::max(apart_m, farthest_m(sleeping.simulation(), awake.simulation()));
    angle_rad = std::max(angle_rad, awake.elbow().angle_rad);
    slept += sleeping.asleep();
    EXPECT_EQ(awake.asleep(), 0);
    if (step >= kPress && step < kHold)
      force_error = std::max(force_error, std::abs(sleeping.force_N() / awake.force_N() - 1.0));
    if (step == kRest - 1 || step == kHold - 1 || step == kEnd - 1) {
      const double error = std::abs(sleeping.elbow().stiffness_Nm_rad / awake.elbow().stiffness_Nm_rad - 1.0);
      stiffness_error = std::max(stiffness_error, error);
    }
  }
  std::printf("%.1f of %d muscles asleep, skins %.3f mm apart, force %.2f %%, K %.2f %%, elbow up to %.3f rad\n",
              static_cast<double>(slept) / kEnd, awake.simulation().muscle_count(), 1e3 * apart_m, 100.0 * force_error,
              100.0 * stiffness_error, angle_rad);
  EXPECT_GT(slept, 20L * kEnd);
  EXPECT_GT(angle_rad, 0.02);  // it does move
  // A tenth is wanted. On the bones slack bellies that are awake come to rest elsewhere: 0.28 and 0.37 measured, on
  // two processors.
  EXPECT_LT(apart_m, GetParam() == Contact::None ? 0.1e-3 : 0.4e-3);
  EXPECT_LT(force_error, 0.01);
  EXPECT_LT(stiffness_error, 0.01);
}

TEST(Sleep, LeavesTheSameBitsWithAnyNumberOfWorkers) {
  std::vector<std::uint64_t> hashes;
  for (const int workers : {1, 2, 8}) {
    Forearm limb(settings_of(true, workers));
    for (int step = 0; step < 180; ++step) limb.step(step);
    hashes.push_back(limb.simulation().state_hash());
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Sleep, EndsAtATouchAndReturns) {
  Forearm limb(settings_of(true));
  const int all = limb.simulation().muscle_count() - static_cast<int>(kRigid.size());
  const int pressed = anatomy::find_muscle(forelimb(), "triceps_brachii_lateral");
  limb.step(0);
  EXPECT_EQ(limb.asleep(), all);
  limb.step(kRest + 1);
  EXPECT_FALSE(limb.simulation().asleep(pressed));
  EXPECT_GT(limb.asleep(), all / 2);
  for (int step = kEnd; step < kEnd + 300; ++step) limb.step(step);
  EXPECT_TRUE(limb.simulation().asleep(pressed));
}

TEST(Sleep, RidesOnTheBodyThatCarriesTheMuscle) {
  const int muscle = anatomy::find_muscle(forelimb(), "pronator_quadratus");  // from the ulna to the radius
  std::vector<TissueModel> models(forelimb().muscles.size(), TissueModel::Rigid);
  models[static_cast<std::size_t>(muscle)] = TissueModel::Fem;
  Limb limb(forelimb(), models, Tendon::Elastic, Contact::None);
  WorkerPool workers(1);
  const std::vector<double> straight(forelimb().joints.size(), 0.0);
  ASSERT_TRUE(settle_limb(limb, straight, workers));
  refresh_stiffness(limb, workers);
  ASSERT_TRUE(may_sleep(limb, muscle, 0.0, 0.01));
  fall_asleep(limb, muscle, AfterSettle::Yes);
  const Eigen::VectorXd start_m = limb.muscles[static_cast<std::size_t>(muscle)].state.now.position_m;
  const int body = limb.muscles[static_cast<std::size_t>(muscle)].tissue.bodies.front();
  const Pose from = limb.skeleton.body_pose(body);
  limb.now.angle_rad[anatomy::find_joint(forelimb(), "elbow")] = 0.9;
  follow_angles(limb);
  place_sleepers(limb, -1, workers);
  ASSERT_TRUE(limb.muscles[static_cast<std::size_t>(muscle)].sleep);
  const Pose carried = limb.skeleton.body_pose(body) * from.inverse();
  const Eigen::VectorXd& now_m = limb.muscles[static_cast<std::size_t>(muscle)].state.now.position_m;
  for (Eigen::Index i = 0; i < now_m.size(); i += 3) {
    EXPECT_LT((carried * Vec3(start_m.segment<3>(i)) - now_m.segment<3>(i)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace myotact::simulation
