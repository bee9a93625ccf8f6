#include "haptics/proxy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "geometry/closest_point.h"

namespace myotact::haptics {

namespace {

/// Safe parts of one tick, at most. A surface at 5 m/s past a 3 mm sphere needs 4.
constexpr int kMaxParts = 16;
/// Moves towards the device in one tick. A flat surface needs two, a fold of a muscle four.
constexpr int kMaxMoves = 10;
/// Of the radius: a surface this near bears the sphere. Above, the sphere flies on; it lands without losing its
/// friction because a slip of 0.2 mm over the roundest surface, the sphere's own radius, lifts it by 7 um only.
constexpr double kTouching = 1.02;
/// Of the radius: with less room the sphere counts as squeezed and is content with the room there is.
constexpr double kSqueezed = 0.99;
/// Triangles as near as the nearest, within the accuracy of a projection, bear the sphere together.
constexpr double kTogether_m = 3e-8;
/// Cosine of 0.01 rad. Before a flat edge the triangle ahead is as near as the one below to 3e-8 m, and its plane tilts
/// by 0.0045 rad, which would be an error of that much in the friction: planes so much alike count once, the nearest.
constexpr double kSameWay = 1.0 - 5e-5;
/// Shorter moves end the search: 0.1 um on 800 N/m are 0.08 mN.
constexpr double kConverged_m = 1e-7;
/// Tests of the sphere against triangles in a tick before it stops short. Parts of the tick that keep
/// the proxy outside are never left out.
constexpr int kTestBudget = 2000;
/// A stuck sphere may be off its anchor by this share of the radius (normal travel over a curved surface) before the
/// anchor is renewed: the anchor is what keeps it from creeping, so it is kept as long as it makes sense.
constexpr double kAnchorSlack = 0.05;
/// Nearest points of two triangles closer than this are the same corner or the same point of an edge.
constexpr double kSamePoint_m = 1e-9;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Share of a triangle in the pseudo-normal at its nearest point: the angle it fills there (Baerentzen and Aanaes
/// 2005).
double angle_at(const MovingSurface& surface, int local, const std::array<double, 3>& barycentric, double fraction) {
  for (int corner = 0; corner < 3; ++corner) {
    if (barycentric[at(corner)] < 1.0) continue;
    const Vec3 tip_m = surface.corner_m(local, corner, fraction);
    const Vec3 a = surface.corner_m(local, (corner + 1) % 3, fraction) - tip_m;
    const Vec3 b = surface.corner_m(local, (corner + 2) % 3, fraction) - tip_m;
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return std::numbers::pi;
}

}  // namespace

void Proxy::follow(const Vec3& position_m) noexcept {
  p_m_ = position_m;
  placed_ = false;
  anchor_ = {};
  contact_ = {};
  friction_.release();
}

void Proxy::tick(const MovingSurface& surface, const messages::LocalModel& model, const ProxyGoal& goal,
                 double dt_s) noexcept {
  if (!placed_) p_m_ = goal.position_m;
  Tick tick;
  tick.surface = &surface;
  tick.goal = goal;
  tick.dt_s = dt_s;
  tick.coverage_centre_m = to_vec3(model.coverage_centre_world_m);
  tick.coverage_m = std::max(0.0, model.coverage_radius_m - settings_.radius_m);
  find_anchor(surface);
  collect_candidates(tick);
  linearise(p_m_, 0.0, tick);
  rescue_if_inside(tick);
  if (!placed_) {  // the first look went as far as the model does
    placed_ = true;
    tick.linearised_at = -1.0;
    collect_candidates(tick);
    linearise(p_m_, 0.0, tick);
  }
  carry(tick);
  seek_goal(tick);
}

// ---- which triangles

void Proxy::collect_candidates(Tick& tick) noexcept {
  const MovingSurface& surface = *tick.surface;
  const double motion_m = surface.largest_motion_m();
  const double to_goal_m = (tick.goal.position_m - p_m_).norm();
  tick.travel_left_m = std::min(to_goal_m, 2.0 * settings_.radius_m) + 2.0 * motion_m + 0.5 * settings_.radius_m;
  const double reach_m = settings_.radius_m + tick.travel_left_m + motion_m;
  candidate_count_ = 0;
  for (int i = 0; i < surface.triangle_count(); ++i) {
    const Vec3 a = surface.corner_m(i, 0, 0.0);
    const Vec3 b = surface.corner_m(i, 1, 0.0);
    const Vec3 c = surface.corner_m(i, 2, 0.0);
    const Vec3 centre_m = (a + b + c) / 3.0;
    const double size_m =
        std::sqrt(std::max({(a - centre_m).squaredNorm(), (b - centre_m).squaredNorm(), (c - centre_m).squaredNorm()}));
    const bool is_near = (p_m_ - centre_m).squaredNorm() <= (size_m + reach_m) * (size_m + reach_m);
    if (is_near || !placed_) candidates_[at(candidate_count_++)] = static_cast<std::int16_t>(i);
  }
}

/// Nearest points of all candidates and the half-spaces that keep the sphere off them. Returns the clearance.
double Proxy::linearise(const Vec3& p_m, double fraction, Tick& tick) noexcept {
  if (fraction == tick.linearised_at && p_m == tick.linearised_m) return clearance_m_;
  tick.linearised_at = fraction;
  tick.linearised_m = p_m;
  const MovingSurface& surface = *tick.surface;
  const double far_m = placed_ ? settings_.radius_m + tick.travel_left_m + surface.largest_motion_m() : 1e9;
  near_count_ = 0;
  clearance_m_ = far_m;
  for (int i = 0; i < candidate_count_; ++i) {
    const int local = candidates_[at(i)];
    const geometry::TrianglePoint nearest =
        geometry::closest_point_on_triangle(p_m, surface.corner_m(local, 0, fraction),
                                            surface.corner_m(local, 1, fraction), surface.corner_m(local, 2, fraction));
    const Vec3 away_m = p_m - nearest.position_m;
    const double distance_m = away_m.norm();
    if (!(distance_m <= far_m)) continue;  // also what a triangle without area may give: not a number
    clearance_m_ = std::min(clearance_m_, distance_m);
    HalfSpace& half = half_spaces_[at(near_count_)];
    half.normal = distance_m > kSamePoint_m ? Vec3(away_m / distance_m) : Vec3(surface.frame_W(local, fraction).col(2));
    near_[at(near_count_++)] = {local, distance_m, nearest.position_m, nearest.barycentric};
  }
  tick.tests += candidate_count_;
  return clearance_m_;
}

Projection Proxy::project_at(const Vec3& goal_m, double radius_m) noexcept {
  for (int i = 0; i < near_count_; ++i) {
    half_spaces_[at(i)].offset_m = half_spaces_[at(i)].normal.dot(near_[at(i)].point_m) + radius_m;
  }
  return project_to_half_spaces(goal_m, std::span(half_spaces_.data(), at(near_count_)));
}

/// Where the half-spaces let the sphere go. In a fold that closes there may be no room for the whole radius: then for
/// as much of it as there is, at least the present clearance.
Projection Proxy::project(const Vec3& goal_m) noexcept {
  Projection result = project_at(goal_m, settings_.radius_m);
  if (result.feasible) return result;
  double low_m = 0.999 * std::min(clearance_m_, settings_.radius_m);
  double high_m = settings_.radius_m;
  for (int halving = 0; halving < 4; ++halving) {
    const double middle_m = 0.5 * (low_m + high_m);
    (project_at(goal_m, middle_m).feasible ? low_m : high_m) = middle_m;
  }
  result = project_at(goal_m, low_m);
  if (!result.feasible) result.point_m = p_m_;
  return result;
}

/// Goes the straight way, which crosses nothing, as far as triangles are known.
void Proxy::move_towards(const Vec3& target_m, Tick& tick) noexcept {
  Vec3 move_m = target_m - p_m_;
  const double length_m = move_m.norm();
  if (length_m > tick.travel_left_m) move_m *= tick.travel_left_m / length_m;
  const Vec3 from_centre_m = p_m_ - tick.coverage_centre_m;
  const double inside_m2 = tick.coverage_m * tick.coverage_m - from_centre_m.squaredNorm();
  if ((from_centre_m + move_m).squaredNorm() >
      std::max(tick.coverage_m * tick.coverage_m, from_centre_m.squaredNorm())) {
    // |centre + share * move| = coverage, solved for the share
    const double half_b = from_centre_m.dot(move_m);
    const double a = move_m.squaredNorm();
    const double share = inside_m2 > 0.0 ? (std::sqrt(half_b * half_b + a * inside_m2) - half_b) / a : 0.0;
    move_m *= std::clamp(share, 0.0, 1.0);
  }
  p_m_ += move_m;
  tick.travel_left_m -= move_m.norm();
}

// ---- the moving surface

double Proxy::relative_motion_m(const Tick& tick, const Vec3& carried_m) const noexcept {
  double largest_m2 = 0.0;
  for (int i = 0; i < candidate_count_; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      std::array<double, 3> barycentric{};
      barycentric[at(corner)] = 1.0;
      const Vec3 motion_m = tick.surface->motion_m(candidates_[at(i)], barycentric);
      largest_m2 = std::max(largest_m2, (motion_m - carried_m).squaredNorm());
    }
  }
  return std::sqrt(largest_m2);
}

/// Plays the surface's motion of this tick and keeps the sphere outside; starts linearised at the tick's beginning.
void Proxy::carry(Tick& tick) noexcept {
  const MovingSurface& surface = *tick.surface;
  const bool moves = surface.largest_motion_m() > 0.0;
  const Vec3 carried_m =
      moves && anchor_.local >= 0 ? surface.motion_m(anchor_.local, anchor_.barycentric) : Vec3::Zero();
  const double relative_m = moves ? relative_motion_m(tick, carried_m) : 0.0;
  double fraction = 0.0;
  for (int part = 1; fraction < 1.0; ++part) {
    double next = 1.0;
    if (relative_m * (1.0 - fraction) > 0.5 * clearance_m_) {
      if (part == kMaxParts)
        ++counters_.short_steps;
      else
        next = std::min(1.0, fraction + std::max(0.5 * clearance_m_ / relative_m, 1e-3));
    }
    p_m_ += (next - fraction) * carried_m;
    fraction = next;
    linearise(p_m_, fraction, tick);
    const Projection out = project(anchor_.local >= 0 ? anchored_m(surface, fraction) : p_m_);
    move_towards(out.point_m, tick);
    if (fraction < 1.0) linearise(p_m_, fraction, tick);
  }
}

int Proxy::nearest() const noexcept {
  int found = -1;
  for (int i = 0; i < near_count_; ++i) {
    if (found < 0 || near_[at(i)].distance_m < near_[at(found)].distance_m) found = i;
  }
  return found;
}

void Proxy::rescue_if_inside(const Tick& tick) noexcept {
  const int first = nearest();
  if (first < 0) return;
  const Vec3 foot_m = near_[at(first)].point_m;
  Vec3 outward = Vec3::Zero();
  int sharing = 0;
  for (int i = 0; i < near_count_; ++i) {
    if ((near_[at(i)].point_m - foot_m).norm() > kSamePoint_m) continue;
    const int local = near_[at(i)].local;
    outward += angle_at(*tick.surface, local, near_[at(i)].barycentric, 0.0) * tick.surface->frame_W(local, 0.0).col(2);
    ++sharing;
  }
  const std::array<double, 3>& b = near_[at(first)].barycentric;
  const bool on_face = std::min({b[0], b[1], b[2]}) > 0.0;
  const bool on_border = sharing < 2 && !on_face;  // the end of an open surface has no inside
  if (on_border || outward.dot(p_m_ - foot_m) >= 0.0) return;
  p_m_ = foot_m + settings_.radius_m * outward.normalized();
  anchor_ = {};
  if (placed_) ++counters_.rescues;  // a device that starts inside tissue is no fault of the proxy
}

// ---- friction

void Proxy::find_anchor(const MovingSurface& surface) noexcept {
  anchor_.local = anchor_.held ? surface.find(anchor_.surface, anchor_.triangle) : -1;
}

Vec3 Proxy::anchored_m(const MovingSurface& surface, double fraction) const noexcept {
  return surface.point_m(anchor_.local, anchor_.barycentric, fraction) +
         surface.frame_W(anchor_.local, fraction) * anchor_.offset_T_m;
}

void Proxy::seek_goal(Tick& tick) noexcept {
  Projection held;
  bool settled = false;
  for (int move = 0; move < kMaxMoves && !settled && tick.tests < kTestBudget; ++move) {
    held = press(tick);
    Vec3 move_m = (held.active_count == 0 ? free_target_m(tick) : slide(held, tick)) - p_m_;
    const double length_m = move_m.norm();
    settled = length_m < kConverged_m;
    if (length_m > 0.5 * clearance_m_) move_m *= 0.5 * clearance_m_ / length_m;  // so far nothing can be crossed
    move_towards(p_m_ + move_m, tick);
    if (settled) break;
    if (linearise(p_m_, 1.0, tick) < settings_.radius_m) move_towards(project(p_m_).point_m, tick);
  }
  if (!settled) {
    ++counters_.over_budget;
    held = press(tick);
  }
  settle_contact(held, tick);
}

/// Where the device would pull the sphere if only the triangles that it touches were there, without friction. Planes of
/// farther triangles are safe to obey but no truth: they would tilt the reaction.
Projection Proxy::press(Tick& tick) noexcept {
  linearise(p_m_, 1.0, tick);
  touching_count_ = 0;
  const double radius_m = clearance_m_ < kSqueezed * settings_.radius_m ? clearance_m_ : settings_.radius_m;
  const int first = nearest();
  for (int i = 0; i < near_count_ && clearance_m_ <= kTouching * settings_.radius_m; ++i) {
    if (near_[at(i)].distance_m > clearance_m_ + kTogether_m || touching_count_ == kMaxTouching) continue;
    if (i != first && half_spaces_[at(i)].normal.dot(half_spaces_[at(first)].normal) > kSameWay) continue;
    touching_[at(touching_count_)] = i;
    HalfSpace& half = touching_spaces_[at(touching_count_++)];
    half.normal = half_spaces_[at(i)].normal;
    half.offset_m = half.normal.dot(near_[at(i)].point_m) + radius_m;
  }
  Projection held =
      project_to_half_spaces(tick.goal.position_m, std::span(touching_spaces_.data(), at(touching_count_)));
  if (!held.feasible) {  // no room at all: the sphere stays where it is
    held = {};
    held.point_m = p_m_;
    held.active_count = touching_count_ > 0 ? 1 : 0;
    held.reaction_m[0] = (tick.goal.position_m - p_m_).norm();
  }
  return held;
}

/// Towards the device as far as no triangle's plane comes nearer than the radius, and a little more, so that it
/// touches.
Vec3 Proxy::free_target_m(const Tick& tick) const noexcept {
  const Vec3 way_m = tick.goal.position_m - p_m_;
  const double length_m = way_m.norm();
  if (clearance_m_ <= kTouching * settings_.radius_m || !(length_m > 0.0)) return tick.goal.position_m;
  double free_m = length_m;
  for (int i = 0; i < near_count_; ++i) {
    const double approach = -half_spaces_[at(i)].normal.dot(way_m) / length_m;
    if (approach <= 0.0) continue;
    free_m = std::min(free_m, (near_[at(i)].distance_m - settings_.radius_m) / approach + 0.01 * settings_.radius_m);
  }
  return p_m_ + way_m * (free_m / length_m);
}

/// `held` is where the sphere would go without friction; what the tissue pushes back with (reaction depth) sets how far
/// the sphere may lag behind it along the surface, in lengths of the coupling spring.
Vec3 Proxy::slide(const Projection& held, Tick& tick) noexcept {
  if (!tick.rubbed) tick.rubbed_from_m = p_m_;
  tick.rubbed = true;
  const Vec3 reaction_m = held.point_m - tick.goal.position_m;
  const MovingSurface& surface = *tick.surface;
  const Nearest& bearing = near_[at(touching_[at(held.active[0])])];
  const Vec3 tissue_m_s = surface.motion_m(bearing.local, bearing.barycentric) / tick.dt_s;
  FrictionTrial trial;
  trial.normal = reaction_m.normalized();
  const double approach_m_s = std::max(0.0, -trial.normal.dot(tick.goal.velocity_m_s - tissue_m_s));
  trial.depth_m = reaction_m.norm() + settings_.damping_Ns_m * approach_m_s / settings_.stiffness_N_m;
  const auto along_surface = [&](const Vec3& v) { return Vec3(v - v.dot(trial.normal) * trial.normal); };
  trial.lag_m = along_surface(held.point_m - p_m_);
  trial.slipped_m = along_surface(p_m_ - tick.rubbed_from_m);
  trial.fibre = surface.fibre_W(bearing.local);
  trial.dt_s = tick.dt_s;
  const Vec3 slip_m = friction_.slip_m(trial);
  tick.slipped = tick.slipped || slip_m.norm() > kConverged_m;
  return held.point_m - trial.lag_m + slip_m;
}

void Proxy::settle_friction(const Tick& tick) noexcept {
  if (!tick.rubbed) return;
  const auto speed_along_surface = [&](const Vec3& v) { return (v - v.dot(contact_.normal) * contact_.normal).norm(); };
  friction_.settle(speed_along_surface(p_m_ - tick.rubbed_from_m),
                   speed_along_surface(tick.goal.velocity_m_s - contact_.velocity_m_s), tick.dt_s);
}

void Proxy::settle_contact(const Projection& held, const Tick& tick) noexcept {
  const bool touches = held.active_count > 0;
  if (!touches) {
    contact_ = {};
    anchor_ = {};
    friction_.release();
    return;
  }
  int strongest = 0;
  for (int i = 1; i < held.active_count; ++i) {
    if (held.reaction_m[at(i)] > held.reaction_m[at(strongest)]) strongest = i;
  }
  const MovingSurface& surface = *tick.surface;
  const int local = near_[at(touching_[at(held.active[at(strongest)])])].local;
  const bool keeps = !tick.slipped && anchor_.local >= 0 &&
                     (p_m_ - anchored_m(surface, 1.0)).norm() < kAnchorSlack * settings_.radius_m;
  if (!keeps) set_anchor(surface, local);
  const geometry::TrianglePoint touched = geometry::closest_point_on_triangle(
      p_m_, surface.corner_m(local, 0, 1.0), surface.corner_m(local, 1, 1.0), surface.corner_m(local, 2, 1.0));
  contact_.active = true;
  contact_.surface = surface.triangle(local).surface;
  contact_.triangle = surface.triangle(local).triangle;
  contact_.barycentric = touched.barycentric;
  contact_.point_m = touched.position_m;
  contact_.normal = (held.point_m - tick.goal.position_m).normalized();
  contact_.velocity_m_s = surface.motion_m(local, touched.barycentric) / tick.dt_s;
  contact_.sliding = tick.slipped;
  settle_friction(tick);
}

void Proxy::set_anchor(const MovingSurface& surface, int local) noexcept {
  const geometry::TrianglePoint touched = geometry::closest_point_on_triangle(
      p_m_, surface.corner_m(local, 0, 1.0), surface.corner_m(local, 1, 1.0), surface.corner_m(local, 2, 1.0));
  anchor_.held = true;
  anchor_.surface = surface.triangle(local).surface;
  anchor_.triangle = surface.triangle(local).triangle;
  anchor_.barycentric = touched.barycentric;
  anchor_.offset_T_m = surface.frame_W(local, 1.0).transpose() * (p_m_ - touched.position_m);
  anchor_.local = local;
}

}  // namespace myotact::haptics
