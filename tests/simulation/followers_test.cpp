#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "anatomy/hinge_chains.h"
#include "geometry/tet_mesh.h"
#include "simulation/follower/bone_fit.h"
#include "simulation/limb/limb.h"
#include "simulation/simulation.h"
#include "support/source_folder.h"

// Muscles that nothing solves for, in both shipped limbs: over the whole range of every joint, and with all joints bent
// at once, their skins stay on the bones they lay on and out of all others.

namespace myotact::simulation {
namespace {

/// What a skin may come off a bone that it touched, or enter one, against the file pose [m].
constexpr double kAllowed_m = 2e-3;
/// Muscles that are worse, and how far. What is clamped to a patella, which rides on the crus here and not on the
/// femur, and touches the femur cannot have both; digital tendons that lie on a bone at either side of a joint leave
/// one of them by a tendon's thickness at its full flexion. Hamstring and adductor are pressed on the pelvis where the
/// hip is at an end of its range, triceps on the scapula where the shoulder is.
const std::map<std::string, double> kExceptions_m = {{"vastus_lateralis", 4e-3},
                                                     {"vastus_intermedius", 3e-3},
                                                     {"sartorius_cranial", 2.5e-3},
                                                     {"fore.extensor_digitorum_lateralis", 2.7e-3},
                                                     {"triceps_brachii_long", 2.2e-3},
                                                     {"semimembranosus", 3e-3},
                                                     {"adductor_magnus", 2.5e-3},
                                                     {"hind.extensor_digitorum_lateralis", 2.6e-3},
                                                     {"hind.flexor_digitorum_profundus", 3e-3}};
/// The same in the two limbs of lofted sections.
const std::map<std::string, double> kLoftedExceptions_m = {{"vastus_lateralis", 4e-3}};
constexpr int kAnglesPerJoint = 9;
constexpr int kTogether = 24;  // poses with all joints bent
/// Of all tets of the followers, in the worst pose.
constexpr double kInvertedShare = 0.02;
/// A straight way between two samples ends in a kink: what a vertex may leave the straight way by, over three angles
/// half a degree apart [m].
constexpr double kSmoothStep_rad = 0.5 * 3.14159265358979323846 / 180.0;
constexpr double kLargestKink_m = 2e-3;
/// The one muscle that is worse: 2.02 mm, in front of the bent elbow.
const std::map<std::string, double> kKinkExceptions_m = {{"extensor_carpi_radialis", 2.1e-3}};

/// A line goes round a surface that stands for the bone, the skin round the bone itself: so far a point of the line may
/// come out of the skin [m], and more than that in this share of all points and poses.
constexpr double kLineOutside_m = 3e-3;
constexpr double kLinesOutsideShare = 0.08;

using Angles = std::vector<double>;

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

/// How far a vertex leaves the straight way over three frames, at most.
double largest_kink_m(const std::vector<Vec3>& before, const std::vector<Vec3>& here, const std::vector<Vec3>& after) {
  double largest_m = 0.0;
  for (std::size_t v = 0; v < here.size(); ++v) {
    largest_m = std::max(largest_m, (before[v] - 2.0 * here[v] + after[v]).norm());
  }
  return largest_m;
}

struct Kink {
  double size_m = 0.0, allowed_m = kLargestKink_m;
  std::string where;
};

double allowed_kink_m(const std::string& muscle) {
  const auto exception = kKinkExceptions_m.find(muscle);
  return exception == kKinkExceptions_m.end() ? kLargestKink_m : exception->second;
}

class Followers : public ::testing::TestWithParam<const char*> {
 protected:
  Followers() {
    for (int m = 0; m < count(); ++m) {
      const std::span<const Vec3> skin = simulation_.skin_world_m(m);
      rest_m_.emplace_back(skin.begin(), skin.end());
      rest_gap_m_.emplace_back();
      for (const Vec3& p : skin) rest_gap_m_.back().push_back(gap_to_bones(bones_, skeleton_, p, 0.02).distance_m);
    }
  }

  int count() const { return static_cast<int>(specimen_.muscles.size()); }
  Angles file_pose() const { return Angles(specimen_.joints.size(), 0.0); }

  /// One joint after the other over its range, then all at once.
  std::vector<Angles> poses() const {
    std::vector<Angles> poses;
    std::mt19937 random(7);
    for (std::size_t j = 0; j < specimen_.joints.size(); ++j) {
      for (int i = 0; i < kAnglesPerJoint && hinge(j); ++i) {
        poses.push_back(file_pose());
        poses.back()[j] = angle(j, static_cast<double>(i) / (kAnglesPerJoint - 1));
      }
    }
    for (int i = 0; i < kTogether; ++i) {
      poses.push_back(file_pose());
      for (std::size_t j = 0; j < specimen_.joints.size(); ++j) {
        if (hinge(j)) poses.back()[j] = angle(j, static_cast<double>(random() % 1001) / 1000.0);
      }
    }
    return poses;
  }
  bool hinge(std::size_t joint) const { return specimen_.joints[joint].type == anatomy::JointType::Hinge; }
  double angle(std::size_t joint, double share) const {
    const auto [lowest, highest] = specimen_.joints[joint].range_rad[0];
    return lowest + share * (highest - lowest);
  }

  void pose(const Angles& angles) {
    ASSERT_TRUE(simulation_.settle(angles, {}));
    skeleton_.set_pose(angles);
  }

  /// All muscles' skins as they are now.
  std::vector<std::vector<Vec3>> skins() const {
    std::vector<std::vector<Vec3>> all;
    for (int m = 0; m < count(); ++m) {
      all.emplace_back(simulation_.skin_world_m(m).begin(), simulation_.skin_world_m(m).end());
    }
    return all;
  }

  /// How far the worst vertex of a muscle came off what it touched, and how far one entered a bone [m].
  std::pair<double, double> worst_m(int muscle) const {
    std::pair<double, double> worst{0.0, 0.0};
    const std::span<const Vec3> skin = simulation_.skin_world_m(muscle);
    for (std::size_t v = 0; v < skin.size(); ++v) {
      const double rest_m = rest_gap_m_[index(muscle)][v];
      const bool touched = rest_m <= kTouchingGap_m;
      const double gap_m = gap_to_bones(bones_, skeleton_, skin[v], touched ? 0.06 : 0.01).distance_m;
      if (touched) worst.first = std::max(worst.first, gap_m - std::max(0.0, rest_m));
      worst.second = std::max(worst.second, std::min(0.0, rest_m) - gap_m);
    }
    return worst;
  }

  anatomy::Specimen specimen_ =
      anatomy::with_hinge_chains(anatomy::load_specimen(source_folder() + "/meshes/" + GetParam()));
  Simulation simulation_{specimen_, {.tissue = std::vector<TissueModel>(specimen_.muscles.size(), TissueModel::Rigid)}};
  BoneSurfaces bones_ = make_bone_surfaces(specimen_);
  Skeleton skeleton_{specimen_};
  std::vector<std::vector<Vec3>> rest_m_;
  std::vector<std::vector<double>> rest_gap_m_;
};
INSTANTIATE_TEST_SUITE_P(Shipped, Followers,
                         ::testing::Values("canine_forelimb", "canine_hindlimb", "canine_whole_forelimb",
                                           "canine_whole_hindlimb"));

TEST_P(Followers, StayOnTheirBonesAndOutOfOthersOverAllRanges) {
  std::vector<std::pair<double, double>> worst(index(count()));
  for (const Angles& angles : poses()) {
    pose(angles);
    for (int m = 0; m < count(); ++m) {
      const auto [off_m, in_m] = worst_m(m);
      worst[index(m)] = {std::max(worst[index(m)].first, off_m), std::max(worst[index(m)].second, in_m)};
    }
  }
  const bool whole = std::string(GetParam()).starts_with("canine_whole");
  const std::map<std::string, double>& exceptions_m = whole ? kExceptions_m : kLoftedExceptions_m;
  for (int m = 0; m < count(); ++m) {
    const auto [off_m, in_m] = worst[index(m)];
    const std::string& key = specimen_.muscles[index(m)].key;
    std::printf("%-40s off %5.2f mm, in %5.2f mm\n", key.c_str(), 1e3 * off_m, 1e3 * in_m);
    const auto exception = exceptions_m.find(key);
    EXPECT_LE(std::max(off_m, in_m), exception == exceptions_m.end() ? kAllowed_m : exception->second) << key;
  }
}

/// Against the skin at the file pose: what lay inside may not come out.
TEST_P(Followers, KeepTheirLinesInside) {
  const auto outside_m = [&](int m) {
    geometry::TriangleMesh skin = specimen_.muscles[index(m)].skin;
    skin.positions_m.assign(simulation_.skin_world_m(m).begin(), simulation_.skin_world_m(m).end());
    const geometry::SignedDistance surface(skin);
    std::vector<double> distances_m;
    for (const Vec3& p : simulation_.line_world_m(m)) distances_m.push_back(surface.nearest(p, 1.0).distance_m);
    return distances_m;
  };
  std::vector<std::vector<double>> rest_m;
  for (int m = 0; m < count(); ++m) rest_m.push_back(outside_m(m));
  std::size_t points = 0, out = 0;
  for (const Angles& angles : poses()) {
    pose(angles);
    for (int m = 0; m < count(); ++m) {
      const std::vector<double> now_m = outside_m(m);
      for (std::size_t i = 0; i < now_m.size(); ++i) {
        if (rest_m[index(m)][i] > 0.0) continue;
        ++points;
        out += now_m[i] > kLineOutside_m;
      }
    }
  }
  const double share = static_cast<double>(out) / static_cast<double>(points);
  std::printf("line points that came out of their skins: %.2f %%\n", 100.0 * share);
  EXPECT_LE(share, kLinesOutsideShare);
}

TEST_P(Followers, AreAtRestAtTheFilePose) {
  pose(poses().back());
  pose(file_pose());
  for (int m = 0; m < count(); ++m) {
    const std::span<const Vec3> skin = simulation_.skin_world_m(m);
    for (std::size_t v = 0; v < skin.size(); ++v) ASSERT_NEAR((skin[v] - rest_m_[index(m)][v]).norm(), 0.0, 1e-9);
  }
}

TEST_P(Followers, MoveWithoutJumps) {
  Kink worst;
  for (std::size_t j = 0; j < specimen_.joints.size(); ++j) {
    if (!hinge(j)) continue;
    std::vector<std::vector<std::vector<Vec3>>> frames;  // the last three
    const auto [lowest, highest] = specimen_.joints[j].range_rad[0];
    for (double q = lowest; q <= highest; q += kSmoothStep_rad) {
      Angles angles = file_pose();
      angles[j] = q;
      pose(angles);
      frames.push_back(skins());
      if (frames.size() < 3) continue;
      for (std::size_t m = 0; m < index(count()); ++m) {
        const double here_m = largest_kink_m(frames[0][m], frames[1][m], frames[2][m]);
        const std::string& key = specimen_.muscles[m].key;
        const double allowed_m = allowed_kink_m(key);
        if (here_m / allowed_m <= worst.size_m / worst.allowed_m) continue;
        worst = {here_m, allowed_m, key + " at " + std::to_string(q) + " rad"};
      }
      frames.erase(frames.begin());
    }
  }
  std::printf("largest kink %.2f mm in %s\n", 1e3 * worst.size_m, worst.where.c_str());
  EXPECT_LE(worst.size_m, worst.allowed_m) << worst.where;
}

/// The same muscles outside a Simulation, for their meshes' sake.
TEST_P(Followers, FewTetsTurnInsideOut) {
  const std::vector<TissueModel> rigid(specimen_.muscles.size(), TissueModel::Rigid);
  Limb limb(specimen_, rigid);
  for (int m = 0; m < count(); ++m) {
    const MuscleTissue& tissue = limb.muscles[index(m)].tissue;
    const geometry::TriangleMesh& skin = specimen_.muscles[index(m)].skin;
    const SkinEmbedding embedding = embed_skin(skin, tissue.mesh);
    fit_to_bones({tissue.mesh, tissue.body, skin, embedding, bones_}, limb.skeleton, *limb.muscles[index(m)].follower);
  }
  double worst_share = 0.0;
  for (const Angles& angles : poses()) {
    limb.skeleton.set_pose(angles);
    std::size_t inverted = 0, tets = 0;
    for (int m = 0; m < count(); ++m) {
      place_follower(limb, m);
      geometry::TetMesh moved = limb.muscles[index(m)].tissue.mesh;
      for (std::size_t i = 0; i < moved.nodes_m.size(); ++i) {
        moved.nodes_m[i] = node_vector(limb.muscles[index(m)].state.now.position_m, static_cast<int>(i));
      }
      for (std::size_t t = 0; t < moved.corners.size(); ++t) inverted += geometry::corner_volume_m3(moved, t) <= 0.0;
      tets += moved.corners.size();
    }
    worst_share = std::max(worst_share, static_cast<double>(inverted) / static_cast<double>(tets));
  }
  std::printf("inverted tets: %.2f %%\n", 100.0 * worst_share);
  EXPECT_LE(worst_share, kInvertedShare);
}

TEST(FollowersOfAnElbow, AreTheSameForAnyNumberOfThreads) {
  const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  std::vector<std::uint64_t> hashes;
  for (const int workers : {1, 2, 3, 4}) {
    Simulation simulation(specimen, {.workers = workers,
                                     .tissue = std::vector<TissueModel>(specimen.muscles.size(), TissueModel::Rigid)});
    ASSERT_TRUE(simulation.settle(Angles(specimen.joints.size(), 0.7), {}));
    hashes.push_back(simulation.state_hash());
  }
  EXPECT_EQ(hashes, std::vector<std::uint64_t>(4, hashes[0]));
}

TEST(FollowersOfAnElbow, DoNotTouchWhatIsSimulated) {
  const anatomy::Specimen specimen = anatomy::load_specimen(source_folder() + "/meshes/canine_elbow");
  std::vector<TissueModel> mixed(specimen.muscles.size(), TissueModel::Line);
  Simulation alone(specimen, {.tissue = mixed});
  mixed.back() = TissueModel::Rigid;
  Simulation with_shape(specimen, {.tissue = mixed});
  Angles angles(specimen.joints.size(), 0.0);
  const int elbow = anatomy::find_joint(specimen, "elbow");
  angles[index(elbow)] = 0.9;
  ASSERT_TRUE(alone.settle(angles, {}));
  ASSERT_TRUE(with_shape.settle(angles, {}));
  for (int m = 0; m + 1 < static_cast<int>(specimen.muscles.size()); ++m) {
    EXPECT_EQ(alone.muscle_torque_Nm(m, elbow), with_shape.muscle_torque_Nm(m, elbow));
    EXPECT_EQ(alone.muscle_at_joint(m, elbow).moment_arm_m, with_shape.muscle_at_joint(m, elbow).moment_arm_m);
  }
}

}  // namespace
}  // namespace myotact::simulation
