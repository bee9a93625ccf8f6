#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace myotact::geometry {

struct GlbMaterial {
  std::string name;
  std::array<float, 4> colour{};  // red, green, blue as on a screen (sRGB), opacity; each 0 .. 1
  float roughness = 0.5f;         // 0 shines .. 1 is dull
};

/// Triangles of one material, indices into the vertices of their node.
struct GlbSurface {
  int material = 0;
  std::vector<std::array<int, 3>> triangles;
};

/// What is added to positions and normals, as much as the weight of the shape says.
struct GlbShape {
  std::vector<std::array<float, 3>> positions_m, normals;  // n each; world
};

/// How a node moves; one entry for each of the scene's times. A list that is empty moves nothing. Between two times
/// everything is interpolated.
struct GlbMotion {
  std::vector<std::array<float, 3>> translations_m;  // world
  std::vector<std::array<float, 4>> rotations;       // unit quaternions x y z w, world
  std::vector<std::vector<float>> weights;           // of the node's shapes
};

/// A thing of its own in the programs that open the file.
struct GlbNode {
  std::string name;
  std::vector<std::pair<std::string, std::string>> extras;  // what else is known of it
  std::vector<std::array<float, 3>> positions_m, normals;   // n each; world: x cranial, y left, z up
  std::vector<GlbSurface> surfaces;
  std::vector<GlbShape> shapes = {};
  GlbMotion motion = {};
};

struct GlbGroup {
  std::string name;
  std::vector<GlbNode> nodes;
};

struct GlbScene {
  std::string name, copyright;
  std::vector<std::pair<std::string, std::string>> extras;  // as of a node
  std::vector<GlbMaterial> materials;
  std::vector<GlbGroup> groups;
  std::vector<float> times_s = {};  // rising, from 0 on; of what moves
};

/// The scene as a glTF 2.0 file in one piece (Khronos 2021, 4.4: GLB), in metres. glTF
/// has y up, z forward and x to the left of what looks forward: so up is y there, cranial z and left x. Nodes without
/// triangles are left out. What moves is one animation. The same bytes each time. Throws Error BadData when it would be
/// larger than 4 GB.
std::string glb_bytes(const GlbScene& scene);

}  // namespace myotact::geometry
