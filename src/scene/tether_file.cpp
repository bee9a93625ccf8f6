#include "scene/tether_file.h"

namespace myotact::scene {

namespace {

// Softer is not felt; stiffer than 1000 N/m no desktop device renders, and two such springs are what the particle hangs
// on.
constexpr double kSoftest_N_m = 1.0, kStiffest_N_m = 1000.0;

double read_stiffness(JsonObject& fields, const char* key, double otherwise_N_m) {
  const auto stiffness = fields.find(key);
  return stiffness ? stiffness->number_between(kSoftest_N_m, kStiffest_N_m) : otherwise_N_m;
}

simulation::TetherSettings read_spring(const JsonValue& value) {
  JsonObject fields(value);
  simulation::TetherSettings tether;
  tether.stiffness_N_m = read_stiffness(fields, "stiffness_N_m", simulation::kSpringTether_N_m);
  fields.finish();
  return tether;
}

simulation::TetherSettings read_particle(const JsonValue& value) {
  JsonObject fields(value);
  simulation::ParticleSettings particle;
  simulation::TetherSettings tether;
  tether.stiffness_N_m = read_stiffness(fields, "hand_stiffness_N_m", simulation::kParticleTether_N_m);
  particle.cube_stiffness_N_m = read_stiffness(fields, "cube_stiffness_N_m", particle.cube_stiffness_N_m);
  if (const auto mass = fields.find("mass_kg")) particle.mass_kg = mass->number_between(1e-3, 10.0);
  if (const auto unit = fields.find("unit_m")) particle.unit_m = unit->number_between(1e-3, 0.1);
  if (const auto cube = fields.find("cube")) particle.circling = cube->one_of({"fixed", "circling"}) == "circling";
  if (const auto integration = fields.find("integration")) {
    const bool is_explicit = integration->one_of({"implicit", "explicit"}) == "explicit";
    particle.integration = is_explicit ? simulation::Integration::Explicit : simulation::Integration::Implicit;
  }
  fields.finish();
  tether.particle = particle;
  return tether;
}

}  // namespace

simulation::TetherSettings read_tether(const JsonValue& value) {
  JsonObject scenes(value);
  const auto particle = scenes.find("particle"), spring = scenes.find("spring");
  scenes.finish();
  if (particle.has_value() == spring.has_value()) throw value.error("must hold either \"particle\" or \"spring\"");
  return particle ? read_particle(*particle) : read_spring(*spring);
}

}  // namespace myotact::scene
