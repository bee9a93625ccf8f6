#pragma once

#include <string>
#include <vector>

#include "prepare/repair/repair_surface.h"
#include "prepare/tets/tet_quality.h"

namespace myotact::prepare {

enum class MarkKind { Repair, Overlap, Tet, Origin, Insertion };

/// A place that the report's pictures point out.
struct ReportMark {
  MarkKind kind = MarkKind::Repair;
  Vec3 place_m = Vec3::Zero();
};

/// What came out for one surface, for people who decide whether to trust it.
struct SurfaceReport {
  std::string key;
  bool muscle = false;
  int input_triangles = 0;
  std::vector<RepairStep> repairs;  // empty: went in as it was
  double moved_m = 0.0;             // by the repairs, at most
  int skin_triangles = 0;
  double volume_m3 = 0.0;          // of the repaired and parted surface
  std::vector<std::string> notes;  // what a person should look at
  std::vector<ReportMark> marks;   // where
  // Muscles only.
  double parted_loss_m3 = 0.0;
  std::vector<std::pair<std::string, double>> gave_way;  // bones and muscles it overlapped, volumes [m3]
  double overlap_p95_m = 0.0, overlap_largest_m = 0.0;   // depth of its skin in its neighbours, after parting
  int cage_attempts = 0;
  double cage_volume_error = 0.0;
  double cage_deviation_m = 0.0, cage_edge_m = 0.0;
  TetQuality tets;
  double origin_area_m2 = 0.0, insertion_area_m2 = 0.0;
  double origin_gap_m = 0.0, insertion_gap_m = 0.0;  // nearest vertex to bone
  int filled_tets = 0;
  double fibre_angle_deg = 0.0;  // mean against the straight way from end to end
  double path_m = 0.0;           // along the fibres
  double belly_m = 0.0;
  double largest_section_m2 = 0.0;
  std::vector<std::pair<std::string, double>> moment_arms_m;  // hinge crossed -> moment arm, positive flexes
};

/// One line a surface, with a heading.
std::string report_table(const std::vector<SurfaceReport>& reports);

/// One JSON object a line and surface.
std::string report_json_lines(const std::vector<SurfaceReport>& reports);

}  // namespace myotact::prepare
