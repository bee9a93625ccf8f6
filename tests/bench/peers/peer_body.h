#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "simulation/solid/solid.h"
#include "simulation/solid/static_solve.h"

namespace myotact::peers {

/// One body as every program gets it: a mesh of linear tets, hung at its held nodes, under gravity along -y. SI units.
struct PeerBody {
  std::string name;
  geometry::TetMesh mesh;
  double young_Pa = 300e3;
  double poisson = 0.45;
  double density_kg_m3 = 1060.0;
  std::vector<int> held;  // nodes
  std::vector<int> tip;   // nodes whose mean displacement is told
  bool settles = true;    // a beam, which comes to rest; else a muscle, which swings as a pendulum
  int steps = 0;          // of 10 ms, that every program takes

  double shear_Pa() const { return 0.5 * young_Pa / (1.0 + poisson); }
  double lambda_Pa() const { return young_Pa * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
};

inline constexpr double kStep_s = 0.01;
inline constexpr double kGravity_m_s2 = 9.81;

/// Two beams and, where MYOTACT_CANINE_DIR is set, muscles of its folder `bench`.
std::vector<PeerBody> peer_bodies();
/// The beam of 2016 tets as a coarser one, for quadratic tets.
PeerBody coarse_beam();
/// Of 19,968 tets, for one factorisation.
PeerBody large_beam();

/// As a solid of ours under its own weight.
struct PeerSolid {
  PeerSolid(const PeerBody& body, const simulation::Law& law, simulation::ElementKind kind);
  simulation::Solid solid;
  simulation::SolidLoads loads;
};

/// What a program did with a body: a row of the table.
struct PeerRow {
  std::string program;
  std::string law;
  std::vector<double> step_ms = {};      // of each step
  std::vector<double> positions_m = {};  // after the last one, 3 numbers a node of the body's mesh
  std::vector<double> right_m = {};      // the same by the converged answer of the same mesh and law; empty: not known
  std::string failure = {};              // why it has no figures; empty: it has
};

/// Calls step() as often as the body says, timed; positions() is asked once, at the end.
void run_steps(const PeerBody& body, PeerRow& row, const std::function<bool()>& step,
               const std::function<std::vector<double>()>& positions);

/// Mean displacement of the tip's nodes along y.
double tip_mm(const PeerBody& body, std::span<const double> positions_m);
/// Largest distance between two states of the mesh over the largest displacement of the second.
double largest_error(const PeerBody& body, std::span<const double> positions_m, std::span<const double> right_m);

/// Processor time of this thread [ms]: on a busy machine, too, what the work itself takes.
double thread_ms();
double median(std::vector<double> values);

}  // namespace myotact::peers
