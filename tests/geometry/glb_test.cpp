// What is written is taken apart again as the specification states it (Khronos 2021).

#include "geometry/glb.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myotact::geometry {
namespace {

using Json = nlohmann::json;

struct Glb {
  Json json;
  std::string binary;
};

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

Glb taken_apart(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(word_at(bytes, 4), 2u);
  EXPECT_EQ(word_at(bytes, 8), bytes.size());
  const std::uint32_t length = word_at(bytes, 12);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  EXPECT_EQ(length % 4, 0u);
  Glb glb{Json::parse(bytes.substr(20, length)), {}};
  if (20 + length == bytes.size()) return glb;
  EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
  glb.binary = bytes.substr(28 + length);
  EXPECT_EQ(word_at(bytes, 20 + length), glb.binary.size());
  EXPECT_EQ(glb.binary.size() % 4, 0u);
  return glb;
}

/// `part` of the buffer that an accessor names, with its element count times `size` bytes.
std::string bytes_of(const Glb& glb, int accessor, std::size_t size) {
  const Json& one = glb.json["accessors"][static_cast<std::size_t>(accessor)];
  const Json& view = glb.json["bufferViews"][one["bufferView"].get<std::size_t>()];
  const std::size_t offset = one["byteOffset"], length = one["count"].get<std::size_t>() * size;
  EXPECT_LE(offset + length, view["byteLength"].get<std::size_t>());
  return glb.binary.substr(view["byteOffset"].get<std::size_t>() + offset, length);
}

GlbScene one_triangle() {
  GlbScene scene;
  scene.name = "limb";
  scene.materials = {{"Bone", {1.0f, 0.5f, 0.0f, 1.0f}, 0.7f}, {"Glass", {0.0f, 0.0f, 0.0f, 0.25f}, 0.7f}};
  GlbNode node{
      "Humerus", {{"key", "humerus"}}, {{1, 2, 3}, {4, 2, 3}, {1, 5, 3}}, {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {}};
  node.surfaces = {{1, {{0, 1, 2}}}, {0, {}}};
  scene.groups = {{"Bones", {node, {"Nothing", {}, {}, {}, {{0, {}}}}}}};
  return scene;
}

TEST(Glb, PartsAreNamedNodesOfTheirGroupWithWhatElseIsKnown) {
  const Json json = taken_apart(glb_bytes(one_triangle())).json;
  const Json& nodes = json["nodes"];
  const Json& top = nodes[json["scenes"][0]["nodes"][0].get<std::size_t>()];
  EXPECT_EQ(top["name"], "limb");
  const Json& bones = nodes[top["children"][0].get<std::size_t>()];
  EXPECT_EQ(bones["name"], "Bones");
  ASSERT_EQ(bones["children"].size(), 1u) << "a part without triangles is none";
  const Json& humerus = nodes[bones["children"][0].get<std::size_t>()];
  EXPECT_EQ(humerus["name"], "Humerus");
  EXPECT_EQ(humerus["extras"]["key"], "humerus");
  EXPECT_EQ(json["meshes"][humerus["mesh"].get<std::size_t>()]["primitives"].size(), 1u);
}

TEST(Glb, UpIsYAndCranialIsForward) {
  const Glb glb = taken_apart(glb_bytes(one_triangle()));
  const Json& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto floats = [&](const char* what) {
    const std::string bytes = bytes_of(glb, primitive["attributes"][what], 3 * sizeof(float));
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  };
  EXPECT_EQ(floats("POSITION"), (std::vector<float>{2, 3, 1, 2, 3, 4, 5, 3, 1}));
  EXPECT_EQ(floats("NORMAL"), (std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0}));
  const Json& position = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
  EXPECT_EQ(position["min"], Json({2.0, 3.0, 1.0}));
  EXPECT_EQ(position["max"], Json({5.0, 3.0, 4.0}));
  const std::string indices = bytes_of(glb, primitive["indices"], sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(word_at(indices, 4 * i), i);
}

TEST(Glb, ColoursAreLightAndWhatIsFadedBlends) {
  const Json materials = taken_apart(glb_bytes(one_triangle())).json["materials"];
  const Json& bone = materials[0]["pbrMetallicRoughness"]["baseColorFactor"];
  EXPECT_NEAR(bone[0].get<double>(), 1.0, 1e-6);
  EXPECT_NEAR(bone[1].get<double>(), 0.21404, 1e-4);  // IEC 61966-2-1 of one half
  EXPECT_FALSE(materials[0].contains("alphaMode"));
  EXPECT_EQ(materials[1]["alphaMode"], "BLEND");
}

TEST(Glb, OfNothingHasNoEmptyLists) {
  GlbScene scene;
  scene.name = "\xff";  // no letter in UTF-8
  scene.groups = {{"Bones", {}}};
  const Glb glb = taken_apart(glb_bytes(scene));
  for (const char* list : {"meshes", "accessors", "bufferViews", "buffers", "materials"}) {
    EXPECT_FALSE(glb.json.contains(list)) << list;
  }
  EXPECT_TRUE(glb.binary.empty());
}

/// The numbers of an accessor.
std::vector<float> floats_of(const Glb& glb, int accessor, std::size_t components) {
  const std::string bytes = bytes_of(glb, accessor, components * sizeof(float));
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

TEST(Glb, MotionIsOneAnimationOfItsNodes) {
  GlbScene scene = one_triangle();
  scene.times_s = {0.0f, 0.5f};
  GlbNode& node = scene.groups[0].nodes[0];
  node.shapes = {{{{1, 0, 0}, {0, 0, 0}, {0, 0, 2}}, {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}}};
  node.motion = {{{1, 2, 3}, {4, 5, 6}}, {{0, 0, 0, 1}, {1, 0, 0, 0}}, {{0.25f}, {0.75f}}};
  const Glb glb = taken_apart(glb_bytes(scene));
  ASSERT_EQ(glb.json["animations"].size(), 1u);
  const Json& animation = glb.json["animations"][0];
  ASSERT_EQ(animation["channels"].size(), 3u);
  std::map<std::string, std::vector<float>> moved;
  for (const Json& channel : animation["channels"]) {
    EXPECT_EQ(glb.json["nodes"][channel["target"]["node"].get<std::size_t>()]["name"], "Humerus");
    const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    EXPECT_EQ(floats_of(glb, sampler["input"], 1), scene.times_s);
    const std::string path = channel["target"]["path"];
    moved[path] = floats_of(glb, sampler["output"], path == "translation" ? 3 : path == "rotation" ? 4 : 1);
  }
  EXPECT_EQ(moved["translation"], (std::vector<float>{2, 3, 1, 5, 6, 4}));  // y up
  EXPECT_EQ(moved["rotation"], (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0}));
  EXPECT_EQ(moved["weights"], (std::vector<float>{0.25f, 0.75f}));
  const Json& mesh = glb.json["meshes"][0];
  EXPECT_EQ(mesh["weights"].size(), 1u);
  const Json& target = mesh["primitives"][0]["targets"][0];
  EXPECT_EQ(floats_of(glb, target["POSITION"], 3), (std::vector<float>{0, 0, 1, 0, 0, 0, 0, 2, 0}));
  EXPECT_EQ(floats_of(glb, target["NORMAL"], 3), (std::vector<float>{0, 0, 0, 0, 0, 0, 1, 0, 0}));
  const Json& times = glb.json["accessors"][animation["samplers"][0]["input"].get<std::size_t>()];
  EXPECT_EQ(times["min"][0], 0.0f);
  EXPECT_EQ(times["max"][0], 0.5f);
}

TEST(Glb, WhatStandsStillHasNoAnimation) {
  const Glb glb = taken_apart(glb_bytes(one_triangle()));
  EXPECT_FALSE(glb.json.contains("animations"));
  EXPECT_EQ(glb.json["bufferViews"].size(), 3u);
}

}  // namespace
}  // namespace myotact::geometry
