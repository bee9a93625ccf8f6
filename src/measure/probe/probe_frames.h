#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace myotact::measure {

/// A deforming surface as a folder of frames: `times.csv` (file, t_s) and the surfaces it names.
/// Only frames that are asked for are read, so that long films need no memory.
class ProbeFrames {
 public:
  /// Reads times.csv and finds every file that it names. Throws Error NoInput, BadData.
  explicit ProbeFrames(const std::filesystem::path& folder);

  std::size_t count() const { return files_.size(); }
  double t_s(std::size_t frame) const { return t_s_[frame]; }
  /// Vertices of a frame. Throws Error BadData where its triangles are not those of `mesh`, or as load_probe_surface.
  std::vector<Vec3> positions_m(std::size_t frame, const geometry::TriangleMesh& mesh) const;

 private:
  std::vector<std::filesystem::path> files_;
  std::vector<double> t_s_;  // rising
};

/// A surface in metres, of any kind that geometry reads, with at most kMostProbeTriangles. Throws Error NoInput,
/// BadData. `notes` gets what a person should know of it: open, non-manifold, without area, unusually large.
geometry::TriangleMesh load_probe_surface(const std::filesystem::path& file, std::vector<std::string>& notes);

/// A tree and two frames of so many triangles take 1.5 GB; scans have 1e6.
inline constexpr std::size_t kMostProbeTriangles = 4'000'000;

}  // namespace myotact::measure
