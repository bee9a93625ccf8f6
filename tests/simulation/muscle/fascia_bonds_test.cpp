#include "simulation/muscle/fascia_bonds.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/at.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/limb.h"
#include "simulation/limb/settle.h"
#include "simulation/limb/step.h"
#include "support/synthetic_specimen.h"

namespace myotact::simulation {
namespace {

constexpr Fascia kFascia{5e6, 1e6, 1e-3};
constexpr double kSide_m = 0.03, kWide_m = 0.05;  // of the upper and of the lower block
constexpr double kArea_m2 = kSide_m * kSide_m;

/// Two blocks of muscle on each other, the upper one's foot on the wider one's top at z = -0.06; nodes do not meet
/// nodes. The upper one hangs on the lower body, which moves with the hinge, the other stands on the upper body.
anatomy::Specimen stacked_blocks() {
  anatomy::Specimen specimen = testing::hinged_bones();
  specimen.bones.clear();
  specimen.joints[0].stiffness_Nm_rad = 0.0;
  for (int m = 0; m < 2; ++m) {
    testing::BarShape shape;
    shape.length_m = shape.width_m = m == 0 ? kSide_m : kWide_m;
    shape.origin_m = {0.115 - 0.5 * shape.length_m, 0.0, -0.06 + (m == 0 ? 0.5 : -0.5) * shape.width_m};
    shape.cells = m == 0 ? std::array<int, 3>{2, 2, 2} : std::array<int, 3>{5, 5, 3};
    anatomy::Muscle block = testing::bar_muscle(m == 0 ? "above" : "below", shape);
    for (std::size_t i = 0; i < block.attachments.size(); ++i) {
      const double z = block.tets.nodes_m[i].z();
      block.attachments[i] = z > -0.03 - 1e-9 ? 1 : z < -0.06 - kWide_m + 1e-9 ? 0 : -1;
    }
    specimen.lines.push_back(testing::bar_line(m, shape));
    specimen.muscles.push_back(block);
  }
  return specimen;
}

struct Blocks {
  explicit Blocks(const Fascia& fascia = kFascia, Contact contact = Contact::All)
      : limb(stacked_blocks(), {}, Tendon::Elastic, contact, fascia), workers(1) {}
  /// Moves all free nodes of a block.
  void shift(std::size_t muscle, const Vec3& by_m) {
    move_free_nodes(limb.muscles[muscle], by_m.replicate(limb.muscles[muscle].tissue.free_nodes, 1));
  }
  /// What the neighbours do to each block, summed over its nodes.
  Vec3 force_on_N(std::size_t muscle) {
    LimbMuscle& m = limb.muscles[muscle];
    const auto sum = [&] {
      compute_forces(m.tissue, limb.skeleton, {}, m.state, m.system);
      Vec3 total = Vec3::Zero();
      for (Eigen::Index i = 0; i < m.system.internal_N.size(); i += 3) total += m.system.internal_N.segment<3>(i);
      return total;
    };
    const Vec3 with = sum();
    const std::vector<NeighbourTouch> touches = std::exchange(m.state.touches, {});
    const Vec3 without = sum();
    m.state.touches = touches;
    return without - with;  // internal forces are the energy's gradient
  }
  /// What the springs of both surfaces' bonds pull the upper block with when it has moved by less than a bond's place
  /// stays for. Each has half of its node's area, tension along the normal and shear in all directions.
  Vec3 expected_on_above_N(const Vec3& by_m) const {
    Vec3 sum_N = Vec3::Zero();
    for (std::size_t m = 0; m < 2; ++m) {
      const double side = m == 0 ? 1.0 : -1.0;
      for (const FasciaBond& bond : limb.touch_surfaces[m].bonds) {
        const double area_m2 = 0.5 * limb.touch_surfaces[m].nodes[at(bond.node)].area_m2;
        const Vec3 normal = face_at(limb.touch_surfaces[at(bond.other)], bond.place).normal_W;
        const double overlap_m = -side * normal.dot(by_m);
        const double across_Pa = (kFascia.tension_Pa_m - kFascia.shear_Pa_m) * overlap_m +
                                 contact_pressure(kTissueContact, overlap_m).pressure_Pa;
        sum_N += area_m2 * (side * across_Pa * normal - kFascia.shear_Pa_m * by_m);
      }
    }
    return sum_N;
  }
  Limb limb;
  WorkerPool workers;
};

}  // namespace

TEST(Fascia, HoldsWhatLiesSideBySideAndPullsAtNothingAtRest) {
  Blocks blocks;
  find_touches(blocks.limb, blocks.workers);
  for (std::size_t m = 0; m < 2; ++m) {
    double area_m2 = 0.0;
    for (const FasciaBond& bond : blocks.limb.touch_surfaces[m].bonds) {
      EXPECT_EQ(bond.other, 1 - static_cast<int>(m));
      area_m2 += blocks.limb.touch_surfaces[m].nodes[at(bond.node)].area_m2;
    }
    // The nodes on the interface carry it, and at the foot's rim a part of the sides; the top's nodes beside it do not.
    EXPECT_GT(area_m2, 0.6 * kArea_m2);
    EXPECT_LT(area_m2, 1.5 * kArea_m2);
    EXPECT_LT(blocks.force_on_N(m).norm(), 1e-9);
  }
}

// Springs side by side along the normals that the surfaces have there, which lean outwards at the blocks' rims.
TEST(Fascia, DrawnApartPressedAndSlidItPullsAsItsSpringsDo) {
  for (const Vec3& by_m :
       {Vec3(0.0, 0.0, 0.2e-3), Vec3(0.0, 0.0, 3e-3), Vec3(0.0, 0.0, -0.6e-3), Vec3(0.4e-3, 0.0, 0.0)}) {
    Blocks blocks(kFascia, Contact::None);
    blocks.shift(0, by_m);
    find_touches(blocks.limb, blocks.workers);
    const Vec3 above_N = blocks.force_on_N(0), expected_N = blocks.expected_on_above_N(by_m);
    EXPECT_LT((above_N - expected_N).norm(), 1e-9 * expected_N.norm()) << by_m.transpose();
    EXPECT_LT((above_N + blocks.force_on_N(1)).norm(), 1e-9 * expected_N.norm());  // momentum
  }
}

// The whole area counts once, although both surfaces have nodes on it.
TEST(Fascia, AMillimetreApartItPullsWithTensionTimesTheInterface) {
  Blocks blocks(kFascia, Contact::None);
  blocks.shift(0, {0.0, 0.0, 1e-3});
  find_touches(blocks.limb, blocks.workers);
  const double whole_N = kFascia.tension_Pa_m * 1e-3 * kArea_m2;
  EXPECT_NEAR(blocks.force_on_N(0).z(), -whole_N, 0.3 * whole_N);  // the rims lean, and reach round the edges
}

// Far beyond what a bond's place stays for, the normal part has slid along and the shear is what is left.
TEST(Fascia, SlidFarTheBlocksAreHeldBackByTheShear) {
  const auto held_back_N = [](double shear_Pa_m) {
    Fascia fascia = kFascia;
    fascia.shear_Pa_m = shear_Pa_m;
    Blocks blocks(fascia, Contact::None);
    blocks.shift(0, {4e-3, 0.0, 0.0});
    find_touches(blocks.limb, blocks.workers);
    return -blocks.force_on_N(0).x();
  };
  const double more_N = held_back_N(kFascia.shear_Pa_m) - held_back_N(0.5 * kFascia.shear_Pa_m);
  const double expected_N = 0.5 * kFascia.shear_Pa_m * 4e-3 * kArea_m2;
  EXPECT_NEAR(more_N, expected_N, 0.4 * expected_N);  // the foot's rim carries a part of its sides
}

TEST(Fascia, HasNoPartWhereItIsNotAskedFor) {
  Blocks blocks({}, Contact::All);
  find_touches(blocks.limb, blocks.workers);
  for (const TouchSurface& surface : blocks.limb.touch_surfaces) EXPECT_TRUE(surface.bonds.empty());
  Blocks nothing({}, Contact::None);
  EXPECT_TRUE(nothing.limb.touch_surfaces.empty());
}

// Three springs in a row: block, fascia, block. The fascia is soft enough that its part shows.
TEST(Fascia, AJointThatItTransmitsToHasTheStiffnessThatItsTorqueHas) {
  constexpr Fascia kSoft{2e5, 2e4, 1e-3};
  Blocks blocks(kSoft);
  const double arm_m = 0.1 + 0.5 * kSide_m, h = 1e-4 / arm_m;
  const auto torque = [&](double angle) {
    EXPECT_TRUE(settle_limb(blocks.limb, {&angle, 1}, blocks.workers));
    return blocks.limb.muscles[0].readout.torque_Nm[0];
  };
  const double q = 3e-3 / arm_m, up = torque(q + h), down = torque(q - h);
  EXPECT_LT(torque(q), 0.0);  // drawn apart by the hinge, it pulls back
  refresh_stiffness(blocks.limb, blocks.workers);
  const double stiffness = blocks.limb.muscles[0].stiffness_Nm_rad[0];
  EXPECT_NEAR(stiffness, (down - up) / (2.0 * h), 0.03 * stiffness);
  const double fascia_alone = kSoft.tension_Pa_m * kArea_m2 * arm_m * arm_m;
  EXPECT_LT(stiffness, fascia_alone);
  EXPECT_GT(stiffness, 0.3 * fascia_alone);
  EXPECT_GT(blocks.limb.muscles[0].contact_stiffness_Nm_rad[0], 0.0);
}

TEST(Fascia, AStepsBitsDoNotDependOnWorkersNorOnWhatWasBefore) {
  const auto run = [](Blocks& blocks, int threads) {
    WorkerPool workers(threads);
    return_to_file_pose(blocks.limb);
    find_touches(blocks.limb, workers);
    blocks.limb.external_torque_Nm[0] = 0.05;
    for (int i = 0; i < 50; ++i) {
      push_history(blocks.limb);
      EXPECT_TRUE(advance(blocks.limb, {0.01, i > 0}, workers).sound);
    }
    return hash_of_state(blocks.limb);
  };
  Blocks first, second;
  const std::uint64_t one = run(first, 1);
  EXPECT_EQ(one, run(second, 2));
  EXPECT_EQ(one, run(second, 8));
}

}  // namespace myotact::simulation
