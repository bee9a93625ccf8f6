#include "haptics/effects/texture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

namespace myotact::haptics {

namespace {

/// Speeds are smoothed over this: with an encoder of 20 um a slide of 20 mm/s reads as one count a tick.
constexpr double kSmoothing_s = 5e-3;
/// Slower than this the way of the slide is not known and the vibration keeps its direction.
constexpr double kStill_m_s = 1e-3;
/// A ridge pushes sideways with N h'': as a spring it may not be stiffer than this, beside a coupling of some 800 N/m
/// and with the bounds of small devices (400-1000 N/m, assets/devices/). Under more pressure the relief flattens.
constexpr double kStiffest_N_m = 300.0;
/// Touches closer together than this are one: a tool that bounces on stiff tissue does so within some ms.
constexpr double kNewTouch_s = 0.02;
/// All of it together, whatever the set says: a third of what the smallest devices give (3.3 N, assets/devices/).
constexpr double kLargest_N = 1.0;
const TextureSet kSmooth;

Vec3 in_plane(const Vec3& v, const Vec3& normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace

Texture::Texture(TextureSettings settings) : settings_(std::move(settings)), vibration_(settings_.seed) {}

Vec3 Texture::tick_N(const MovingSurface& surface, const ProxyContact& contact, const TextureTouch& touch) noexcept {
  if (!contact.active) {
    touching_ = false;
    held_J_ = 0.0;
    apart_s_ += touch.dt_s;
    slide_m_s_ = 0.0;
    vibration_.next_N(kSmooth.vibration, 0.0, 0.0);  // what is under way dies out
    return Vec3::Zero();
  }
  const TextureSet& set = set_of(surface, contact);
  rotate_axes(contact.normal);
  touching_ ? travel(contact, touch) : begin_touch(set, contact, touch);
  device_m_ = touch.device.position_m;
  const Vec3 force_N =
      relief_N(set, contact, touch) + vibration_N(set, contact, touch) + knock_N(touch.dt_s) * contact.normal;
  const double size_N = force_N.norm();
  return size_N > kLargest_N ? Vec3(force_N * (kLargest_N / size_N)) : force_N;
}

const TextureSet& Texture::set_of(const MovingSurface& surface, const ProxyContact& contact) noexcept {
  const int local = surface.find(contact.surface, contact.triangle);
  if (local < 0) return kSmooth;
  const Vec3 fibre = surface.fibre_W(local);
  if (fibre.squaredNorm() > 0.0) fibre_W_ = fibre.normalized();
  return settings_.by_tissue[static_cast<std::size_t>(surface.triangle(local).tissue.tissue)];
}

/// Lays u and v into the plane of the contact. Fibres have no sign: u keeps its own.
void Texture::rotate_axes(const Vec3& normal) noexcept {
  if (fibre_W_.dot(along_W_) < 0.0) fibre_W_ = -fibre_W_;
  Vec3 along = in_plane(fibre_W_, normal);
  if (!(along.norm() > 0.05)) along = in_plane(along_W_, normal);  // fibres that stand up have no way along the surface
  if (!(along.norm() > 0.05)) along = in_plane(across_W_, normal);
  along_W_ = along.normalized();
  across_W_ = normal.cross(along_W_);
}

void Texture::begin_touch(const TextureSet& set, const ProxyContact& contact, const TextureTouch& touch) noexcept {
  const double approach_m_s = std::max(0.0, -contact.normal.dot(touch.device.velocity_m_s - contact.velocity_m_s));
  if (apart_s_ >= kNewTouch_s) {
    knock_ = set.knock;
    knock_speed_m_s_ = approach_m_s;
    knock_age_s_ = 0.0;
  }
  velocity_m_s_ = in_plane(touch.device.velocity_m_s - contact.velocity_m_s, contact.normal);
  touching_ = true;
  apart_s_ = 0.0;
}

void Texture::travel(const ProxyContact& contact, const TextureTouch& touch) noexcept {
  const Vec3 way_m = touch.device.position_m - device_m_ - touch.dt_s * contact.velocity_m_s;
  place_m_ += Eigen::Vector2d(way_m.dot(along_W_), way_m.dot(across_W_));
  const double share = 1.0 - std::exp(-touch.dt_s / kSmoothing_s);
  const Vec3 over_tissue_m_s = in_plane(touch.device.velocity_m_s - contact.velocity_m_s, contact.normal);
  velocity_m_s_ += share * (over_tissue_m_s - velocity_m_s_);
  slide_m_s_ += share * ((contact.sliding ? over_tissue_m_s.norm() : 0.0) - slide_m_s_);
}

Vec3 Texture::relief_N(const TextureSet& set, const ProxyContact& contact, const TextureTouch& touch) noexcept {
  const Eigen::Vector2d velocity_m_s(velocity_m_s_.dot(along_W_), velocity_m_s_.dot(across_W_));
  const ReliefPoint relief = relief_at(set.relief, place_m_, velocity_m_s, touch.dt_s);
  const double stiffest_N_m = touch.normal_N * relief.curvature_1_m;
  const double share = stiffest_N_m > kStiffest_N_m ? kStiffest_N_m / stiffest_N_m : 1.0;
  const double lifted_N = std::max(-touch.normal_N, share * touch.stiffness_N_m * relief.height_m);
  const double amplitude_m = share * relief.amplitude_m;
  held_J_ = 2.0 * amplitude_m * (touch.normal_N + touch.stiffness_N_m * amplitude_m);
  const Vec3 slope_W = share * (relief.slope.x() * along_W_ + relief.slope.y() * across_W_);
  return lifted_N * contact.normal - (touch.normal_N + lifted_N) * slope_W;
}

Vec3 Texture::vibration_N(const TextureSet& set, const ProxyContact& contact, const TextureTouch& touch) noexcept {
  const Vec3 slide_m_s = in_plane(velocity_m_s_, contact.normal);
  if (slide_m_s.norm() > kStill_m_s) shaking_W_ = contact.normal.cross(slide_m_s).normalized();
  return vibration_.next_N(set.vibration, touch.normal_N, slide_m_s_) * shaking_W_;
}

double Texture::knock_N(double dt_s) noexcept {
  if (!(knock_speed_m_s_ > 0.0) || !(knock_.frequency_Hz > 0.0)) return 0.0;
  knock_age_s_ += dt_s;
  return knock_.gain_Ns_m * knock_speed_m_s_ * std::exp(-knock_age_s_ / knock_.decay_s) *
         std::sin(2.0 * std::numbers::pi * knock_.frequency_Hz * knock_age_s_);
}

}  // namespace myotact::haptics
