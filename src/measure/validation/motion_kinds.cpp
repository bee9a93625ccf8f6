#include "measure/validation/motion_kinds.h"

#include <cmath>

#include <Eigen/Geometry>

#include "measure/validation/solid_inputs.h"
#include "measure/validation/step_count.h"
#include "simulation/solid/solid_motion.h"

namespace myotact::measure {
namespace {

using simulation::Solid;
using simulation::SolidMotion;

/// Newton steps of a time step: from the last positions the residual reaches its last digits after five.
constexpr int kNewtonSteps = 8;

Solid moving_solid(JsonObject& inputs) {
  const Box box = read_box(inputs);
  const ElementChoice element = read_element(inputs);
  simulation::SolidInput input = uniform_solid(make_box(box), element, read_laws(inputs));
  input.materials[0].density_kg_m3 = inputs.at("density_kg_m3").number_between(1.0, 1e5);
  return {input, "box"};
}

class FreeMotion {
 public:
  explicit FreeMotion(JsonObject& inputs)
      : solid_(moving_solid(inputs)),
        second_order_(inputs.at("rule").one_of({"backward_euler", "second_order"}) == "second_order") {
    if (inputs.at("held").boolean()) clamp(nodes_at(solid_, 0, 0.0), Vec3::Zero(), loads_);
    const double stretching = inputs.at("stretching_1_s").number_between(-1e4, 1e4);
    const double spin = inputs.at("spin_1_s").number_between(-1e4, 1e4);
    const Vec3 velocity = inputs.at("velocity_m_s").vec3();
    start_m_s_.resize(solid_.rest_m().size());
    for (int n = 0; n < solid_.nodes(); ++n) {
      const Vec3 X = solid_.rest_m().segment<3>(3 * n);
      start_m_s_.segment<3>(3 * n) = velocity + Vec3(stretching * X.x() - spin * X.y(), spin * X.x(), 0.0);
    }
  }

  SolidMotion start(double dt_s) const {
    SolidMotion motion(solid_, loads_, {dt_s, second_order_, kNewtonSteps});
    motion.set_state(solid_.rest_m(), start_m_s_);
    return motion;
  }
  const Solid& solid() const { return solid_; }

 private:
  Solid solid_;
  bool second_order_;
  simulation::SolidLoads loads_;
  Eigen::VectorXd start_m_s_;
};

struct Motion {
  Vec3 momentum_Ns = Vec3::Zero(), spin_Nms = Vec3::Zero();
  double energy_J = 0.0;
};

Motion motion_of(const Solid& solid, const SolidMotion& motion) {
  Motion now;
  Vec3 centre_m = Vec3::Zero();
  for (int n = 0; n < solid.nodes(); ++n) centre_m += solid.mass_kg()[n] * motion.position_m().segment<3>(3 * n);
  centre_m /= solid.mass_kg().sum();
  for (int n = 0; n < solid.nodes(); ++n) {
    const Vec3 momentum = solid.mass_kg()[n] * motion.velocity_m_s().segment<3>(3 * n);
    now.momentum_Ns += momentum;
    now.spin_Nms += (motion.position_m().segment<3>(3 * n) - centre_m).cross(momentum);
  }
  now.energy_J = motion.kinetic_energy_J() + solid.energy_J(motion.position_m(), 0.0);
  return now;
}

}  // namespace

Quantities solid_order(JsonObject& inputs) {
  const FreeMotion free(inputs);
  const double dt_s = inputs.at("dt_s").number_between(1e-6, 1.0);
  const int steps = step_count(inputs.at("end_s"), dt_s);
  const int halvings = inputs.at("halvings").integer_between(2, 8);
  std::vector<Eigen::VectorXd> ends;
  double residual = 0.0;
  for (int k = 0; k <= halvings; ++k) {
    const int parts = 1 << k;
    SolidMotion motion = free.start(dt_s / parts);
    for (int step = 0; step < steps * parts; ++step) {
      if (!motion.step()) return {{"order", std::nan("")}, {"error", std::nan("")}, {"residual", std::nan("")}};
      residual = std::max(residual, motion.residual_share());
    }
    ends.push_back(motion.position_m());
  }
  const std::size_t last = ends.size() - 1;
  const double before = (ends[last - 1] - ends[last - 2]).norm(), now = (ends[last] - ends[last - 1]).norm();
  return {{"order", std::log2(before / now)},
          {"error", now / (ends[last] - free.solid().rest_m()).norm()},
          {"residual", residual}};
}

Quantities solid_conservation(JsonObject& inputs) {
  const FreeMotion free(inputs);
  const double dt_s = inputs.at("dt_s").number_between(1e-6, 1.0);
  const int steps = step_count(inputs.at("end_s"), dt_s);
  SolidMotion motion = free.start(dt_s);
  const Motion start = motion_of(free.solid(), motion);
  Motion last = start;
  double drift = 0.0, most_J = 0.0;
  int failed = 0;
  for (int step = 0; step < steps; ++step) {
    failed += motion.step() ? 0 : 1;
    const Motion now = motion_of(free.solid(), motion);
    drift = std::max(drift, (now.momentum_Ns - last.momentum_Ns).norm());
    most_J = std::max(most_J, now.energy_J);
    last = now;
  }
  return {{"momentum_drift", drift / start.momentum_Ns.norm()},
          {"angular_momentum_kept", last.spin_Nms.norm() / start.spin_Nms.norm()},
          {"energy_gain", most_J / start.energy_J - 1.0},
          {"energy_kept", last.energy_J / start.energy_J},
          {"failed_steps", static_cast<double>(failed)}};
}

}  // namespace myotact::measure
