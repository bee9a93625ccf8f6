#include "scene/tool_frame.h"

#include <memory>
#include <set>

#include <gtest/gtest.h>

#include "scene/scene_file.h"

namespace myotact::scene {
namespace {

/// Surfaces of the local model that have a corner at the place.
std::set<int> surfaces_at(const Vec3& place_m, const simulation::Simulation& simulation) {
  messages::ToolState tool;
  tool.proxy_position_world_m = tool.tool_position_world_m = to_array(place_m);
  auto model = std::make_unique<messages::LocalModel>();
  simulation.write_local_model(tool, *model);
  std::set<int> surfaces;
  for (int t = 0; t < model->triangle_count; ++t) {
    const auto& triangle = model->triangles[static_cast<std::size_t>(t)];
    for (const int vertex : triangle.vertices) {
      const Vec3 corner_m = to_vec3(model->current_world_m[static_cast<std::size_t>(vertex)]);
      if ((corner_m - place_m).norm() < 1e-9) surfaces.insert(triangle.surface);
    }
  }
  return surfaces;
}

messages::ToolFrame frame_of(int surface, const Scene& scene, const simulation::Simulation& simulation) {
  messages::FeltTool felt;
  felt.tool.contact.surface = surface;
  return tool_frame(felt, scene, 0, simulation);
}

TEST(ToolFrame, NamesTheMuscleOrTheBodyThatIsTouched) {
  const Scene scene = load_scene("elbow", {{"tissue.default", "rigid"}});
  simulation::Simulation simulation(scene.specimen, scene.settings);
  const std::vector<double> straight(scene.joints.size(), 0.0);
  simulation.settle(straight, scene.activations);
  for (const anatomy::Bone& bone : scene.specimen.bones) {
    const auto surfaces = surfaces_at(bone.surface.positions_m.front(), simulation);
    ASSERT_EQ(surfaces.size(), 1u) << bone.key;
    const messages::ToolFrame frame = frame_of(*surfaces.begin(), scene, simulation);
    EXPECT_EQ(frame.touched_body, bone.body) << bone.key;
    EXPECT_EQ(frame.touched_muscle, -1) << bone.key;
  }
  for (int m = 0; m < simulation.muscle_count(); ++m) {
    const auto surfaces = surfaces_at(simulation.skin_world_m(m).front(), simulation);
    ASSERT_TRUE(surfaces.contains(m));
    EXPECT_EQ(frame_of(m, scene, simulation).touched_muscle, m);
    EXPECT_EQ(frame_of(m, scene, simulation).touched_body, -1);
  }
  EXPECT_EQ(frame_of(-1, scene, simulation).touched_muscle, -1);
  EXPECT_EQ(frame_of(-1, scene, simulation).touched_body, -1);
  EXPECT_FALSE(frame_of(-1, scene, simulation).in_contact);
}

}  // namespace
}  // namespace myotact::scene
