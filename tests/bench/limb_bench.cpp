// What a step of a limb costs: its parts, whole steps by workers and vector registers, how the cost grows with the tets
// of a muscle and with the number of muscles, and memory. Arguments that are no options of Google Benchmark are folders
// of specimens of other resolutions; without one, the two built-in limbs alone.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/SparseCholesky>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "simulation/element/muscle_batch.h"
#include "simulation/limb/find_touches.h"
#include "simulation/limb/settle.h"
#include "simulation/muscle/bone_contact_forces.h"
#include "simulation/simulation.h"

namespace myotact::simulation {
namespace {

constexpr double kActivation = 0.3;

TissueLoad step_load() {
  TissueLoad load;
  load.rule = second_order(0.01);
  return load;
}

int tets_of(const anatomy::Specimen& specimen) {
  std::size_t tets = 0;
  for (const anatomy::Muscle& muscle : specimen.muscles) tets += muscle.tets.corners.size();
  return static_cast<int>(tets);
}

/// All muscles, active, at rest, with everything a Newton step computes.
Limb prepared(const anatomy::Specimen& specimen) {
  Limb limb(specimen);
  for (LimbMuscle& muscle : limb.muscles) {
    muscle.state.activation = kActivation;
    compute_system(limb.skeleton, step_load(), muscle);
    compute_system(limb.skeleton, step_load(), muscle, Accuracy::Refined);
    Eigen::MatrixXd solution;
    factor_system(muscle, muscle.system.residual_N, solution, Accuracy::Refined);
  }
  return limb;
}

MuscleBatch active_batch(const TissueBatch& batch, const PointBatch<QuadraticTet>& points) {
  MuscleBatch muscle{batch.tets.shapes, points, kMuscleMatrix.matrix, {}};
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    muscle.fluctuation_Pa.lane[lane] = kMuscleMatrix.fluctuation_Pa;
    for (std::size_t p = 0; p < kTetPoints; ++p) {
      muscle.stress_Pa[p].lane[lane] = kActivation * batch.peak_Pa.lane[lane];
      muscle.slope_Pa[p].lane[lane] = batch.peak_Pa.lane[lane];
    }
  }
  return muscle;
}

void element_stiffness(Limb& limb, bool assemble) {
  for (LimbMuscle& muscle : limb.muscles) {
    for (std::size_t b = 0; b < muscle.tissue.batches.size(); ++b) {
      const TissueBatch& batch = muscle.tissue.batches[b];
      TetBlocks<Eight, QuadraticTet> blocks;
      muscle_stiffness(active_batch(batch, muscle.system.points[b]), false, blocks);
      benchmark::DoNotOptimize(blocks);
      if (!assemble) continue;
      scatter<QuadraticTet>(muscle.system.factor.slots[b], batch.tets.count, blocks,
                            muscle.system.factor.matrix.values());
    }
  }
}

/// Reads as many bytes as the factors have, once: what a solve, which reads them twice, cannot go below.
void read_factors(const std::vector<std::vector<float>>& copies) {
  for (const std::vector<float>& copy : copies) {
    float sums[64] = {};
    for (std::size_t i = 0; i + 64 <= copy.size(); i += 64) {
      for (std::size_t k = 0; k < 64; ++k) sums[k] += copy[i + k];
    }
    benchmark::DoNotOptimize(sums);
  }
}

template <class Task>
void add(const std::string& name, Task task) {
  benchmark::RegisterBenchmark(name.c_str(), task)->Unit(benchmark::kMillisecond)->MinTime(0.5)->UseRealTime();
}

/// A part of a step, over all muscles on one thread.
template <class Task>
void add_part(const std::string& name, const anatomy::Specimen& specimen, Task task) {
  add("part/" + name, [&specimen, task](benchmark::State& state) {
    Limb limb = prepared(specimen);
    for (auto _ : state) task(limb);
  });
}

template <class Task>
auto each_muscle(Task task) {
  return [task](Limb& limb) {
    for (LimbMuscle& muscle : limb.muscles) task(limb, muscle);
  };
}

void add_parts(const anatomy::Specimen& specimen) {
  add("part/Eigen's factor", [&specimen](benchmark::State& state) {
    const Limb limb = prepared(specimen);
    std::vector<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>> peers(limb.muscles.size());
    for (std::size_t m = 0; m < peers.size(); ++m) peers[m].analyzePattern(limb.muscles[m].system.matrix.lower());
    for (auto _ : state) {
      for (std::size_t m = 0; m < peers.size(); ++m) peers[m].factorize(limb.muscles[m].system.matrix.lower());
    }
  });
  add_part("tangent and factor", specimen, each_muscle([](Limb& limb, LimbMuscle& muscle) {
             compute_system(limb.skeleton, step_load(), muscle);
             muscle.system.factor.matrix.factor();
           }));
  add_part("tangent", specimen, each_muscle([](Limb& limb, LimbMuscle& muscle) {
             muscle.system.points_at_m[0] = 1e9;  // look at the points anew
             compute_system(limb.skeleton, step_load(), muscle);
           }));
  add_part("element stiffness", specimen, [](Limb& limb) { element_stiffness(limb, false); });
  add_part("element stiffness and assembly", specimen, [](Limb& limb) { element_stiffness(limb, true); });
  add_part("forces", specimen, each_muscle([](Limb& limb, LimbMuscle& muscle) {
             muscle.system.points_at_m[0] = 1e9;
             compute_forces(muscle.tissue, limb.skeleton, step_load(), muscle.state, muscle.system);
           }));
  for (const int columns : {1, 4}) {
    add_part(fmt::format("solve, right sides: {}", columns), specimen, each_muscle([columns](Limb&, LimbMuscle& m) {
               const Eigen::MatrixXd right = Eigen::MatrixXd::Ones(m.system.residual_N.size(), columns);
               benchmark::DoNotOptimize(m.system.factor.matrix.solve(right).data());
             }));
  }
  add("part/factors read twice", [&specimen](benchmark::State& state) {
    const Limb limb = prepared(specimen);
    std::vector<std::vector<float>> copies;
    for (const LimbMuscle& muscle : limb.muscles) copies.emplace_back(muscle.system.factor.matrix.places(), 1.0F);
    for (auto _ : state) {
      read_factors(copies);
      read_factors(copies);
    }
  });
  add_part("matrix times vector", specimen, each_muscle([](Limb&, LimbMuscle& m) {
             const auto matrix = m.system.matrix.lower().selfadjointView<Eigen::Lower>();
             const Eigen::VectorXd product = matrix * m.system.residual_N;
             benchmark::DoNotOptimize(product.data());
           }));
  add_part("stiffness read-out of all muscles", specimen,
           each_muscle([](Limb& limb, LimbMuscle& m) { refresh_muscle_stiffness(limb, m); }));
}

/// What contact adds to a step: faces under nodes found anew, as where everything moves; bones under nodes in one pass.
void add_contact_parts(const anatomy::Specimen& specimen) {
  add_part("faces of neighbours under all nodes", specimen, [](Limb& limb) {
    WorkerPool workers(1);
    find_touches(limb, workers);
  });
  add_part("bones under all nodes", specimen, each_muscle([](Limb& limb, LimbMuscle& muscle) {
             muscle.system.internal_N.setZero();
             add_bone_contact({muscle.tissue, limb.skeleton, step_load(), muscle.state, muscle.system, false});
           }));
}

double resident_MB() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}

void step(benchmark::State& state, const anatomy::Specimen& specimen, int workers, VectorUnit widest,
          Contact contact = Contact::All) {
  allow_vector_unit(widest);
  const double before_MB = resident_MB();
  SimulationSettings settings;
  settings.workers = workers;
  settings.contact = contact;
  Simulation simulation(specimen, settings);
  const std::vector<double> angles_rad(specimen.joints.size(), 0.0), activations(specimen.muscles.size(), kActivation);
  if (!simulation.settle(angles_rad, activations)) state.SkipWithError("the limb does not settle");
  for (int i = 0; i < 10; ++i) simulation.step({});
  for (auto _ : state) simulation.step({});
  state.counters["tets"] = tets_of(specimen);
  state.counters["Hz"] = benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["MB_more"] = resident_MB() - before_MB;
  allow_vector_unit(VectorUnit::Avx512);
}

void add_steps(const std::string& name, const anatomy::Specimen& specimen) {
  const auto add_step = [&](int workers, const char* registers, VectorUnit unit) {
    add(fmt::format("step/{}/workers:{}/{}", name, workers, registers),
        [&specimen, workers, unit](benchmark::State& state) { step(state, specimen, workers, unit); });
  };
  for (const int workers : {1, 2}) {
    add_step(workers, "AVX-512", VectorUnit::Avx512);
    add_step(workers, "AVX2", VectorUnit::Avx2);
    add_step(workers, "SSE2", VectorUnit::Sse2);
    add(fmt::format("step/{}/workers:{}/AVX-512/no contact", name, workers),
        [&specimen, workers](benchmark::State& state) {
          step(state, specimen, workers, VectorUnit::Avx512, Contact::None);
        });
  }
}

/// Newton step of one muscle: tangent, factor, solve. For the growth of the cost with its tets.
void add_sizes(const std::string& name, const anatomy::Specimen& specimen) {
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    const int tets = static_cast<int>(specimen.muscles[m].tets.corners.size());
    add(fmt::format("size/tets:{}/{}/{}", tets, name, specimen.muscles[m].key),
        [&specimen, m, tets](benchmark::State& state) {
          Limb limb(specimen);
          LimbMuscle& muscle = limb.muscles[m];
          muscle.state.activation = kActivation;
          for (auto _ : state) {
            compute_system(limb.skeleton, step_load(), muscle);
            Eigen::MatrixXd solution;
            factor_system(muscle, muscle.system.residual_N, solution);
          }
          state.counters["tets"] = tets;
          state.counters["factor_MB"] = static_cast<double>(muscle.system.factor.matrix.places()) * 4e-6;
        });
  }
}

/// The same muscles again and again, up to `count`.
anatomy::Specimen repeated(const anatomy::Specimen& specimen, std::size_t count) {
  anatomy::Specimen more = specimen;
  more.muscles.clear();
  more.lines.clear();
  more.groups.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t from = k % specimen.muscles.size();
    more.muscles.push_back(specimen.muscles[from]);
    more.muscles.back().key += fmt::format("_{}", k);
    for (anatomy::MuscleLine line : specimen.lines) {
      if (line.muscle != static_cast<int>(from)) continue;
      line.muscle = static_cast<int>(k);
      more.lines.push_back(line);
    }
  }
  return more;
}

}  // namespace
}  // namespace myotact::simulation

int main(int argc, char** argv) {
  using namespace myotact;
  benchmark::Initialize(&argc, argv);
  const std::filesystem::path built_in = data_folder() / "meshes";
  std::vector<std::filesystem::path> folders{built_in / "canine_elbow", built_in / "canine_forelimb"};
  for (int i = 1; i < argc; ++i) folders.emplace_back(argv[i]);
  std::vector<anatomy::Specimen> specimens;
  for (const auto& folder : folders) specimens.push_back(anatomy::load_specimen(folder));
  simulation::add_parts(specimens[0]);
  simulation::add_contact_parts(specimens[0]);
  for (std::size_t k = 0; k < folders.size(); ++k) {
    simulation::add_steps(folders[k].filename(), specimens[k]);
    simulation::add_sizes(folders[k].filename(), specimens[k]);
  }
  std::vector<anatomy::Specimen> repeats;
  for (const std::size_t count : {1UL, 2UL, 5UL, 10UL, 20UL, 40UL})
    repeats.push_back(simulation::repeated(specimens[0], count));
  for (const anatomy::Specimen& limb : repeats) {
    simulation::add(fmt::format("muscles:{}", limb.muscles.size()), [&limb](benchmark::State& state) {
      simulation::step(state, limb, 2, simulation::VectorUnit::Avx512);
    });
  }
  benchmark::RunSpecifiedBenchmarks();
}
