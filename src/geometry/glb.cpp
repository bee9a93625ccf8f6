#include "geometry/glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/error.h"

namespace myotact::geometry {

namespace {

using Json = nlohmann::json;
using Vertex = std::array<float, 3>;

static_assert(std::endian::native == std::endian::little, "numbers of a GLB are little-endian");

// Numbers that the specification gives to names.
constexpr int kFloat = 5126, kUnsigned = 5125, kVertices = 34962, kIndices = 34963;
constexpr std::uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

// The buffer holds all positions, then all normals, all indices, and what moves them.
constexpr int kPositionView = 0, kNormalView = 1, kIndexView = 2, kMotionView = 3;

template <typename T>
void append(std::string& bytes, const T& value) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// From z up to y up, by a rotation: triangles keep their outsides.
Vertex y_up(const Vertex& world) {
  return {world[1], world[2], world[0]};
}

/// The same rotation of an axis.
std::array<float, 4> y_up(const std::array<float, 4>& world) {
  return {world[1], world[2], world[0], world[3]};
}

/// glTF's colours are light, not what a screen is sent (IEC 61966-2-1).
float linear(float screen) {
  return screen <= 0.04045f ? screen / 12.92f : std::pow((screen + 0.055f) / 1.055f, 2.4f);
}

Json object_of(const std::vector<std::pair<std::string, std::string>>& extras) {
  Json object = Json::object();
  for (const auto& [key, text] : extras) object[key] = text;
  return object;
}

Json material_of(const GlbMaterial& material) {
  const auto& [red, green, blue, opacity] = material.colour;
  Json json{{"name", material.name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {linear(red), linear(green), linear(blue), opacity}},
              {"metallicFactor", 0.0},
              {"roughnessFactor", material.roughness}}}};
  if (opacity < 1.0f) json["alphaMode"] = "BLEND";
  return json;
}

/// What grows while nodes are added.
struct Writer {
  std::string positions, normals, indices, motion;
  Json nodes = Json::array(), meshes = Json::array(), accessors = Json::array();
  Json channels = Json::array(), samplers = Json::array();
  std::size_t times = 0;  // how many
  int time_accessor = -1;

  int add_accessor(int view, std::size_t offset, std::size_t count) {
    accessors.push_back({{"bufferView", view},
                         {"byteOffset", offset},
                         {"componentType", view == kIndexView ? kUnsigned : kFloat},
                         {"count", count},
                         {"type", view == kIndexView ? "SCALAR" : "VEC3"}});
    return static_cast<int>(accessors.size()) - 1;
  }

  int add_vertices(int view, const std::vector<Vertex>& world, std::string& bytes) {
    const int accessor = add_accessor(view, bytes.size(), world.size());
    for (const Vertex& vertex : world) append(bytes, y_up(vertex));
    return accessor;
  }

  /// Readers ask for it of positions.
  void add_bounds(int accessor, const std::vector<Vertex>& world) {
    Vertex lowest, highest;
    lowest.fill(std::numeric_limits<float>::max());
    highest.fill(std::numeric_limits<float>::lowest());
    for (const Vertex& vertex : world) {
      const Vertex p = y_up(vertex);
      for (std::size_t k = 0; k < p.size(); ++k) {
        lowest[k] = std::min(lowest[k], p[k]);
        highest[k] = std::max(highest[k], p[k]);
      }
    }
    accessors[static_cast<std::size_t>(accessor)].update(Json{{"min", lowest}, {"max", highest}});
  }

  int add_indices(const GlbSurface& surface) {
    const int accessor = add_accessor(kIndexView, indices.size(), 3 * surface.triangles.size());
    for (const auto& triangle : surface.triangles) {
      for (const int vertex : triangle) append(indices, static_cast<std::uint32_t>(vertex));
    }
    return accessor;
  }

  void add_times(const std::vector<float>& times_s) {
    if (times_s.empty()) return;
    times = times_s.size();
    accessors.push_back({{"bufferView", kMotionView},
                         {"byteOffset", motion.size()},
                         {"componentType", kFloat},
                         {"count", times},
                         {"type", "SCALAR"},
                         {"min", {times_s.front()}},
                         {"max", {times_s.back()}}});
    time_accessor = static_cast<int>(accessors.size()) - 1;
    for (const float time_s : times_s) append(motion, time_s);
  }

  /// Moves what `path` names of the node that was added last; `values` have `count` entries of `type`.
  void add_channel(const char* path, const char* type, std::size_t count, const std::string& values) {
    if (values.empty()) return;
    accessors.push_back({{"bufferView", kMotionView},
                         {"byteOffset", motion.size()},
                         {"componentType", kFloat},
                         {"count", count},
                         {"type", type}});
    motion += values;
    samplers.push_back({{"input", time_accessor}, {"output", accessors.size() - 1}, {"interpolation", "LINEAR"}});
    channels.push_back({{"sampler", samplers.size() - 1}, {"target", {{"node", nodes.size() - 1}, {"path", path}}}});
  }

  void add_motion(const GlbMotion& moves) {
    std::string values;
    for (const Vertex& v : moves.translations_m) append(values, y_up(v));
    add_channel("translation", "VEC3", moves.translations_m.size(), std::exchange(values, {}));
    for (const auto& q : moves.rotations) append(values, y_up(q));
    add_channel("rotation", "VEC4", moves.rotations.size(), std::exchange(values, {}));
    for (const auto& weights : moves.weights) {
      for (const float weight : weights) append(values, weight);
    }
    add_channel("weights", "SCALAR", values.size() / sizeof(float), values);
  }

  /// The shapes of a node as its meshes name them.
  Json targets_of(const GlbNode& node) {
    Json targets = Json::array();
    for (const GlbShape& shape : node.shapes) {
      const int position = add_vertices(kPositionView, shape.positions_m, positions);
      add_bounds(position, shape.positions_m);
      targets.push_back({{"POSITION", position}, {"NORMAL", add_vertices(kNormalView, shape.normals, normals)}});
    }
    return targets;
  }

  /// Its place among the nodes.
  int add(const GlbNode& node) {
    const int position = add_vertices(kPositionView, node.positions_m, positions);
    add_bounds(position, node.positions_m);
    const int normal = add_vertices(kNormalView, node.normals, normals);
    const Json targets = targets_of(node);
    Json primitives = Json::array();
    for (const GlbSurface& surface : node.surfaces) {
      if (surface.triangles.empty()) continue;
      primitives.push_back({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                            {"indices", add_indices(surface)},
                            {"material", surface.material}});
      if (!targets.empty()) primitives.back()["targets"] = targets;
    }
    meshes.push_back({{"name", node.name}, {"primitives", primitives}});
    if (!targets.empty()) meshes.back()["weights"] = std::vector<float>(targets.size(), 0.0f);
    nodes.push_back({{"name", node.name}, {"mesh", meshes.size() - 1}, {"extras", object_of(node.extras)}});
    add_motion(node.motion);
    return static_cast<int>(nodes.size()) - 1;
  }

  int add(const GlbGroup& group) {
    Json children = Json::array();
    for (const GlbNode& node : group.nodes) {
      const auto empty = [](const GlbSurface& surface) { return surface.triangles.empty(); };
      if (!std::all_of(node.surfaces.begin(), node.surfaces.end(), empty)) children.push_back(add(node));
    }
    nodes.push_back({{"name", group.name}});
    if (!children.empty()) nodes.back()["children"] = children;
    return static_cast<int>(nodes.size()) - 1;
  }

  Json views() const {
    const std::size_t at_normals = positions.size(), at_indices = at_normals + normals.size();
    const auto view = [](std::size_t offset, std::size_t length, int target) {
      return Json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}, {"target", target}};
    };
    Json views{view(0, positions.size(), kVertices), view(at_normals, normals.size(), kVertices),
               view(at_indices, indices.size(), kIndices)};
    for (const int i : {kPositionView, kNormalView}) views[static_cast<std::size_t>(i)]["byteStride"] = sizeof(Vertex);
    if (!motion.empty()) {
      views.push_back({{"buffer", 0}, {"byteOffset", at_indices + indices.size()}, {"byteLength", motion.size()}});
    }
    return views;
  }
};

/// Header and two chunks, each a multiple of four bytes long.
std::string joined(std::string json, const std::string& binary) {
  json.append((4 - json.size() % 4) % 4, ' ');
  const std::size_t length = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
  if (length > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitStatus::BadData, "a .glb holds at most 4 GB; show fewer parts, or take a coarser specimen");
  }
  std::string bytes;
  bytes.reserve(length);
  for (const std::uint32_t word : {kMagic, 2u, static_cast<std::uint32_t>(length)}) append(bytes, word);
  append(bytes, static_cast<std::uint32_t>(json.size()));
  append(bytes, kJsonChunk);
  bytes += json;
  if (binary.empty()) return bytes;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  append(bytes, kBinaryChunk);
  bytes += binary;
  return bytes;
}

}  // namespace

std::string glb_bytes(const GlbScene& scene) {
  Writer writer;
  writer.add_times(scene.times_s);
  Json groups = Json::array();
  for (const GlbGroup& group : scene.groups) groups.push_back(writer.add(group));
  writer.nodes.push_back({{"name", scene.name}, {"extras", object_of(scene.extras)}});
  if (!groups.empty()) writer.nodes.back()["children"] = groups;
  Json json{{"asset", {{"version", "2.0"}, {"generator", "Myotact"}, {"copyright", scene.copyright}}},
            {"scene", 0},
            {"scenes", {{{"name", scene.name}, {"nodes", {writer.nodes.size() - 1}}}}},
            {"nodes", writer.nodes}};
  const std::string binary = writer.positions + writer.normals + writer.indices + writer.motion;
  // The specification allows no empty list.
  if (!binary.empty()) {
    json["materials"] = Json::array();
    for (const GlbMaterial& material : scene.materials) json["materials"].push_back(material_of(material));
    json["meshes"] = writer.meshes;
    json["accessors"] = writer.accessors;
    json["bufferViews"] = writer.views();
    json["buffers"] = {{{"byteLength", binary.size()}}};
  }
  if (!writer.channels.empty()) {
    json["animations"] = {{{"name", scene.name}, {"channels", writer.channels}, {"samplers", writer.samplers}}};
  }
  // Names come from files; a letter that is none is replaced.
  return joined(json.dump(-1, ' ', false, Json::error_handler_t::replace), binary);
}

}  // namespace myotact::geometry
