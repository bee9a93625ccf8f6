#include "simulation/particle/tether.h"

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace myotact::simulation {

namespace {

constexpr double kCircle_units = 2.0;  // radius, as published
/// Ten times what a desktop device reaches.
constexpr double kFarthest_m = 1.0;

int require_body(const anatomy::Specimen& specimen, const char* key) {
  const int body = anatomy::find_body(specimen, key);
  if (body < 0) {
    throw bad_data(
        "specimen", specimen.name,
        std::string("has no body \"") + key + "\"; the scene with a particle needs the specimen \"particle\"");
  }
  return body;
}

}  // namespace

Vec3 cube_centre_m(const ParticleSettings& particle, double time_s) {
  if (!particle.circling) return Vec3::Zero();
  const double angle_rad = 1e3 * time_s / 180.0 * std::numbers::pi / 50.0;
  return kCircle_units * particle.unit_m * Vec3(std::cos(angle_rad), std::sin(angle_rad), 0.0);
}

Vec3 tether_start_m(const TetherSettings& settings) {
  return settings.particle ? cube_centre_m(*settings.particle, 0.0) : Vec3(Vec3::Zero());
}

Tether::Tether(const TetherSettings& settings, const anatomy::Specimen& specimen) : settings_(settings) {
  if (!specimen.muscles.empty() || !specimen.joints.empty()) {
    throw bad_data("specimen", specimen.name,
                   "has muscles or joints, of which nothing would be felt beside a tether; name \"particle\" or "
                   "\"spring\" as the specimen, or leave out the tether");
  }
  if (settings_.particle) {
    cube_body_ = require_body(specimen, "cube");
    particle_body_ = require_body(specimen, "particle");
    cube_rest_m_ = specimen.bodies[static_cast<std::size_t>(cube_body_)].com_m;
    particle_rest_m_ = specimen.bodies[static_cast<std::size_t>(particle_body_)].com_m;
  }
  restart();
}

void Tether::restart() {
  time_s_ = 0.0;
  lost_ = false;
  hands_m_.clear();
  state_ = {tether_start_m(settings_), Vec3::Zero()};
}

/// Of a scene with a particle.
Vec3 Tether::cube_m() const {
  return cube_centre_m(*settings_.particle, time_s_);
}

/// Equal springs to several places pull as one to their middle that is as stiff as all together.
ParticleSprings Tether::springs() const {
  ParticleSprings springs{settings_.particle->mass_kg, settings_.particle->cube_stiffness_N_m, 0.0, cube_m()};
  for (const Vec3& hand_m : hands_m_) {
    springs.second_N_m += settings_.stiffness_N_m;
    springs.second_end_m += hand_m / static_cast<double>(hands_m_.size());
  }
  return springs;
}

void Tether::step(std::span<const messages::ToolState> tools, double dt_s) {
  hands_m_.clear();
  for (const messages::ToolState& tool : tools) {
    const Vec3 hand_m = to_vec3(tool.tool_position_world_m);
    if (tool.sequence > 0 && hand_m.allFinite()) hands_m_.push_back(hand_m);
  }
  if (settings_.particle && !lost_) {
    state_ = step_particle(state_, springs(), settings_.particle->integration, dt_s);
    lost_ = !(state_.position_m.norm() < kFarthest_m);
  }
  time_s_ += dt_s;
}

messages::LocalTether Tether::local() const {
  if (lost_) return {};
  return {settings_.stiffness_N_m, to_array(state_.position_m), to_array(state_.velocity_m_s)};
}

Pose Tether::body_pose(int body) const {
  if (body == cube_body_) return {Mat3::Identity(), cube_m() - cube_rest_m_};
  if (body == particle_body_ && !lost_) return {Mat3::Identity(), state_.position_m - particle_rest_m_};
  return {};
}

std::vector<std::array<std::array<double, 3>, 2>> Tether::springs_world_m() const {
  std::vector<std::array<std::array<double, 3>, 2>> springs;
  if (lost_) return springs;
  if (settings_.particle) springs.push_back({to_array(cube_m()), to_array(state_.position_m)});
  for (const Vec3& hand_m : hands_m_) springs.push_back({to_array(state_.position_m), to_array(hand_m)});
  return springs;
}

std::array<double, 6> Tether::state() const {
  const Vec3 &x = state_.position_m, &v = state_.velocity_m_s;
  return {x.x(), x.y(), x.z(), v.x(), v.y(), v.z()};
}

}  // namespace myotact::simulation
