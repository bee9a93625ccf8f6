#pragma once

#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "geometry/triangle_mesh.h"

namespace myotact::view {

/// How much of the sky each vertex sees past all the surfaces, one list a surface: 0 walled in .. 1 free, weighted by
/// the cosine to its normal as diffuse light is. A picture of depths of the whole is drawn from `directions` sides,
/// with `cells` cells along its edge; what is smaller than a cell counts for nothing. Same bits each time.
std::vector<std::vector<float>> sky_exposure(std::span<const geometry::TriangleMesh* const> surfaces, int directions,
                                             int cells);

/// What light and layers need to know of a specimen, from its file pose.
struct LimbShade {
  struct Vertices {
    std::vector<float> alone;     // exposure when only this muscle, or only the bones, are there
    std::vector<float> together;  // among all parts
  };
  std::vector<Vertices> muscles, bones;
  std::vector<bool> superficial;  // muscles, as in the specimen
};

LimbShade shade_limb(const anatomy::Specimen& specimen);

}  // namespace myotact::view
