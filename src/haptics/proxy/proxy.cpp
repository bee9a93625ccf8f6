#include "haptics/proxy/proxy.h"

#include <algorithm>

#include "core/at.h"
#include "haptics/proxy/surface_walk.h"

namespace myotact::haptics {

namespace {

/// Safe parts of one tick, at most. A surface at 5 m/s past a 3 mm sphere needs 4, past one of 0.5 mm 40. What is
/// faster may get behind the sphere, which the next tick then puts outside again and counts.
constexpr int kMaxParts = 64;
/// Moves towards the device in one tick. A flat surface needs two, a fold of a muscle four.
constexpr int kMaxMoves = 10;
/// Of the radius: a surface this near carries the sphere. Above, the sphere flies on; it lands without losing its
/// friction because a slip of 0.2 mm over the roundest surface, the sphere's own radius, lifts it by 7 um only.
constexpr double kTouching = 1.02;
/// Of the radius: with less room the sphere counts as squeezed and is content with the room there is.
constexpr double kSqueezed = 0.99;
/// Triangles as near as the nearest, within the accuracy of a projection, support the sphere together.
constexpr double kTogether_m = 3e-8;
/// Other surfaces this near have their planes in the search: the sphere goes at once to where it rests on all of them.
/// With the touched one alone it goes to and fro between two round ones that meet in a shallow crease (measured: 0.39
/// mm off). 1 mm makes larger steps of force on the elbow.
constexpr double kSoonTouching_m = 2e-4;
/// Cosine of 0.01 rad. Before a flat edge the triangle ahead is as near as the one below to 3e-8 m, and its plane tilts
/// by 0.0045 rad, which would be an error of that much in the friction: planes so much alike count once, the nearest.
constexpr double kSameWay = 1.0 - 5e-5;
/// Shorter moves end the search: 0.1 um on 800 N/m are 0.08 mN.
constexpr double kConverged_m = 1e-7;
/// Tests of the sphere against triangles in a tick before it stops short. Parts of the tick that keep
/// the proxy outside are never left out.
constexpr int kTestBudget = 2000;
/// The next move would be less than a tenth of this one (depth over radius of curvature): not worth its look.
constexpr double kSettled_m = 1e-6;
/// Beyond all that a model holds.
constexpr double kEverywhere_m = 1e3;
/// Of the radius: the way that a tick is allowed at first, besides that of hand and surface. Longer ways come with
/// stick and slip and over edges.
constexpr double kUsualWay = 0.02;
/// Longer ways that a tick may be allowed.
constexpr int kMostWays = 3;

NearSurface::StandOff stand_off_for(double radius_m) {
  return {4.0 / 3.0 * CurvedSurface::kHighest_m, CurvedSurface::kSteepest, CurvedSurface::kShortest * radius_m};
}

}  // namespace

Proxy::Proxy(const ContactSettings& settings)
    : settings_(settings),
      friction_(settings),
      near_(std::max(settings.radius_m, kPoint_m), stand_off_for(std::max(settings.radius_m, kPoint_m))),
      skin_(std::max(settings.radius_m, kPoint_m)) {
  settings_.radius_m = std::max(settings.radius_m, kPoint_m);
}

void Proxy::resize(double radius_m) noexcept {
  settings_.radius_m = std::max(radius_m, kPoint_m);
  near_.resize(settings_.radius_m, stand_off_for(settings_.radius_m));
  skin_.resize(settings_.radius_m);
  anchor_ = {};
  friction_.release();
}

void Proxy::follow(const Vec3& position_m) noexcept {
  p_m_ = position_m;
  placed_ = false;
  anchor_ = {};
  contact_ = {};
  friction_.release();
}

void Proxy::tick(const MovingSurface& surface, const messages::LocalModel& model, const ProxyGoal& goal,
                 double dt_s) noexcept {
  Tick tick;
  tick.surface = &surface;
  tick.goal = goal;
  tick.dt_s = dt_s;
  near_.begin_tick(surface, model);
  skin_.begin_tick(surface);
  find_anchor(surface);
  if (!placed_) place(surface, goal.position_m);
  const Vec3 before_m = p_m_;
  const double hand_m = (goal.position_m - last_goal_m_).norm();
  const double usual_m = kUsualWay * settings_.radius_m + 1.5 * hand_m + 2.0 * surface.largest_motion_m();
  near_.collect(p_m_, std::min(usual_m, longest_way_m(tick)));
  near_.linearise(p_m_, 0.0);
  if (rescue_if_inside(surface)) {
    ++counters_.rescues;
    near_.collect(p_m_, longest_way_m(tick));
    near_.linearise(p_m_, 0.0);
  }
  carry(tick);
  seek_goal(tick);
  remember_home(surface);
  last_goal_m_ = goal.position_m;
  if (!p_m_.allFinite()) {  // never seen; a sphere that is nowhere would stay there
    follow(before_m);
    ++counters_.rescues;
  }
}

// ---- how far it goes

/// No way of a tick is longer.
double Proxy::longest_way_m(const Tick& tick) const noexcept {
  return std::min((tick.goal.position_m - p_m_).norm(), 2.0 * settings_.radius_m) +
         2.0 * tick.surface->largest_motion_m() + 0.5 * settings_.radius_m;
}

/// The way is longer than usual: the triangles along a longer one, from here. False: it was long enough.
bool Proxy::allow_more(Tick& tick, double fraction) noexcept {
  if (near_.travel_left_m() > kConverged_m || tick.ways == kMostWays) return false;
  ++tick.ways;
  near_.collect(p_m_, longest_way_m(tick) / (kMostWays + 1 - tick.ways));
  near_.linearise(p_m_, fraction);
  return true;
}

/// Goes the straight way, which crosses nothing, as far as triangles are known.
void Proxy::move_towards(const Vec3& target_m) noexcept {
  p_m_ += near_.allowed(p_m_, target_m - p_m_);
}

// ---- the moving surface

/// Plays the surface's motion of this tick and keeps the sphere outside; starts linearised at the tick's beginning.
void Proxy::carry(Tick& tick) noexcept {
  const MovingSurface& surface = *tick.surface;
  const bool moves = surface.largest_motion_m() > 0.0;
  const Vec3 carried_m =
      moves && anchor_.local >= 0 ? surface.motion_m(anchor_.local, anchor_.barycentric) : Vec3::Zero();
  const double relative_m = moves ? near_.relative_motion_m(carried_m) : 0.0;
  double fraction = 0.0;
  for (int part = 1; fraction < 1.0; ++part) {
    const double clearance_m = near_.clearance_m();
    double next = 1.0;
    if (part < kMaxParts && relative_m * (1.0 - fraction) > 0.5 * clearance_m) {
      next = std::min(1.0, fraction + std::max(0.5 * clearance_m / relative_m, 1e-3));
    }
    p_m_ += (next - fraction) * carried_m;
    fraction = next;
    near_.linearise(p_m_, fraction);
    put_outside(tick, fraction);
  }
}

/// To its anchor, or where it is, as near as the triangles allow.
void Proxy::put_outside(Tick& tick, double fraction) noexcept {
  do {
    const Vec3 wanted_m = anchor_.local >= 0 ? anchored_m(*tick.surface, fraction) : p_m_;
    move_towards(near_.project(wanted_m).point_m);
  } while (allow_more(tick, fraction));
  if (fraction < 1.0) near_.linearise(p_m_, fraction);
}

/// The safety net under the half-spaces: to the side where it was last, not to whatever surface is nearest, which in a
/// thin sheet may be the other side.
bool Proxy::rescue_if_inside(const MovingSurface& surface) noexcept {
  const int first = near_.nearest();
  if (first < 0) return false;
  const NearestPoint& nearest = near_.near(first);
  if (outward_at(surface, nearest).dot(p_m_ - nearest.point_m) >= 0.0) return false;
  const int home = home_surface_ < 0 ? -1 : surface.find(home_surface_, home_triangle_);
  const NearestPoint foot = home < 0 ? nearest : walk_to_nearest(surface, home, p_m_);
  const Vec3 outward = outward_at(surface, foot);
  if (outward.dot(p_m_ - foot.point_m) >= 0.0) return false;  // of its own sheet it is outside
  p_m_ = foot.point_m + settings_.radius_m * outward.normalized();
  anchor_ = {};
  return true;
}

/// Begins where the device is, or beside the surface that is there: a device that starts inside tissue is no fault of
/// the proxy. The first look goes as far as the model does.
void Proxy::place(const MovingSurface& surface, const Vec3& goal_m) noexcept {
  p_m_ = last_goal_m_ = goal_m;
  home_surface_ = -1;
  near_.collect(p_m_, kEverywhere_m);
  const double clearance_m = near_.linearise(p_m_, 0.0);
  if (!rescue_if_inside(surface) && near_.nearest() >= 0 && clearance_m < settings_.radius_m) {
    p_m_ += (settings_.radius_m - clearance_m) * near_.normal(near_.nearest());
  }
  placed_ = true;
}

void Proxy::remember_home(const MovingSurface& surface) noexcept {
  if (near_.nearest() < 0) return;  // nothing within its way
  const messages::LocalModel::Triangle& triangle = surface.triangle(near_.near(near_.nearest()).local);
  home_surface_ = triangle.surface;
  home_triangle_ = triangle.triangle;
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
  for (int move = 0; move < kMaxMoves && !settled && near_.tests() < kTestBudget; ++move) {
    held = press(tick);
    Vec3 move_m = (held.active_count == 0 ? free_target_m(tick) : slide(held, tick)) - p_m_;
    const double length_m = move_m.norm();
    settled = length_m < kSettled_m;
    const double safe_m = 0.5 * near_.clearance_m();  // so far nothing can be crossed
    if (length_m > safe_m) move_m *= safe_m / length_m;
    move_towards(p_m_ + move_m);
    if (length_m < kConverged_m) break;
    if (near_.linearise(p_m_, 1.0) < settings_.radius_m) move_towards(near_.project(p_m_).point_m);
    allow_more(tick, 1.0);
  }
  if (!settled) {
    ++counters_.over_budget;
    held = press(tick);
  }
  settle_contact(held, tick);
}

/// The triangles whose skin touches the sphere, all as near as the nearest. Where a fold leaves less room than the
/// radius they themselves count, not their skins.
void Proxy::find_touching() noexcept {
  const double clearance_m = near_.linearise(p_m_, 1.0);
  const bool is_squeezed = clearance_m < kSqueezed * settings_.radius_m;
  const double radius_m = is_squeezed ? clearance_m : settings_.radius_m;
  std::array<NearestPoint, kMaxTouching> points;
  int count = 0;
  int first = -1;
  touching_count_ = 0;
  felt_clearance_m_ = clearance_m;
  if (near_.nearest() < 0 || clearance_m > kTouching * settings_.radius_m + near_.stand_off_m()) return;
  const auto look_at = [&](int i) {
    const NearestPoint& near = near_.near(i);
    const double bound_m = felt_clearance_m_ + kTogether_m;
    const double stand_off_m = is_squeezed ? 0.0 : near_.stand_off_m(near.local);
    if (near.distance_m > bound_m + stand_off_m || count == kMaxTouching) return;
    const bool is_curved = stand_off_m > 0.0;
    if (is_curved && near.distance_m > bound_m + skin_.height_m(near.local)) return;
    points[at(count)] = is_curved ? skin_.nearest(near, p_m_) : near;
    if (points[at(count)].distance_m > bound_m) return;
    if (first < 0 || points[at(count)].distance_m < felt_clearance_m_) first = count;
    felt_clearance_m_ = std::min(felt_clearance_m_, points[at(count)].distance_m);
    touching_[at(count++)] = i;
  };
  look_at(near_.nearest());  // first, for the others need not be looked at when they are farther
  for (int i = 0; i < near_.count(); ++i) {
    if (i != near_.nearest()) look_at(i);
  }
  if (felt_clearance_m_ > kTouching * settings_.radius_m) return;
  if (first >= 0) std::swap(points[0], points[at(first)]), std::swap(touching_[0], touching_[at(first)]);
  keep_off(std::span(points.data(), at(count)), radius_m);
}

/// The half-spaces of those of the touching points that are as near as the nearest, which comes first.
void Proxy::keep_off(std::span<const NearestPoint> points, double radius_m) noexcept {
  for (int i = 0; at(i) < points.size(); ++i) {
    if (points[at(i)].distance_m > felt_clearance_m_ + kTogether_m) continue;
    HalfSpace half;
    half.normal = points[at(i)].distance_m > 0.0 ? Vec3((p_m_ - points[at(i)].point_m) / points[at(i)].distance_m)
                                                 : near_.normal(touching_[at(i)]);
    if (i > 0 && half.normal.dot(touching_spaces_[0].normal) > kSameWay) continue;
    half.offset_m = half.normal.dot(points[at(i)].point_m) + radius_m;
    touching_[at(touching_count_)] = touching_[at(i)];
    touching_spaces_[at(touching_count_++)] = half;
  }
}

/// The planes of other surfaces that the sphere may come to rest on in its next move, one each, the nearest first.
void Proxy::keep_off_others(const MovingSurface& surface) noexcept {
  const auto surface_of = [&](int i) { return surface.triangle(near_.near(i).local).surface; };
  const int touching = touching_count_;
  const int most = std::min(kMaxTouching, touching + static_cast<int>(messages::kMaxContactsBeside));
  while (touching > 0 && touching_count_ < most) {
    const auto known = std::span(touching_.data(), at(touching_count_));
    int next = -1;
    for (int i = 0; i < near_.count(); ++i) {
      if (next >= 0 && near_.near(i).distance_m >= near_.near(next).distance_m) continue;
      if (near_.near(i).distance_m > settings_.radius_m + near_.stand_off_m() + kSoonTouching_m) continue;
      if (std::any_of(known.begin(), known.end(), [&](int k) { return surface_of(k) == surface_of(i); })) continue;
      next = i;
    }
    if (next < 0) return;
    const NearestPoint& near = near_.near(next);
    const NearestPoint foot = near_.stand_off_m(near.local) > 0.0 ? skin_.nearest(near, p_m_) : near;
    if (!(foot.distance_m > 0.0) || foot.distance_m > settings_.radius_m + kSoonTouching_m) return;
    HalfSpace half;
    half.normal = (p_m_ - foot.point_m) / foot.distance_m;
    half.offset_m = half.normal.dot(foot.point_m) + std::min(settings_.radius_m, foot.distance_m);  // or it would push
    touching_[at(touching_count_)] = next;
    touching_spaces_[at(touching_count_++)] = half;
  }
}

/// Where the device would pull the sphere without friction if only the triangles that it touches were there, and the
/// nearest of surfaces beside. Farther planes of a touched surface are safe to obey but no truth: they would tilt the
/// reaction.
Projection Proxy::press(Tick& tick) noexcept {
  find_touching();
  keep_off_others(*tick.surface);
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
  if (felt_clearance_m_ <= kTouching * settings_.radius_m || !(length_m > 0.0)) return tick.goal.position_m;
  double free_m = length_m;
  for (int i = 0; i < near_.count(); ++i) {
    const double approach = -near_.normal(i).dot(way_m) / length_m;
    if (approach <= 0.0) continue;
    free_m = std::min(free_m, (near_.near(i).distance_m - settings_.radius_m) / approach + 0.01 * settings_.radius_m);
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
  const NearestPoint& bearing = near_.near(touching_[at(held.active[0])]);
  const Vec3 tissue_m_s = surface.motion_m(bearing.local, bearing.barycentric) / tick.dt_s;
  FrictionTrial trial;
  trial.normal = reaction_m.normalized();
  const double approach_m_s = std::max(0.0, -trial.normal.dot(tick.goal.velocity_m_s - tissue_m_s));
  trial.depth_m = reaction_m.norm() + settings_.damping_Ns_m * approach_m_s / settings_.stiffness_N_m;
  const auto along_surface = [&](const Vec3& v) { return Vec3(v - v.dot(trial.normal) * trial.normal); };
  trial.lag_m = along_surface(held.point_m - p_m_);
  trial.slipped_m = along_surface(p_m_ - tick.rubbed_from_m);
  trial.fibre = surface.fibre_W(bearing.local);
  trial.stiffness_N_m = settings_.stiffness_N_m;
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

}  // namespace myotact::haptics
