#include "live_scene.h"

#include <algorithm>
#include <limits>

#include "core/at.h"
#include "core/error.h"
#include "core/pose.h"

namespace myotact::python {

namespace {

std::size_t surface_count(const anatomy::Specimen& specimen) {
  return specimen.muscles.size() + specimen.bones.size();
}

/// Where a contact is now; nothing when the tool is on no triangle.
std::optional<TouchedPoint> point_of(const messages::ToolContact& contact, const anatomy::Specimen& specimen,
                                     const simulation::Simulation& simulation) {
  const bool known = contact.stiffness_N_m > 0.0 && contact.surface >= 0 && contact.triangle >= 0 &&
                     at(contact.surface) < surface_count(specimen);
  if (!known) return std::nullopt;
  TouchedPoint found;
  found.triangle = contact.triangle;
  found.normal = to_vec3(contact.normal_world);
  const bool is_muscle = at(contact.surface) < specimen.muscles.size();
  const std::size_t index = is_muscle ? at(contact.surface) : at(contact.surface) - specimen.muscles.size();
  const geometry::TriangleMesh& mesh = is_muscle ? specimen.muscles[index].skin : specimen.bones[index].surface;
  found.part = is_muscle ? specimen.muscles[index].key : specimen.bones[index].key;
  if (at(contact.triangle) >= mesh.triangles.size()) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t vertex = at(mesh.triangles[at(contact.triangle)][k]);
    const Vec3 position_m = is_muscle ? simulation.skin_world_m(contact.surface)[vertex]
                                      : simulation.body_pose(specimen.bones[index].body) * mesh.positions_m[vertex];
    found.point_m += contact.barycentric[k] * position_m;
  }
  return found;
}

}  // namespace

scene::Scene read_scene(const SceneChoice& choice) {
  scene::Scene scene =
      choice.folder.empty()
          ? scene::load_scene(choice.scene, choice.set)
          : scene::parse_scene(choice.scene, std::filesystem::path(choice.folder) / "scene", choice.set);
  if (!choice.script) scene.script.clear();
  if (!choice.co_contraction) scene.co_contraction.reset();
  scene.settings.workers = choice.workers;
  scene::set_seed(scene, choice.seed);
  return scene;
}

LiveScene::LiveScene(const SceneChoice& choice) : scene_(std::make_shared<const scene::Scene>(read_scene(choice))) {
  simulation_ = std::make_unique<simulation::Simulation>(scene_->specimen, scene_->settings);
  const int every = choice.samples > 0 ? choice.samples : std::numeric_limits<int>::max();
  samples_ = std::make_unique<scene::SampleTable>(scene_->specimen, scene::hands_of(*scene_), every);
  session_ = std::make_unique<scene::LockstepSession>(*scene_, *simulation_, *samples_, nullptr);
  co_contracts_ = scene_->co_contraction && (scene_->co_contraction->hold_posture || !scene_->script.empty());
}

std::vector<TouchedPoint> LiveScene::touched(int index) const {
  const messages::ToolState& state = tool(index);
  std::vector<TouchedPoint> found;
  const auto add = [&](const messages::ToolContact& contact) {
    if (auto point = point_of(contact, scene_->specimen, *simulation_)) found.push_back(std::move(*point));
  };
  add(state.contact);
  for (const messages::ToolContact& contact : state.beside) add(contact);
  return found;
}

void LiveScene::read(int muscle, MuscleArray what, std::vector<double>& numbers) const {
  if (what == MuscleArray::Skin) {
    const std::span<const Vec3> skin_m = simulation_->skin_world_m(muscle);
    numbers.resize(3 * skin_m.size());
    for (std::size_t v = 0; v < skin_m.size(); ++v) std::copy_n(skin_m[v].data(), 3, &numbers[3 * v]);
    return;
  }
  const std::span<const double> nodes =
      what == MuscleArray::Nodes ? simulation_->nodes_world_m(muscle) : simulation_->node_velocities_world_m_s(muscle);
  numbers.assign(nodes.begin(), nodes.end());
}

void LiveScene::refresh() {
  for (auto& [key, numbers] : arrays_) read(key.first, key.second, *numbers);
}

Numbers LiveScene::array(int muscle, MuscleArray what) {
  auto& numbers = arrays_[{muscle, what}];
  if (!numbers) {
    numbers = std::make_shared<std::vector<double>>();
    read(muscle, what, *numbers);
  }
  return numbers;
}

void LiveScene::command(const messages::Order& order, double over_s) {
  conductor().apply({order, messages::Commander::Window, over_s});
  if (std::holds_alternative<messages::Reset>(order)) script_start_s_ = simulation_->time_s();
  co_contracts_ |=
      std::holds_alternative<messages::CoContract>(order) || std::holds_alternative<messages::SetLevels>(order);
}

void LiveScene::begin(int tool, double duration_s, const scene::Action& action) {
  conductor().begin({simulation_->time_s() - script_start_s_, duration_s, action, static_cast<std::size_t>(tool)});
}

bool LiveScene::is_driven(int muscle) const {
  if (!scene_->co_contraction || !co_contracts_) return false;
  const scene::CoContraction& set = *scene_->co_contraction;
  const auto has = [&](const std::vector<int>& side) {
    return std::find(side.begin(), side.end(), muscle) != side.end();
  };
  return has(set.flexors) || has(set.extensors);
}

void LiveSceneDeleter::operator()(LiveScene* scene) const {
  if (scene == nullptr || !scene->turns().in_own_process()) return;
  delete scene;
}

}  // namespace myotact::python
