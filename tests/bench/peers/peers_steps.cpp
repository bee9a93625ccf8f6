// The same bodies stepped by our solid, by our elements with CHOLMOD's factorisation and by Bullet's deformable bodies,
// one after the other in one process, one thread each. Prints tables in Markdown; with a folder as its argument it
// leaves there what the program for MuJoCo needs.

#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bullet_body.h"
#include "cholmod_factor.h"
#include "core/file.h"
#include "peer_body.h"
#include "simulation/solid/solid_motion.h"

namespace myotact::peers {
namespace {

using simulation::ElementKind;
using simulation::Solid;

simulation::Law corotated(const PeerBody& body) {
  return simulation::Corotated{body.shear_Pa(), body.lambda_Pa()};
}
simulation::Law stable(const PeerBody& body) {
  return simulation::StableNeoHookean{body.shear_Pa(), body.lambda_Pa()};
}

std::vector<double> as_vector(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// At rest under the whole load; of a body that swings, after the same steps, each solved by ten Newton steps.
std::vector<double> converged(const PeerBody& body, const PeerSolid& at) {
  if (body.settles) {
    const simulation::StaticResult rest = solve_static(at.solid, at.loads, at.solid.rest_m(), {});
    return rest.converged ? as_vector(rest.position_m) : std::vector<double>();
  }
  simulation::SolidMotion motion(at.solid, at.loads, {kStep_s, false, 10, false});
  for (int k = 0; k < body.steps; ++k) {
    if (!motion.step()) return {};
  }
  return as_vector(motion.position_m());
}

PeerRow ours(const PeerBody& body, const PeerSolid& at, const std::string& law, bool single) {
  PeerRow row{.program = single ? "ours, single precision" : "ours, double precision", .law = law};
  simulation::SolidMotion motion(at.solid, at.loads, {kStep_s, false, 1, single});
  run_steps(
      body, row, [&] { return motion.step(); }, [&] { return as_vector(motion.position_m()); });
  return row;
}

/// Backward Euler with our elements, one Newton step without a line search, and CHOLMOD.
PeerRow with_cholmod(const PeerBody& body, const PeerSolid& at, CholmodFactor::Ordering ordering) {
  PeerRow row{.program = ordering == CholmodFactor::Ordering::Amd ? "our elements, CHOLMOD (AMD)"
                                                                  : "our elements, CHOLMOD (METIS)",
              .law = "corotated"};
  const Solid& solid = at.solid;
  CholmodFactor factor(solid.pattern(), ordering);
  const simulation::HeldSystem system(solid, at.loads.held);
  Solid::Evaluation here = solid.make_evaluation();
  Eigen::VectorXd x_m = solid.rest_m(), v_m_s = Eigen::VectorXd::Zero(x_m.size());
  const auto prepare = [&](Solid::Tangent tangent) {
    out_of_balance({solid, at.loads}, 1.0, x_m, tangent, here);
    for (int n = 0; n < solid.nodes(); ++n) {
      const double mass_kg = solid.mass_kg()[n];
      here.stiffness.add_diagonal(n, mass_kg / (kStep_s * kStep_s));
      here.force_N.segment<3>(3 * n) -= mass_kg / kStep_s * v_m_s.segment<3>(3 * n);
    }
    system.hold(here.stiffness);
    system.drop_held(here.force_N);
    return factor.factor(here.stiffness);
  };
  const auto step = [&] {
    if (!prepare(Solid::Tangent::Exact) && !prepare(Solid::Tangent::Definite)) return false;
    const Eigen::VectorXd change_m = factor.solve(-here.force_N);
    x_m += change_m;
    v_m_s = change_m / kStep_s;
    return change_m.allFinite();
  };
  run_steps(body, row, step, [&] { return as_vector(x_m); });
  return row;
}

PeerRow bullet(const PeerBody& body, const PeerSolid& at, BulletLaw law, bool line_search = false) {
  PeerRow row{.program = line_search ? "Bullet, deformable body, its line search" : "Bullet, deformable body",
              .law = law == BulletLaw::LinearCorotated ? "corotated" : "stable neo-Hookean"};
  BulletBody deformable(body, at.solid.mass_kg(), law, line_search);
  run_steps(
      body, row, [&] { return deformable.step(); }, [&] { return deformable.positions_m(); });
  return row;
}

/// `quadratic_mm`: the tip of the beam by quadratic tets, the truth that all meshes approach; 0: none known.
void print_row(const PeerBody& body, const PeerRow& row, double quadratic_mm) {
  if (!row.failure.empty()) {
    fmt::print("| {} | {} | {} | 1 | | | {} | | |\n", body.name, row.program, row.law, row.failure);
    return;
  }
  std::vector<double> sorted = row.step_ms;
  std::sort(sorted.begin(), sorted.end());
  const double late_ms = sorted[sorted.size() * 9 / 10], tip = tip_mm(body, row.positions_m);
  const std::string error =
      row.right_m.empty() ? "" : fmt::format("{:.2g}", 100.0 * largest_error(body, row.positions_m, row.right_m));
  const std::string truth = quadratic_mm == 0.0 ? "" : fmt::format("{:+.1f}", 100.0 * (tip / quadratic_mm - 1.0));
  fmt::print("| {} | {} | {} | 1 | {:.2f} | {:.2f} | {} | {:.2f} | {} |\n", body.name, row.program, row.law,
             median(row.step_ms), late_ms, error, tip, truth);
  std::fflush(stdout);
}

void print_head() {
  fmt::print(
      "| body | program | law | threads | ms a step, median | 90th | error to the converged answer, % | tip y, mm | "
      "tip "
      "to quadratic, % |\n|---|---|---|---|---|---|---|---|---|\n");
}

double rest_tip_mm(const PeerBody& body) {
  const PeerSolid fine(body, corotated(body), ElementKind::Quadratic);
  const std::vector<double> rest = converged(body, fine);
  return rest.empty() ? 0.0 : tip_mm(body, rest);
}

/// What the program for MuJoCo reads.
void leave(const std::string& folder, const PeerBody& body, const PeerSolid& at, const PeerRow& row, double truth_mm) {
  nlohmann::json json = {{"name", body.name},
                         {"young_Pa", body.young_Pa},
                         {"poisson", body.poisson},
                         {"held", body.held},
                         {"tip", body.tip},
                         {"steps", body.steps},
                         {"tets", body.mesh.corners},
                         {"settles", body.settles},
                         {"mass_kg", as_vector(at.solid.mass_kg())},
                         {"right_m", row.right_m},
                         {"quadratic_mm", truth_mm},
                         {"ours_ms", median(row.step_ms)},
                         {"rest_m", as_vector(at.solid.rest_m())}};
  write_file(std::filesystem::path(folder) / (body.name + ".json"), json.dump());
}

void step_body(const PeerBody& body, double quadratic_mm, const std::string& folder) {
  const PeerSolid at(body, corotated(body), ElementKind::Linear), same(body, stable(body), ElementKind::Linear);
  const std::vector<double> right = converged(body, at), right_stable = converged(body, same);
  const auto show = [&](PeerRow row) {
    row.right_m = row.law == "corotated" ? right : right_stable;
    print_row(body, row, body.settles ? quadratic_mm : 0.0);
    return row;
  };
  const PeerRow single = show(ours(body, at, "corotated", true));
  show(ours(body, at, "corotated", false));
  show(with_cholmod(body, at, CholmodFactor::Ordering::Amd));
  show(with_cholmod(body, at, CholmodFactor::Ordering::Metis));
  show(bullet(body, at, BulletLaw::LinearCorotated));
  show(ours(body, same, "stable neo-Hookean", true));
  show(bullet(body, same, BulletLaw::StableNeoHookean));
  if (!body.settles) show(bullet(body, same, BulletLaw::StableNeoHookean, true));
  if (!folder.empty()) leave(folder, body, at, single, body.settles ? quadratic_mm : 0.0);
}

/// Fewer quadratic tets in place of many linear ones.
void step_coarse_beam(double quadratic_mm) {
  const PeerBody body = coarse_beam();
  const PeerSolid at(body, corotated(body), ElementKind::Quadratic);
  PeerRow row = ours(body, at, "corotated", true);
  row.program = fmt::format("ours, {} quadratic tets, single", body.mesh.corners.size());
  row.right_m = converged(body, at);
  print_row(body, row, quadratic_mm);
}

/// Milliseconds of the median of some runs.
double time_ms(const std::function<void()>& work) {
  std::vector<double> times_ms;
  for (int k = 0; k < 21; ++k) {
    const double begin_ms = thread_ms();
    work();
    times_ms.push_back(thread_ms() - begin_ms);
  }
  return median(times_ms);
}

/// Factorisation and one solution of the matrix of a step from rest.
void compare_factors(const PeerBody& body) {
  const PeerSolid at(body, corotated(body), ElementKind::Linear);
  Solid::Evaluation here = at.solid.make_evaluation();
  out_of_balance({at.solid, at.loads}, 1.0, at.solid.rest_m(), Solid::Tangent::Exact, here);
  for (int n = 0; n < at.solid.nodes(); ++n) {
    here.stiffness.add_diagonal(n, at.solid.mass_kg()[n] / (kStep_s * kStep_s));
  }
  const simulation::HeldSystem system(at.solid, at.loads.held);
  system.hold(here.stiffness);
  system.drop_held(here.force_N);
  CholmodFactor amd(here.stiffness, CholmodFactor::Ordering::Amd),
      metis(here.stiffness, CholmodFactor::Ordering::Metis);
  simulation::ExactBlockFactor exact(here.stiffness);
  simulation::BlockFactor single(here.stiffness);
  const auto timed = [&](auto& factor, Eigen::VectorXd& answer) {
    return time_ms([&] {
      if (!factor.factor(here.stiffness)) throw std::runtime_error(body.name + " cannot be factored");
      answer = factor.solve(here.force_N);
    });
  };
  Eigen::VectorXd a, b, c, d;
  const double amd_ms = timed(amd, a), metis_ms = timed(metis, b), exact_ms = timed(exact, c),
               single_ms = timed(single, d);
  fmt::print(
      "| {} | {} | {:.2f} ({:.2f}M) | {:.2f} ({:.2f}M) | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1g} | {:.1g} |\n",
      body.name, 3 * at.solid.nodes(), amd_ms, 1e-6 * amd.numbers(), metis_ms, 1e-6 * metis.numbers(), exact_ms,
      single_ms, std::min(amd_ms, metis_ms) / exact_ms, std::min(amd_ms, metis_ms) / single_ms,
      (c - a).norm() / a.norm(), (d - a).norm() / a.norm());
  std::fflush(stdout);
}

void run(const std::string& folder) {
  const std::vector<PeerBody> bodies = peer_bodies();
  const double quadratic_mm = rest_tip_mm(bodies.front());
  fmt::print("## Steps\n\nThe beam by {} quadratic tets comes to rest at {:.2f} mm.\n\n",
             bodies.front().mesh.corners.size(), quadratic_mm);
  print_head();
  for (const PeerBody& body : bodies) step_body(body, quadratic_mm, folder);
  step_coarse_beam(quadratic_mm);
  fmt::print(
      "\n## The same matrix factored and solved once, ms\n\n| body | unknowns | CHOLMOD, AMD (numbers in L) | CHOLMOD, "
      "METIS "
      "| ours, double | ours, single | better CHOLMOD over double | over single | double's difference | single's |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const PeerBody& body : bodies) compare_factors(body);
  compare_factors(large_beam());
}

}  // namespace
}  // namespace myotact::peers

int main(int argc, char** argv) {
  try {
    myotact::peers::run(argc > 1 ? argv[1] : "");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
