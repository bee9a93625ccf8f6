#include "layer/bullet_engine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "layer/bullet_contacts.h"
#include "layer/bullet_tissue.h"
#include "layer/bullet_world.h"
#include "layer/engine_surfaces.h"
#include "simulation/touch/local_grip.h"
#include "simulation/touch/tool_springs.h"

namespace myotact::layer {
namespace {

std::unique_ptr<btConvexShape> shape_of(const ToolBody& tool) {
  if (tool.shape == ToolBody::Shape::Sphere) return std::make_unique<btSphereShape>(tool.radius_m);
  return std::make_unique<btBoxShape>(btVector3(tool.radius_m, tool.radius_m, tool.radius_m));
}

/// Of every muscle: our own simulation does not move it.
std::vector<simulation::TissueModel> shapes_only(const anatomy::Specimen& specimen) {
  return std::vector<simulation::TissueModel>(specimen.muscles.size(), simulation::TissueModel::Rigid);
}

class BulletEngine final : public Engine {
 public:
  BulletEngine(const anatomy::Specimen& specimen, const BulletSettings& settings);

  std::string_view name() const override { return "bullet"; }
  double step_s() const override { return settings_.step_s; }
  int surface_count() const override { return surfaces_.count(); }
  void move_tool(int tool, const messages::ToolState& state) override;
  void advance() override;
  void report_contacts(int tool, messages::ReportedContacts& reported) const override;
  Pose body_pose(int surface) const override;
  void write_surface(int tool, messages::LocalModel& model) const override;

 private:
  void push_spring(const simulation::ToolSpring& spring, double h_s, Vec3& force_N);
  void push_joints(double h_s);
  void take_angles();
  void follow();

  const anatomy::Specimen specimen_;
  BulletSettings settings_;
  BulletWorld world_;
  BulletTissue tissue_;
  EngineSurfaces surfaces_;
  /// Angles and rates as Bullet has them, in the form from which our own simulation computes how a body in hand moves.
  simulation::Limb limb_;
  simulation::SkeletonLoads joints_alone_;              // without gravity and motion
  std::vector<std::unique_ptr<btConvexShape>> shapes_;  // one a tool
  std::vector<messages::ToolState> tools_;
  messages::LocalModel around_;  // scratch, kept for its size
};

BulletEngine::BulletEngine(const anatomy::Specimen& specimen, const BulletSettings& settings)
    : specimen_(specimen),
      settings_(settings),
      world_(specimen_, settings.gravity_m_s2),
      tissue_(specimen_, settings.gravity_m_s2),
      surfaces_(specimen_),
      limb_(specimen_, shapes_only(specimen_), simulation::Tendon::Elastic, simulation::Contact::None),
      tools_(settings.tools.size()) {
  for (const ToolBody& tool : settings.tools) shapes_.push_back(shape_of(tool));
  limb_.gravity_m_s2 = settings.gravity_m_s2;
  simulation::read_out(limb_);
}

/// The force at the end of the substep, as far as the point's velocity predicts where it is then. No stiffer than
/// brings the body, taken for itself, to the target in one substep: beyond twice that the motion would grow.
void BulletEngine::push_spring(const simulation::ToolSpring& spring, double h_s, Vec3& force_N) {
  const Vec3 p_W = world_.body_pose(spring.body) * spring.body_rest_m;
  const Vec3 pull_m = spring.target_W_m - p_W - h_s * world_.point_velocity_m_s(spring.body, p_W);
  if (!world_.moves(spring.body) || pull_m.norm() == 0.0) {
    force_N = spring.stiffness_N_m * pull_m;
    return;
  }
  const double mobility_1_kg = world_.mobility_1_kg(spring.body, p_W, pull_m.normalized());
  force_N = std::min(spring.stiffness_N_m, 1.0 / (h_s * h_s * mobility_1_kg)) * pull_m;
  world_.push(spring.body, p_W, force_N);
}

void BulletEngine::move_tool(int tool, const messages::ToolState& state) {
  messages::ToolState& taken = tools_[at(tool)];
  taken = state;
  taken.grabbed_line = -1;  // Bullet knows no muscle lines
  if (taken.contact.surface < 0 || taken.contact.triangle >= 0) return;
  surfaces_.patch().write(to_vec3(state.touched_world_m), around_);
  name_touched_triangle(around_, taken);
}

void BulletEngine::advance() {
  const double h_s = settings_.step_s / settings_.substeps;
  limb_.before = limb_.last;
  limb_.last = limb_.now;
  limb_.springs = simulation::tool_springs(tools_, {specimen_, tissue_.skins()}, limb_);
  limb_.spring_force_N.assign(limb_.springs.size(), Vec3::Zero());
  for (int substep = 0; substep < settings_.substeps; ++substep) {
    for (std::size_t s = 0; s < limb_.springs.size(); ++s) {
      if (limb_.springs[s].muscle < 0) push_spring(limb_.springs[s], h_s, limb_.spring_force_N[s]);
    }
    push_joints(h_s);
    world_.advance(h_s);
    take_angles();
  }
  if (!specimen_.muscles.empty()) tissue_.advance(settings_.step_s, limb_.springs, limb_.spring_force_N);
  follow();
}

/// Spring, damper and end of range of the joints as our own simulation has them, so that both engines hold one
/// mechanics and the grip is given these: the torque at rest, and a damper, implicit as if the rest of the limb
/// were stiff, that also takes the spring's motion within the substep.
void BulletEngine::push_joints(double h_s) {
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(limb_.skeleton.joint_count());
  const std::span<const double> zero(still.data(), static_cast<std::size_t>(still.size()));
  joints_alone_.compute(limb_.skeleton, {Vec3::Zero(), zero, zero});
  for (int j = 0; j < limb_.skeleton.joint_count(); ++j) {
    if (!limb_.skeleton.moves(j)) continue;
    const double damping_Nms_rad = joints_alone_.damping_Nms_rad[j] + h_s * joints_alone_.passive_Nm_rad[j];
    const double share = 1.0 + h_s * damping_Nms_rad / limb_.skeleton.inertia_kg_m2(j);
    world_.apply_torque(j, joints_alone_.force_Nm[j] - damping_Nms_rad / share * limb_.now.velocity_rad_s[j]);
  }
}

void BulletEngine::take_angles() {
  for (int j = 0; j < limb_.skeleton.joint_count(); ++j) {
    limb_.now.angle_rad[j] = world_.angle_rad(j);
    limb_.now.velocity_rad_s[j] = world_.velocity_rad_s(j);
  }
  limb_.skeleton.set_pose(limb_.angles());
}

void BulletEngine::follow() {
  simulation::read_out(limb_);
  const int muscles = surfaces_.muscle_count();
  for (int s = 0; s < muscles; ++s) surfaces_.follow(s, tissue_.skin_world_m(s));
  for (int s = muscles; s < surfaces_.count(); ++s) surfaces_.follow(s, body_pose(s));
}

void BulletEngine::report_contacts(int tool, messages::ReportedContacts& reported) const {
  reported = {};
  reported.tool_world_m = tools_[at(tool)].tool_position_world_m;
  const Vec3 middle_m = to_vec3(reported.tool_world_m);
  if (!middle_m.allFinite()) return;
  std::vector<messages::ReportedContact> contacts = tissue_.contacts(*shapes_[at(tool)], middle_m);
  for (messages::ReportedContact contact : world_.contacts(*shapes_[at(tool)], middle_m)) {
    contact.surface += surfaces_.muscle_count();  // bones are numbered after them
    contacts.push_back(contact);
  }
  sort_by_depth(contacts);
  const std::size_t count = std::min(contacts.size(), reported.contacts.size());
  std::copy_n(contacts.begin(), count, reported.contacts.begin());
  reported.count = static_cast<std::int32_t>(count);
}

Pose BulletEngine::body_pose(int surface) const {
  const int body = surfaces_.body_of(surface);
  return body < 0 ? Pose{} : world_.body_pose(body);
}

void BulletEngine::write_surface(int tool, messages::LocalModel& model) const {
  const messages::ToolState& state = tools_[at(tool)];
  surfaces_.patch().write(to_vec3(state.proxy_position_world_m), model);
  model.grip = simulation::local_grip(limb_, specimen_, surfaces_.patch(), {state, tool});
  if (model.grip.body < 0) return;
  const int joints = limb_.skeleton.joint_count();
  const Eigen::MatrixXd no_damping = Eigen::MatrixXd::Zero(joints, joints);  // no muscles
  write_grip_motion(limb_, {no_damping, tool, settings_.step_s}, model.grip);
}

}  // namespace

bool has_bullet() {
  return true;
}

std::unique_ptr<Engine> make_bullet_engine(const anatomy::Specimen& specimen, const BulletSettings& settings) {
  const bool usable = settings.step_s > 0.0 && settings.step_s <= 0.1 && settings.substeps >= 1;
  if (!usable) {
    throw bad_data("bullet", "",
                   fmt::format("a step of {} s in {} parts; must be in (0, 0.1] s, in 1 part or more", settings.step_s,
                               settings.substeps));
  }
  return std::make_unique<BulletEngine>(specimen, settings);
}

}  // namespace myotact::layer
