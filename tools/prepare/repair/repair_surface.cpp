#include "prepare/repair/repair_surface.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "prepare/repair/hausdorff.h"
#include "prepare/repair/repair_job.h"
#include "prepare/repair/soup.h"
#include "prepare/repair/stages.h"
#include "prepare/repair/surface_check.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

using geometry::TriangleMesh;

bool is_clean_body(const TriangleMesh& mesh) {
  if (find_defect(mesh)) return false;
  const std::vector<int> piece = piece_of_triangles(mesh);
  return *std::max_element(piece.begin(), piece.end()) == 0;
}

/// Cuts along other pieces leave triangles without area, on which exact and rounded coordinates disagree.
void drop_flat_remains(RepairJob& job) {
  if (!job.united) return;
  weld_equal_vertices(job);
  drop_flat_triangles(job);
  drop_copies(job);
  close_seams(job);
  split_shared_vertices(job);
}

void run_stages(RepairJob& job) {
  weld_equal_vertices(job);
  drop_flat_triangles(job);
  drop_copies(job);
  close_seams(job);
  drop_fins_and_walls(job);
  wind_alike(job);
  split_shared_vertices(job);
  drop_debris(job);
  close_holes(job);
  settle_pieces(job);
  remove_crossings(job);
  unite_pieces(job);
  drop_flat_remains(job);
  remove_crossings(job);
}

/// In metres; vertices that kept their places get the input's coordinates back bit for bit.
TriangleMesh in_metres(const RepairJob& job, const TriangleMesh& raw) {
  TriangleMesh result{{}, job.mesh.triangles};
  for (std::size_t v = 0; v < job.mesh.positions_m.size(); ++v) {
    const int source = job.vertex_source[v];
    result.positions_m.push_back(source >= 0 ? raw.positions_m[static_cast<std::size_t>(source)]
                                             : job.frame.to_m(job.mesh.positions_m[v]));
  }
  return result;
}

/// Nothing leaves that is not what the header promises.
void check_result(const RepairJob& job, const RepairResult& result) {
  if (const auto defect = find_defect(result.mesh)) {
    throw bad_data(job.name, "surface",
                   fmt::format("{}, near {}, even after {} kinds of repair. Repair it there and export it again",
                               defect->problem, place_text(defect->place_m), result.steps.size()));
  }
  const double limit_m = job.settings.tolerance * job.frame.diagonal_m;
  if (result.hausdorff_m > limit_m) {
    throw bad_data(job.name, "surface",
                   fmt::format("would move by {} m at {}; at most {} m. Repair it there and export it again",
                               to_text(result.hausdorff_m), place_text(result.hausdorff_place_m), to_text(limit_m)));
  }
}

}  // namespace

RepairResult repair_surface(const std::string& name, const TriangleMesh& raw, const RepairSettings& settings) {
  check_input(name, raw);
  if (is_clean_body(raw)) return {raw, {}, 0.0, Vec3::Zero()};
  RepairJob job = start_job(name, raw, settings);
  run_stages(job);
  RepairResult result;
  result.steps = job.steps;
  if (job.steps.empty()) {
    result.mesh = raw;
  } else {
    result.mesh = in_metres(job, raw);
    const SurfaceMove move = measure_move(job, raw);
    result.hausdorff_m = move.distance * job.frame.diagonal_m;
    result.hausdorff_place_m = job.frame.to_m(move.place);
  }
  check_result(job, result);
  return result;
}

std::string step_text(const RepairStep& step) {
  return fmt::format("{} {} at {}", step.count, step.what, place_text(step.place_m));
}

}  // namespace myotact::prepare
