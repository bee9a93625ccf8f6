#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/mesh_files.h"
#include "geometry/polygon.h"
#include "geometry/words.h"

namespace myotact::geometry {

/// Gathers the corners and faces that a reader finds in `words`, and refuses, with the place where it reads, what makes
/// no surface. Refers to `words`, which must outlive it.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Words& words) : words_(words) {}

  void add_position(const Vec3& position_m);
  /// Refuses a face of so many corners.
  void require_face(std::size_t corners) const;
  /// Corners that index the positions added so far.
  void add_face(std::span<const int> corners);
  void add_note(const std::string& note) { surface_.notes.push_back(note); }

  int position_count() const { return static_cast<int>(surface_.mesh.positions_m.size()); }
  /// Throws when there are no triangles.
  SurfaceFile take();

 private:
  const Words& words_;
  PolygonCutter cutter_;
  SurfaceFile surface_;
  int crossed_ = 0;  // faces that cross themselves
};

}  // namespace myotact::geometry
