// Implicit steps of the meshes and settings on which other programs were timed: beams and muscles under gravity,
// density 1060 kg/m3, E 300 kPa (beams) and 30 kPa (muscles), nu 0.45, steps of 10 ms by backward Euler with one Newton
// step. Beside ours runs the plain loop that one would write first: the same elements one at a time and Eigen's sparse
// factorisation. Those need MYOTACT_CANINE_DIR; a static cantilever beside Eigen's solver does not.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include <Eigen/SparseCholesky>
#include <benchmark/benchmark.h>

#include "geometry/box_mesh.h"
#include "geometry/mesh_files.h"
#include "simulation/solid/law_batch.h"
#include "simulation/solid/solid_motion.h"
#include "simulation/solid/static_solve.h"

namespace myotact::simulation {
namespace {

struct Scenario {
  const char* mesh;
  bool beam;
  double best_peer_ms;  // SOFA, corotated linear tets with its sparse LDL, on a machine of this kind
};
constexpr Scenario kScenarios[] = {{"beam_2k", true, 5.5},  {"bic_2k", false, 2.8},  {"beam_5k", true, 19.4},
                                   {"bic_5k", false, 17.1}, {"tri_5k", false, 19.0}, {"rec_5k", false, 11.1},
                                   {"beam_20k", true, 269}, {"bic_20k", false, 99.6}};

std::filesystem::path mesh_folder() {
  const char* folder = std::getenv("MYOTACT_CANINE_DIR");
  return folder == nullptr ? std::filesystem::path() : std::filesystem::path(folder) / "bench";
}

/// Nodes at the fixed end: x = 0 of a beam; the highest 8 % of z of a muscle.
SolidLoads loads_of(const Solid& solid, bool beam) {
  SolidLoads loads;
  loads.gravity_m_s2 = Vec3(0.0, -9.81, 0.0);
  double low = std::numeric_limits<double>::max(), high = -low;
  for (int n = 0; n < solid.nodes(); ++n) {
    const double along = beam ? -solid.rest_m()[3 * n] : solid.rest_m()[3 * n + 2];
    low = std::min(low, along);
    high = std::max(high, along);
  }
  const double limit = beam ? high - 1e-9 : high - 0.08 * (high - low);
  for (int n = 0; n < solid.nodes(); ++n) {
    const double along = beam ? -solid.rest_m()[3 * n] : solid.rest_m()[3 * n + 2];
    for (int i = 0; along >= limit && i < 3; ++i) loads.held.push_back({n, i, 0.0});
  }
  return loads;
}

SolidInput input_of(const Scenario& scenario, ElementKind kind) {
  const double young_Pa = scenario.beam ? 300e3 : 30e3, nu = 0.45;
  const double shear_Pa = 0.5 * young_Pa / (1 + nu), lambda_Pa = young_Pa * nu / ((1 + nu) * (1 - 2 * nu));
  SolidInput input;
  input.mesh = geometry::read_tet_mesh(mesh_folder() / (std::string(scenario.mesh) + ".node")).mesh;
  for (std::size_t t = 0; t < input.mesh.corners.size(); ++t) {
    if (geometry::corner_volume_m3(input.mesh, t) < 0.0) std::swap(input.mesh.corners[t][0], input.mesh.corners[t][1]);
  }
  input.kind = kind;
  input.materials = {{{Corotated{shear_Pa, lambda_Pa}}, 1060.0, -1.0}};
  return input;
}

void ours(benchmark::State& state, const Scenario& scenario, ElementKind kind) {
  const Solid solid(input_of(scenario, kind), scenario.mesh);
  SolidMotion motion(solid, loads_of(solid, scenario.beam), {0.01, false, 1, true});
  for (auto _ : state) {
    if (!motion.step()) state.SkipWithError("a step failed");
  }
  state.counters["tets"] = static_cast<double>(solid.mesh().corners.size());
  state.counters["peer_ms"] = scenario.best_peer_ms;
}

/// The loop that one would write first.
void plain_loop(benchmark::State& state, const Scenario& scenario) {
  const SolidInput input = input_of(scenario, ElementKind::Linear);
  const Solid solid(input, scenario.mesh);
  const SolidLoads loads = loads_of(solid, scenario.beam);
  std::vector<char> held(static_cast<std::size_t>(3 * solid.nodes()), 0);
  for (const HeldDof& dof : loads.held) held[static_cast<std::size_t>(3 * dof.node + dof.component)] = 1;
  Eigen::VectorXd x = solid.rest_m(), v = Eigen::VectorXd::Zero(x.size());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  bool analysed = false;
  const double rate = 100.0;
  for (auto _ : state) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(x.size());
    for (const auto& tet : input.mesh.corners) {
      std::array<Vec3, 4> corners;
      TetNodeVectors<double, LinearTet> position;
      for (std::size_t a = 0; a < 4; ++a) {
        corners[a] = solid.rest_m().segment<3>(3 * tet[a]);
        for (std::size_t i = 0; i < 3; ++i) position[a][i] = x[3 * tet[a] + static_cast<int>(i)];
      }
      const TetShape<double> shape = make_tet_shape(corners, Vec3::Zero());
      std::array<Point<double>, 1> points;
      deform_tet<LinearTet>(shape, position, points);
      const Response<double> response = respond_at(input.materials[0].laws, points[0], 0.0);
      TetNodeVectors<double, LinearTet> nodal;
      tet_forces<LinearTet>(shape, std::array<Matrix3<double>, 1>{response.P}, nodal);
      TetBlocks<double, LinearTet> blocks;
      tet_stiffness<LinearTet>(shape, std::array<PackedTangent<double>, 1>{response.C}, blocks);
      std::size_t pair = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        for (int i = 0; i < 3; ++i) force[3 * tet[a] + i] += nodal[a][static_cast<std::size_t>(i)];
        for (std::size_t b = a; b < 4; ++b, ++pair) {
          for (int e = 0; e < 9; ++e) {
            int row = 3 * tet[a] + e / 3, column = 3 * tet[b] + e % 3;
            if (row < column) std::swap(row, column);
            if (a == b && e / 3 < e % 3) continue;
            const bool skip = held[static_cast<std::size_t>(row)] != 0 || held[static_cast<std::size_t>(column)] != 0;
            entries.emplace_back(row, column, skip ? 0.0 : blocks[pair][static_cast<std::size_t>(e)]);
          }
        }
      }
    }
    for (int k = 0; k < x.size(); ++k) {
      const double mass = solid.mass_kg()[k / 3];
      const bool is_held = held[static_cast<std::size_t>(k)] != 0;
      entries.emplace_back(k, k, is_held ? 1.0 : mass * rate * rate);
      force[k] = is_held ? 0.0 : force[k] - mass * (rate * v[k] + loads.gravity_m_s2[k % 3]);
    }
    Eigen::SparseMatrix<double> matrix(x.size(), x.size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!analysed) factor.analyzePattern(matrix);
    analysed = true;
    factor.factorize(matrix);
    const Eigen::VectorXd change = factor.solve(-force);
    x += change;
    v = rate * change;
  }
}

/// Cantilever of 21,504 linear tets under its own weight: E 300 kPa, nu 0.45, 0.4 x 0.057 x 0.057 m.
struct Cantilever {
  Cantilever() : solid(input(), "cantilever") {
    loads.gravity_m_s2 = Vec3(0.0, 0.0, -9.81);
    for (int n = 0; n < solid.nodes(); ++n) {
      for (int i = 0; solid.rest_m()[3 * n] < 1e-9 && i < 3; ++i) loads.held.push_back({n, i, 0.0});
    }
  }
  static SolidInput input() {
    SolidInput input;
    input.mesh = geometry::make_box_mesh(Vec3(0.4, 0.4 / 7.0, 0.4 / 7.0), {56, 8, 8});
    input.kind = ElementKind::Linear;
    const double young_Pa = 300e3, nu = 0.45, shear_Pa = 0.5 * young_Pa / (1 + nu);
    input.materials = {{{StableNeoHookean{shear_Pa, young_Pa * nu / ((1 + nu) * (1 - 2 * nu))}}, 1060.0, -1.0}};
    return input;
  }
  Solid solid;
  SolidLoads loads;
};

void static_solve(benchmark::State& state) {
  const Cantilever beam;
  StaticOptions options;
  options.tolerance = 1e-6;
  for (auto _ : state) {
    const StaticResult result = solve_static(beam.solid, beam.loads, beam.solid.rest_m(), options);
    if (!result.converged) state.SkipWithError("no equilibrium");
    state.counters["newton_steps"] = result.iterations;
  }
}

/// Analysis, factorisation and solution of the tangent at rest by Eigen's own solver: its first Newton step, elements
/// not counted.
void eigen_first_step(benchmark::State& state) {
  const Cantilever beam;
  Solid::Evaluation at = beam.solid.make_evaluation();
  out_of_balance({beam.solid, beam.loads}, 1.0, beam.solid.rest_m(), Solid::Tangent::Exact, at);
  const HeldSystem system(beam.solid, beam.loads.held);
  system.hold(at.stiffness);
  system.drop_held(at.force_N);
  for (auto _ : state) {
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(at.stiffness.lower());
    const Eigen::VectorXd step = factor.solve(-at.force_N);
    benchmark::DoNotOptimize(step.data());
  }
}

}  // namespace
}  // namespace myotact::simulation

int main(int argc, char** argv) {
  using namespace myotact::simulation;
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("cantilever_20k/static to 1e-6", static_solve)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("cantilever_20k/Eigen's first step", eigen_first_step)->Unit(benchmark::kMillisecond);
  if (mesh_folder().empty()) {
    std::fprintf(stderr, "the other programs' meshes are skipped: set MYOTACT_CANINE_DIR to the folder of bench/\n");
    benchmark::RunSpecifiedBenchmarks();
    return 0;
  }
  for (const Scenario& scenario : kScenarios) {
    const std::string name = scenario.mesh;
    const auto add = [&](const std::string& what, auto&& run) {
      benchmark::RegisterBenchmark((name + "/" + what).c_str(), run)->Unit(benchmark::kMillisecond)->MinTime(0.3);
    };
    add("linear", [&scenario](benchmark::State& state) { ours(state, scenario, ElementKind::Linear); });
    add("plain_loop", [&scenario](benchmark::State& state) { plain_loop(state, scenario); });
  }
  for (const auto& scenario :
       {Scenario{"beam_c60", true, 0.62}, Scenario{"beam_c240", true, 3.3}, Scenario{"beam_c480", true, 7.4}}) {
    benchmark::RegisterBenchmark((std::string(scenario.mesh) + "/quadratic").c_str(),
                                 [scenario](benchmark::State& state) { ours(state, scenario, ElementKind::Quadratic); })
        ->Unit(benchmark::kMillisecond)
        ->MinTime(0.3);
  }
  benchmark::RunSpecifiedBenchmarks();
}
