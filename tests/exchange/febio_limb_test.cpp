// A muscle at a pose, as a model for FEBio: solved on its own it rests where the simulation has it.

#include "exchange/febio_limb.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/febio_read.h"
#include "measure/solve_answer.h"
#include "simulation/tissue_snapshot.h"
#include "support/synthetic_specimen.h"

namespace myotact::exchange {
namespace {

scene::Scene scene_of(const anatomy::Specimen& specimen) {
  scene::Scene scene;
  scene.name = "bar";
  scene.specimen = specimen;
  scene.settings.contact = simulation::Contact::None;
  return scene;
}

std::vector<Vec3> solved_m(const measure::SolveCase& input) {
  const measure::SolveAnswer answer = measure::solve_case(input, [](const auto&) {});
  EXPECT_TRUE(answer.converged);
  return answer.deformed.mesh.nodes_m;
}

double farthest_m(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  EXPECT_EQ(a.size(), b.size());
  double farthest = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) farthest = std::max(farthest, (a[n] - b[n]).norm());
  return farthest;
}

TEST(FebioLimb, AMuscleRestsWhereTheSimulationHasIt) {
  myotact::testing::BarShape shape;
  for (const int tendon_cells : {0, 2}) {
    shape.tendon_cells = tendon_cells;
    const scene::Scene scene = scene_of(myotact::testing::single_muscle(shape));
    simulation::Simulation simulation(scene.specimen, scene.settings);
    ASSERT_TRUE(simulation.settle(std::vector<double>{0.35}, std::vector<double>{0.4}));
    const FebioLimb limb = febio_limb(scene, simulation, {0});
    const std::vector<Vec3> ours = solved_m(limb.solve_case);
    const std::vector<Vec3> simulated = simulation.tissue(0).position_m;
    const double moved_m = farthest_m(simulated, limb.solve_case.mesh.mesh.nodes_m);
    EXPECT_GT(moved_m, 5e-3);
    // Peak stresses in steps of 1 %, the term that holds a tet's points together a little softer.
    EXPECT_LT(farthest_m(ours, simulated), 0.02 * moved_m) << tendon_cells;
    const FebioText text = febio_text(limb.solve_case, limb.notes, limb.activations);
    const measure::SolveCase again = parse_febio(text.text, "bar.feb").solve_case;
    EXPECT_LT(farthest_m(ours, solved_m(again)), 1e-4 * moved_m) << tendon_cells;
  }
}

TEST(FebioLimb, AWholeLimbHasAnActivationForEachMuscle) {
  const scene::Scene scene = scene_of(myotact::testing::antagonist_hinge());
  simulation::Simulation simulation(scene.specimen, scene.settings);
  ASSERT_TRUE(simulation.settle(std::vector<double>{0.0}, std::vector<double>{0.5, 0.25}));
  const FebioLimb limb = febio_limb(scene, simulation, {0, 1});
  const FebioText text = febio_text(limb.solve_case, limb.notes, limb.activations);
  EXPECT_THAT(text.text, ::testing::HasSubstr("<activation lc=\"1\">0.5</activation>"));
  EXPECT_THAT(text.text, ::testing::HasSubstr("<activation lc=\"1\">0.25</activation>"));
  try {
    parse_febio(text.text, "limb.feb");
    FAIL() << "one activation for all is read";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("activations 0.5 and 0.25"));
  }
}

TEST(FebioLimb, MusclesThatAreNoFiniteElementsAreWrittenToo) {
  scene::Scene scene = scene_of(myotact::testing::antagonist_hinge());
  scene.settings.tissue = {simulation::TissueModel::Line, simulation::TissueModel::Rigid};
  simulation::Simulation simulation(scene.specimen, scene.settings);
  ASSERT_TRUE(simulation.settle(std::vector<double>{0.1}, std::vector<double>{0.2, 0.2}));
  const FebioLimb limb = febio_limb(scene, simulation, {0, 1});
  EXPECT_TRUE(parse_febio(febio_text(limb.solve_case, limb.notes, limb.activations).text, "limb.feb")
                  .solve_case.mesh.mesh.quadratic());
}

}  // namespace
}  // namespace myotact::exchange
