#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "prepare/repair/repair_surface.h"

namespace myotact::prepare {

/// Where the working coordinates lie: place_m = centre_m + diagonal_m * p.
struct WorkFrame {
  Vec3 centre_m = Vec3::Zero();
  double diagonal_m = 1.0;
  Vec3 to_m(const Vec3& p) const { return centre_m + diagonal_m * p; }
};

/// Sources of triangles that the input does not have.
inline constexpr int kFill = -1;   // over a hole of the input
inline constexpr int kPatch = -2;  // instead of others that were cut or crossed

/// Two points nearer than this are one [diagonals]: 0.1 nm on a muscle, and the last digits of coordinates that lie
/// 100 km from the origin.
inline constexpr double kSame = 1e-9;

/// A surface on its way through the stages, each of which takes it and changes it.
struct RepairJob {
  std::string name;
  RepairSettings settings;
  WorkFrame frame;
  geometry::TriangleMesh mesh;              // in working coordinates: lengths are diagonals of the input
  std::vector<int> vertex_source;           // n: input vertex whose place it has kept bit for bit, or -1
  std::vector<int> face_source;             // m: input triangle that it is or is a part of; kFill, kPatch
  std::vector<bool> left_out;               // input triangles dropped on purpose: not a movement of the surface
  std::vector<std::pair<int, int>> copies;  // input triangle -> the one kept instead
  bool united = false;                      // pieces that overlapped are one: what lay inside is no surface any more
  bool crossing_free = false;               // found so, and nothing was done since that could change it
  std::vector<RepairStep> steps;
};

/// The input in working coordinates.
RepairJob start_job(const std::string& name, const geometry::TriangleMesh& raw, const RepairSettings& settings);

/// Adds to the step of that name, or starts it with its place.
void note(RepairJob& job, std::string_view what, int count, const Vec3& place);

/// "(x, y, z) m".
std::string place_text(const Vec3& place_m);

/// The error that refuses the surface; `problem` holds value, limit and remedy, "{}" in it becomes the place.
Error refusal(const RepairJob& job, std::string_view problem, const Vec3& place);

/// Whether dropped triangles were no part of the body's surface.
enum class Dropped { StillCovered, LeftOut };

/// Drops the triangles for which `keep` returns false, and vertices that none uses any more.
void keep_triangles(RepairJob& job, const std::vector<bool>& keep, Dropped dropped);
void drop_unused_vertices(RepairJob& job);

/// Adds a triangle with its source.
void add_triangle(RepairJob& job, const std::array<int, 3>& triangle, int source);

/// Takes a surface made from this one: vertices at places that were there before and triangles between them keep their
/// sources; the others get `new_source`.
void adopt(RepairJob& job, const geometry::TriangleMesh& result, int new_source);

Vec3 centroid(const geometry::TriangleMesh& mesh, int triangle);

/// Twice the area, along the normal.
Vec3 area_vector(const geometry::TriangleMesh& mesh, int triangle);

/// The least height of a triangle: 0 for needles and caps without area.
double least_height(const geometry::TriangleMesh& mesh, int triangle);

}  // namespace myotact::prepare
