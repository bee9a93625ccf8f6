// Cost of the parts of one simulation step on the canine forelimb, beside Eigen's sparse Cholesky on the same matrices.
// Prints the median of repeated runs; all muscles on one thread, then whole steps with one and two workers.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

#include <Eigen/SparseCholesky>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "simulation/settle.h"
#include "simulation/simulation.h"

namespace myotact::simulation {
namespace {

constexpr int kRepeats = 41;

template <class Task>
double median_ms(Task&& task) {
  std::vector<double> times_ms;
  for (int i = 0; i < kRepeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    task();
    times_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times_ms.begin(), times_ms.begin() + kRepeats / 2, times_ms.end());
  return times_ms[kRepeats / 2];
}

void print(const char* what, double ms, double reference_ms) {
  std::printf("%-44s %8.3f ms  %6.3f x Eigen's factor\n", what, ms, ms / reference_ms);
}

void time_parts(const anatomy::Specimen& specimen) {
  Limb limb(specimen);
  TissueLoad load;
  load.rule = second_order(0.01);
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.state.activation = 0.3;
    compute_system(muscle.tissue, limb.skeleton, load, muscle.state, muscle.system);
  }
  const auto for_all = [&limb](auto&& task) {
    return median_ms([&] {
      for (LimbMuscle& muscle : limb.muscles) task(muscle);
    });
  };
  std::vector<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>> peers(limb.muscles.size());
  for (std::size_t m = 0; m < peers.size(); ++m) peers[m].analyzePattern(limb.muscles[m].system.matrix.lower());
  const double reference_ms = median_ms([&] {
    for (std::size_t m = 0; m < peers.size(); ++m) peers[m].factorize(limb.muscles[m].system.matrix.lower());
  });
  print("Eigen SimplicialLDLT, numeric factorisation", reference_ms, reference_ms);
  print("factor", for_all([](LimbMuscle& m) { m.factor.matrix.factor(m.system.matrix); }), reference_ms);
  print("forces", for_all([&](LimbMuscle& m) { compute_forces(m.tissue, limb.skeleton, load, m.state, m.system); }),
        reference_ms);
  print("forces and tangent",
        for_all([&](LimbMuscle& m) { compute_system(m.tissue, limb.skeleton, load, m.state, m.system); }),
        reference_ms);
  for (const int columns : {1, 4}) {
    std::vector<Eigen::MatrixXd> right;
    for (const LimbMuscle& m : limb.muscles) {
      right.push_back(Eigen::MatrixXd::Ones(m.system.residual_N.size(), columns));
    }
    const double ms = median_ms([&] {
      for (std::size_t m = 0; m < right.size(); ++m) limb.muscles[m].factor.matrix.solve(right[m]);
    });
    print(columns == 1 ? "solve, 1 right side" : "solve, 4 right sides", ms, reference_ms);
  }
  print("stiffness refresh of all muscles", for_all([&](LimbMuscle& m) { refresh_muscle_stiffness(limb, m); }),
        reference_ms);
}

void time_steps(const anatomy::Specimen& specimen, int workers) {
  SimulationSettings settings;
  settings.workers = workers;
  Simulation simulation(specimen, settings);
  const std::vector<double> angles_rad(specimen.joints.size(), 0.0), activations(specimen.muscles.size(), 0.3);
  simulation.settle(angles_rad, activations);
  for (int i = 0; i < 10; ++i) simulation.step({});
  const double ms = median_ms([&] { simulation.step({}); });
  std::printf("whole step of 10 ms, %d worker%s %26.3f ms  %s 10 ms\n", workers, workers == 1 ? " " : "s", ms,
              ms < 10.0 ? "met:" : "missed:");
}

}  // namespace
}  // namespace myotact::simulation

int main() {
  using namespace myotact;
  const anatomy::Specimen specimen = anatomy::load_specimen(data_folder() / "meshes" / "canine_forelimb");
  simulation::time_parts(specimen);
  for (const int workers : {1, 2}) simulation::time_steps(specimen, workers);
}
