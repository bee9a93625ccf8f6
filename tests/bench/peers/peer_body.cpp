#include "peer_body.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <limits>

#include "geometry/box_mesh.h"
#include "geometry/mesh_files.h"

namespace myotact::peers {
namespace {

const Vec3 kBeam_m(0.10, 0.01, 0.01);

PeerBody beam(const std::string& name, const std::array<int, 3>& cells, int steps) {
  PeerBody body;
  body.name = name;
  body.mesh = geometry::make_box_mesh(kBeam_m, cells);
  body.steps = steps;
  for (int n = 0; n < static_cast<int>(body.mesh.nodes_m.size()); ++n) {
    const double x_m = body.mesh.nodes_m[static_cast<std::size_t>(n)].x();
    if (x_m < 1e-9) body.held.push_back(n);
    if (x_m > kBeam_m.x() - 1e-9) body.tip.push_back(n);
  }
  return body;
}

/// Hung by the highest 8 % of z.
PeerBody muscle(const std::filesystem::path& folder, const std::string& name, int steps) {
  PeerBody body;
  body.name = name;
  body.mesh = geometry::read_tet_mesh(folder / (name + ".node")).mesh;
  body.young_Pa = 30e3;
  body.settles = false;
  body.steps = steps;
  for (std::size_t t = 0; t < body.mesh.corners.size(); ++t) {
    if (geometry::corner_volume_m3(body.mesh, t) < 0.0) std::swap(body.mesh.corners[t][0], body.mesh.corners[t][1]);
  }
  double low_m = std::numeric_limits<double>::max(), high_m = -low_m;
  for (const Vec3& x : body.mesh.nodes_m) {
    low_m = std::min(low_m, x.z());
    high_m = std::max(high_m, x.z());
  }
  for (int n = 0; n < static_cast<int>(body.mesh.nodes_m.size()); ++n) {
    const double share = (body.mesh.nodes_m[static_cast<std::size_t>(n)].z() - low_m) / (high_m - low_m);
    if (share >= 0.92) body.held.push_back(n);
    if (share <= 0.02) body.tip.push_back(n);
  }
  return body;
}

simulation::SolidInput input_of(const PeerBody& body, const simulation::Law& law, simulation::ElementKind kind) {
  simulation::SolidInput input;
  input.mesh = body.mesh;
  input.kind = kind;
  input.materials = {{{law}, body.density_kg_m3, -1.0}};
  return input;
}

}  // namespace

std::vector<PeerBody> peer_bodies() {
  std::vector<PeerBody> bodies = {beam("beam_2k", {42, 4, 2}, 300), beam("beam_5k", {52, 4, 4}, 200)};
  if (const char* canine = std::getenv("MYOTACT_CANINE_DIR"); canine != nullptr) {
    const std::filesystem::path folder = std::filesystem::path(canine) / "bench";
    bodies.push_back(muscle(folder, "bic_2k", 50));
    bodies.push_back(muscle(folder, "bic_5k", 50));
    bodies.push_back(muscle(folder, "bic_20k", 10));
  }
  return bodies;
}

PeerBody coarse_beam() {
  return beam("beam_2k", {20, 2, 2}, 300);
}

PeerBody large_beam() {
  return beam("beam_20k", {52, 8, 8}, 0);
}

PeerSolid::PeerSolid(const PeerBody& body, const simulation::Law& law, simulation::ElementKind kind)
    : solid(input_of(body, law, kind), body.name) {
  loads.gravity_m_s2 = Vec3(0.0, -kGravity_m_s2, 0.0);
  if (kind == simulation::ElementKind::Quadratic) {  // mid-side nodes of the held end, too
    for (int n = 0; n < solid.nodes(); ++n) {
      for (int i = 0; solid.rest_m()[3 * n] < 1e-9 && i < 3; ++i) loads.held.push_back({n, i, 0.0});
    }
    return;
  }
  for (const int n : body.held) {
    for (int i = 0; i < 3; ++i) loads.held.push_back({n, i, 0.0});
  }
}

void run_steps(const PeerBody& body, PeerRow& row, const std::function<bool()>& step,
               const std::function<std::vector<double>()>& positions) {
  for (int k = 0; k < body.steps; ++k) {
    const double begin_ms = thread_ms();
    const bool good = step();
    row.step_ms.push_back(thread_ms() - begin_ms);
    if (!good) {
      row.failure = "step " + std::to_string(k + 1) + " failed";
      return;
    }
  }
  row.positions_m = positions();
}

double tip_mm(const PeerBody& body, std::span<const double> positions_m) {
  double sum_m = 0.0;
  for (const int n : body.tip) {
    sum_m += positions_m[static_cast<std::size_t>(3 * n + 1)] - body.mesh.nodes_m[static_cast<std::size_t>(n)].y();
  }
  return 1e3 * sum_m / static_cast<double>(body.tip.size());
}

double largest_error(const PeerBody& body, std::span<const double> positions_m, std::span<const double> right_m) {
  double gap_m = 0.0, way_m = 0.0;
  for (std::size_t n = 0; n < body.mesh.nodes_m.size(); ++n) {
    const Eigen::Map<const Vec3> is(positions_m.data() + 3 * n), should(right_m.data() + 3 * n);
    const double here_m = (is - should).norm();
    if (!(here_m <= gap_m)) gap_m = here_m;  // not a number stays
    way_m = std::max(way_m, (should - body.mesh.nodes_m[n]).norm());
  }
  return gap_m / way_m;
}

double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace myotact::peers
