#include "measure/validation/pendulum_kind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "simulation/simulation.h"

namespace myotact::measure {
namespace {

struct Rod {
  double length_m, mass_kg, gravity_m_s2;

  double inertia_kg_m2() const { return mass_kg * length_m * length_m / 3.0; }  // about its end
  double energy_J(double q_rad, double velocity_rad_s) const {
    const double rise_m = 0.5 * length_m * (1.0 - std::cos(q_rad));
    return 0.5 * inertia_kg_m2() * velocity_rad_s * velocity_rad_s + mass_kg * gravity_m_s2 * rise_m;
  }
  double small_period_s() const { return 2.0 * std::numbers::pi * std::sqrt(2.0 * length_m / (3.0 * gravity_m_s2)); }
};

anatomy::Body rod_body(const std::string& key, const Rod& rod) {
  anatomy::Body body;
  body.key = key;
  body.mass_kg = rod.mass_kg;
  body.com_m = {0.0, 0.0, -0.5 * rod.length_m};
  const double across = rod.mass_kg * rod.length_m * rod.length_m / 12.0;
  const double along = 1e-6 * across;  // rotates about the axis only; a specimen wants a positive inertia
  body.inertia_kg_m2 = {across, across, along, 0.0, 0.0, 0.0};
  return body;
}

/// Hangs from the origin and swings about y.
anatomy::Specimen pendulum_specimen(const Rod& rod) {
  anatomy::Specimen specimen;
  specimen.name = "pendulum";
  specimen.bodies = {rod_body("support", rod), rod_body("rod", rod)};
  anatomy::Joint joint;
  joint.key = "hinge";
  joint.parent = 0;
  joint.child = 1;
  joint.axes = {Vec3::UnitY()};
  joint.range_rad = {{-std::numbers::pi, std::numbers::pi}};
  specimen.joints = {joint};
  return specimen;
}

struct Swing {
  double period_s = std::numeric_limits<double>::quiet_NaN();
  double energy_gain = -1.0;  // largest energy after the start over that at the start, less 1
};

/// Runs until the rod has passed its lowest point three times; the period stays NaN if it does not.
Swing swing(const Rod& rod, double amplitude_rad, simulation::Simulation& simulation, double dt_s) {
  constexpr double kLongestRun = 20.0;  // small periods; 1.9 of them are enough for 120 degrees
  Swing result;
  const double start_J = rod.energy_J(amplitude_rad, 0.0);
  double last_rad = amplitude_rad;
  double first_passage_s = 0.0;
  int passages = 0;
  while (passages < 3 && simulation.time_s() < kLongestRun * rod.small_period_s()) {
    simulation.step({});
    const simulation::JointReadout now = simulation.joint(0);
    const double energy_J = rod.energy_J(now.angle_rad, now.velocity_rad_s);
    result.energy_gain = std::max(result.energy_gain, energy_J / start_J - 1.0);
    if ((now.angle_rad > 0.0) != (last_rad > 0.0)) {
      const double passage_s = simulation.time_s() - dt_s * now.angle_rad / (now.angle_rad - last_rad);
      ++passages;
      if (passages == 1) first_passage_s = passage_s;
      if (passages == 3) result.period_s = passage_s - first_passage_s;
    }
    last_rad = now.angle_rad;
  }
  return result;
}

}  // namespace

Quantities hinge_pendulum(JsonObject& inputs) {
  const Rod rod{inputs.at("length_m").number_between(0.01, 2.0), inputs.at("mass_kg").number_between(1e-3, 100.0),
                inputs.at("gravity_m_s2").number_between(0.1, 100.0)};
  const double amplitude_rad = inputs.at("amplitude_rad").number_between(1e-4, 3.0);
  simulation::SimulationSettings settings;
  settings.dt_s = inputs.at("dt_s").number_between(1e-4, 0.01);
  settings.gravity_m_s2 = {0.0, 0.0, -rod.gravity_m_s2};
  settings.workers = 1;
  simulation::Simulation simulation(pendulum_specimen(rod), settings);
  const std::array<double, 1> start_rad = {amplitude_rad};
  const bool settled = simulation.settle(start_rad, {});
  const Swing result = settled ? swing(rod, amplitude_rad, simulation, settings.dt_s) : Swing{};
  return {{"period_s", result.period_s},
          {"energy_gain", result.energy_gain},
          {"failed_steps", static_cast<double>(simulation.failed_steps())}};
}

}  // namespace myotact::measure
