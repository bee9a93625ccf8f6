#pragma once

#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "anatomy/specimen.h"
#include "geometry/triangle_mesh.h"

namespace myotact::view {

struct SkySampling {
  int directions = 64;  // sides from which a picture of depths of the whole is drawn
  int cells = 288;      // along a picture's edge; what is smaller than a cell counts for nothing
  /// What lies farther from a vertex than this shades it no longer, what is nearer than half of it wholly: then shade
  /// is of what the parts touch and moves with them when joints rotate, instead of staying where a far part once was.
  float reach_m = std::numeric_limits<float>::infinity();
};

/// A surface with its unit normals, one a vertex.
struct ShadedSurface {
  const geometry::TriangleMesh* surface = nullptr;
  std::vector<glm::vec3> normals;
};

/// How much of the sky each vertex sees past all the surfaces, one list a surface: 0 walled in .. 1 free, weighted by
/// the cosine to its normal as diffuse light is.
struct SkyExposure {
  std::vector<std::vector<float>> seen;     // past what lies within reach
  std::vector<std::vector<float>> outside;  // past everything
};

/// The same bits with any number of processors.
SkyExposure sky_exposure(std::span<const ShadedSurface> surfaces, const SkySampling& sampling);

/// What light and layers need to know of a specimen, from its file pose.
struct LimbShade {
  struct Vertices {
    std::vector<float> alone;     // exposure when only this muscle, or only the bones, are there
    std::vector<float> together;  // among all parts
  };
  std::vector<Vertices> muscles, bones;
  std::vector<bool> superficial;  // muscles, as in the specimen
};

/// The specimen's skins, then its bones: with the normals that they have together (SeamNormals).
std::vector<ShadedSurface> shaded_surfaces(const anatomy::Specimen& specimen);

LimbShade shade_limb(const anatomy::Specimen& specimen);

}  // namespace myotact::view
