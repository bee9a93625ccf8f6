#include "simulation/touch/tool_springs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "simulation/line/line_model.h"
#include "support/synthetic_specimen.h"

// A client may send anything: what is sound becomes a spring at the right place, what is not becomes none.

namespace myotact::simulation {
namespace {

using messages::ToolState;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
/// The hardest pull of a spring that a solve is given; harder ones are softened to it.
constexpr double kMostPull_N = 200.0;

/// Two coarse bars over a hinge, posed and a little out of shape, so that rest and present places differ.
class ToolSprings : public ::testing::Test {
 protected:
  ToolSprings() : specimen_(testing::coarse_antagonist_hinge()), limb_(specimen_, {}, Tendon::Elastic, Contact::None) {
    for (std::size_t m = 0; m < limb_.muscles.size(); ++m) {
      skins_.push_back(embed_skin(specimen_.muscles[m].skin, limb_.muscles[m].tissue.mesh));
    }
    limb_.now.angle_rad[0] = 0.3;
    follow_angles(limb_);
    std::mt19937 random(61);
    std::normal_distribution<double> normal(0.0, 1e-3);
    for (LimbMuscle& muscle : limb_.muscles) {
      for (double& x : muscle.state.now.position_m) x += normal(random);
    }
  }

  std::vector<ToolSpring> springs(const std::vector<ToolState>& tools) const {
    return tool_springs(tools, {specimen_, skins_}, limb_);
  }
  std::size_t count(const ToolState& tool) const { return springs({tool}).size(); }

  /// Presses a skin, pulls a line and holds a bone at once, each softly.
  static ToolState busy() {
    ToolState tool;
    tool.tool_position_world_m = {0.01, 0.02, 0.03};
    tool.contact.surface = 1;
    tool.contact.triangle = 5;
    tool.contact.barycentric = {0.2, 0.3, 0.5};
    tool.contact.target_world_m = {-0.03, 0.0, -0.05};
    tool.contact.stiffness_N_m = 300.0;
    tool.grabbed_line = 0;
    tool.grab_fraction = 0.4;
    tool.line_stiffness_N_m = 250.0;
    tool.grabbed_body = 1;
    tool.body_point_rest_m = {0.1, 0.0, 0.0};
    tool.body_target_world_m = {0.1, 0.0, 0.05};
    tool.body_stiffness_N_m = 200.0;
    return tool;
  }

  anatomy::Specimen specimen_;
  Limb limb_;
  std::vector<SkinEmbedding> skins_;
};

TEST_F(ToolSprings, SoundStatesGiveASpringForEachThingInHand) {
  const std::vector<ToolSpring> found = springs({ToolState{}, busy()});
  ASSERT_EQ(found.size(), 3u);
  const ToolState tool = busy();
  EXPECT_EQ(found[0].surface, 1);
  EXPECT_EQ(found[0].muscle, 1);
  EXPECT_EQ(found[0].stiffness_N_m, 300.0);
  EXPECT_EQ(found[0].target_W_m, to_vec3(tool.contact.target_world_m));
  EXPECT_EQ(found[1].muscle, 0);
  EXPECT_EQ(found[1].target_W_m, to_vec3(tool.tool_position_world_m));  // the line follows the device itself
  EXPECT_EQ(found[2].body, 1);
  EXPECT_EQ(found[2].muscle, -1);
  EXPECT_EQ(found[2].stiffness_N_m, 200.0);
  for (const ToolSpring& spring : found) EXPECT_EQ(spring.tool, 1);  // the first tool has nothing in hand
}

TEST_F(ToolSprings, ContactsBesideTheFirstShareItsStiffnessAndNameOtherSurfaces) {
  ToolState tool = busy();
  tool.beside[0] = tool.contact;  // the same surface once more
  tool.beside[1] = tool.contact;
  tool.beside[1].surface = 0;
  tool.beside[1].stiffness_N_m = 123.0;
  tool.beside[2] = tool.beside[1];
  tool.beside[2].target_world_m[0] = kNaN;
  const std::vector<ToolSpring> found = springs({tool});
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[1].surface, 0);
  EXPECT_EQ(found[1].stiffness_N_m, found[0].stiffness_N_m);
  EXPECT_TRUE(of_one_sphere(found[0], found[1]));
  EXPECT_FALSE(of_one_sphere(found[0], found[2]) || of_one_sphere(found[0], found[3]));
  tool.contact.surface = -1;
  EXPECT_EQ(count(tool), 2u) << "nothing lies beside no contact";
}

TEST_F(ToolSprings, AFarContactBesideMakesTheWholeCouplingSofter) {
  ToolState tool = busy();
  tool.beside[0] = tool.contact;
  tool.beside[0].surface = 0;
  tool.beside[0].target_world_m = {5.0, 0.0, 0.0};
  const std::vector<ToolSpring> found = springs({tool});
  ASSERT_EQ(found.size(), 4u);
  EXPECT_LE(found[1].stiffness_N_m * (found[1].target_W_m - spring_point(limb_, found[1])).norm(), 1.001 * kMostPull_N);
  EXPECT_EQ(found[0].stiffness_N_m, found[1].stiffness_N_m);
}

TEST_F(ToolSprings, ContactsPullWhereTheTouchedPointIsNow) {
  std::mt19937 random(62);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto muscles = static_cast<int>(specimen_.muscles.size());
  for (int round = 0; round < 200; ++round) {
    ToolState tool;
    tool.contact.surface = static_cast<int>(random() % (specimen_.muscles.size() + specimen_.bones.size()));
    const bool bone = tool.contact.surface >= muscles;
    const auto number = static_cast<std::size_t>(bone ? tool.contact.surface - muscles : tool.contact.surface);
    const geometry::TriangleMesh& mesh = bone ? specimen_.bones[number].surface : specimen_.muscles[number].skin;
    tool.contact.triangle = static_cast<int>(random() % mesh.triangles.size());
    const double a = uniform(random), b = uniform(random) * (1.0 - a);
    tool.contact.barycentric = {a, b, 1.0 - a - b};
    tool.contact.stiffness_N_m = 10.0;
    const std::vector<ToolSpring> found = springs({tool});
    ASSERT_EQ(found.size(), 1u);
    std::vector<Vec3> now_m = mesh.positions_m;
    if (bone) {
      for (Vec3& p : now_m) p = limb_.skeleton.body_pose(specimen_.bones[number].body) * p;
    } else {
      const Eigen::VectorXd& x = limb_.muscles[number].state.now.position_m;
      std::vector<Vec3> nodes_m;
      for (Eigen::Index n = 0; 3 * n < x.size(); ++n) nodes_m.emplace_back(x.segment<3>(3 * n));
      update_skin(skins_[number], nodes_m, now_m);
    }
    Vec3 expected_m = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
      const int vertex = mesh.triangles[static_cast<std::size_t>(tool.contact.triangle)][c];
      expected_m += tool.contact.barycentric[c] * now_m[static_cast<std::size_t>(vertex)];
    }
    EXPECT_LT((spring_point(limb_, found[0]) - expected_m).norm(), 1e-12) << tool.contact.surface;
  }
}

TEST_F(ToolSprings, ALineIsHeldAtItsFractionOfTheRestingLine) {
  for (LimbMuscle& muscle : limb_.muscles) muscle.state = make_state(muscle.tissue);
  const Vec3 origin_m = specimen_.lines[0].points.front().position_m;
  const Vec3 insertion_m = specimen_.lines[0].points.back().position_m;
  for (const double fraction : {0.0, 0.1, 0.37, 0.5, 0.93, 1.0, -4.0, 1e300}) {
    ToolState tool;
    tool.grabbed_line = 0;
    tool.grab_fraction = fraction;
    tool.line_stiffness_N_m = 100.0;
    const std::vector<ToolSpring> found = springs({tool});
    ASSERT_EQ(found.size(), 1u) << fraction;
    const Vec3 expected_m = origin_m + std::clamp(fraction, 0.0, 1.0) * (insertion_m - origin_m);
    EXPECT_LT((spring_point(limb_, found[0]) - expected_m).norm(), 1e-9) << fraction;
  }
}

struct Hostile {
  const char* what;
  std::function<void(ToolState& tool)> spoil;
};

/// Each takes its own spring away and leaves the other two.
TEST_F(ToolSprings, WhatDoesNotExistOrIsNoNumberGivesNoSpring) {
  constexpr int kLargest = std::numeric_limits<int>::max(), kSmallest = std::numeric_limits<int>::min();
  std::vector<Hostile> cases;
  for (const int index : {-1, -2, kSmallest, 4, kLargest}) {
    cases.push_back({"surface", [=](ToolState& t) { t.contact.surface = index; }});
    if (index != 4) cases.push_back({"triangle", [=](ToolState& t) { t.contact.triangle = index; }});
    cases.push_back({"line", [=](ToolState& t) { t.grabbed_line = index; }});
    cases.push_back({"body", [=](ToolState& t) { t.grabbed_body = index; }});
  }
  for (const double number : {kNaN, kInf, -kInf, 1e300, -1e300}) {
    for (std::size_t k = 0; k < 3; ++k) {
      cases.push_back({"barycentric", [=](ToolState& t) { t.contact.barycentric[k] = number; }});
      cases.push_back({"contact target", [=](ToolState& t) { t.contact.target_world_m[k] = number; }});
      cases.push_back({"tool position", [=](ToolState& t) { t.tool_position_world_m[k] = number; }});
      cases.push_back({"body target", [=](ToolState& t) { t.body_target_world_m[k] = number; }});
      cases.push_back({"body point", [=](ToolState& t) { t.body_point_rest_m[k] = number; }});
    }
    if (!std::isfinite(number)) cases.push_back({"fraction", [=](ToolState& t) { t.grab_fraction = number; }});
  }
  for (const double stiffness : {kNaN, kInf, 1e7, 0.0, -0.0, -50.0, -kInf}) {
    cases.push_back({"contact stiffness", [=](ToolState& t) { t.contact.stiffness_N_m = stiffness; }});
    cases.push_back({"line stiffness", [=](ToolState& t) { t.line_stiffness_N_m = stiffness; }});
    cases.push_back({"body stiffness", [=](ToolState& t) { t.body_stiffness_N_m = stiffness; }});
  }
  for (const Hostile& hostile : cases) {
    ToolState tool = busy();
    hostile.spoil(tool);
    EXPECT_EQ(count(tool), 2u) << hostile.what;
  }
}

/// Bytes of noise, as from a broken or malicious client: whatever comes of it is finite and bounded.
TEST_F(ToolSprings, AnyBytesGiveFiniteSpringsThatNoHandExceeds) {
  std::mt19937_64 random(63);
  const auto any = [&]() -> double {
    switch (random() % 4) {
      case 0:
        return kNaN;
      case 1:
        return std::ldexp(1.0, static_cast<int>(random() % 2000) - 1000) * (random() % 2 == 0 ? 1.0 : -1.0);
      default:
        return std::uniform_real_distribution<double>(-2.0, 2.0)(random);
    }
  };
  const auto few = [&] { return static_cast<int>(random() % 8) - 2; };
  std::size_t made = 0;
  for (int round = 0; round < 20'000; ++round) {
    ToolState tool;
    for (double* of_three :
         {tool.tool_position_world_m.data(), tool.contact.barycentric.data(), tool.contact.target_world_m.data(),
          tool.body_point_rest_m.data(), tool.body_target_world_m.data()}) {
      for (int k = 0; k < 3; ++k) of_three[k] = random() % 8 == 0 ? any() : 0.3 * (static_cast<double>(k) - 1.0);
    }
    tool.contact.surface = few(), tool.contact.triangle = few(), tool.grabbed_line = few(), tool.grabbed_body = few();
    tool.contact.stiffness_N_m = 1e3 * any(), tool.line_stiffness_N_m = 1e3 * any();
    tool.body_stiffness_N_m = 1e3 * any(), tool.grab_fraction = any();
    for (const ToolSpring& spring : springs({tool})) {
      const double length_m = (spring.target_W_m - spring_point(limb_, spring)).norm();
      ASSERT_TRUE(std::isfinite(length_m) && spring.stiffness_N_m > 0.0);
      ASSERT_LE(spring.stiffness_N_m * length_m, kMostPull_N * (1.0 + 1e-12));
      ++made;
    }
  }
  EXPECT_GT(made, 1000u);
}

TEST_F(ToolSprings, AHardPullIsSoftenedAndASoftOneIsLeftAlone) {
  ToolState tool = busy();
  tool.body_stiffness_N_m = 1e6;  // the stiffest that is taken
  const ToolSpring stiff = springs({tool})[2];
  const double length_m = (stiff.target_W_m - spring_point(limb_, stiff)).norm();
  EXPECT_NEAR(stiff.stiffness_N_m * length_m, kMostPull_N, 1e-9);
  tool.body_stiffness_N_m = 0.99 * kMostPull_N / length_m;
  EXPECT_EQ(springs({tool})[2].stiffness_N_m, tool.body_stiffness_N_m);
}

}  // namespace
}  // namespace myotact::simulation
