#include "haptics/proxy/near_surface.h"

#include <algorithm>
#include <cmath>

#include "core/at.h"

namespace myotact::haptics {

namespace {

/// Nearest points of two triangles closer than this are the same corner or the same point of an edge.
constexpr double kSamePoint_m = 1e-9;
/// Of the radius: spheres grown by more leave out too little and are computed anew (2 us).
constexpr double kMostGrowth = 0.25;
/// A muscle that is dented deep folds round the sphere. Two places of one surface count as two contacts when they are
/// seen at more than 30 degrees from each other (cosine): at less, one bears what both would.
constexpr double kOtherSide = 0.866;
/// Cosine of 18 degrees between a triangle's normal and the way from its nearest point to the sphere. On a smooth
/// surface next to the touched point that one lies on the rim, and the angle is as large as the one above.
constexpr double kOnItsFace = 0.951;
/// Cosine of 12 degrees, the difference of the two: a triangle turned by less than that from the touched place is on
/// the same side, wherever its nearest point is.
constexpr double kSameSide = 0.978;

/// Out of the tissue, at the end of the tick; zero for a triangle without area.
Vec3 face_normal_W(const MovingSurface& surface, int local) {
  const Vec3 a = surface.corner_m(local, 0, 1.0);
  return (surface.corner_m(local, 1, 1.0) - a).cross(surface.corner_m(local, 2, 1.0) - a).normalized();
}

}  // namespace

void NearSurface::resize(double radius_m, const StandOff& stand_off) noexcept {
  radius_m_ = radius_m;
  stand_off_ = stand_off;
  enclosed_list_ = 0;  // what stands on the triangles is other now
}

void NearSurface::begin_tick(const MovingSurface& surface, const messages::LocalModel& model) noexcept {
  surface_ = &surface;
  coverage_centre_m_ = to_vec3(model.coverage_centre_world_m);
  coverage_m_ = std::max(0.0, model.coverage_radius_m - radius_m_);
  tests_ = 0;
  linearised_at_ = -1.0;
  moved_m_ += surface.largest_motion_m();
  const bool is_grown = moved_m_ > kMostGrowth * radius_m_;
  if (is_grown || enclosed_list_ != surface.list_count())
    enclose_triangles(!is_grown && enclosed_list_ + 1 == surface.list_count());
}

/// At the beginning of the tick; the motion of the tick itself is added when they are used. `keeps_known`: triangles
/// that were in the list before keep their spheres.
void NearSurface::enclose_triangles(bool keeps_known) noexcept {
  const std::array<Sphere, kMost> before = spheres_;
  stand_off_m_ = 0.0;
  for (int i = 0; i < surface_->triangle_count(); ++i) {
    const int place = keeps_known ? surface_->place_before(i) : -1;
    spheres_[at(i)] = place >= 0 ? before[at(place)] : enclosed(i);
    stand_off_m_ = std::max(stand_off_m_, sphere(i).stand_off_m);
  }
  enclosed_list_ = surface_->list_count();
  if (!keeps_known) moved_m_ = surface_->largest_motion_m();
}

NearSurface::Sphere NearSurface::enclosed(int local) const noexcept {
  const Vec3 a = surface_->corner_m(local, 0, 0.0);
  const Vec3 b = surface_->corner_m(local, 1, 0.0);
  const Vec3 c = surface_->corner_m(local, 2, 0.0);
  Sphere sphere;
  sphere.centre_m = (a + b + c) / 3.0;
  sphere.radius_m = std::sqrt(std::max(
      {(a - sphere.centre_m).squaredNorm(), (b - sphere.centre_m).squaredNorm(), (c - sphere.centre_m).squaredNorm()}));
  const double longest_m = 2.0 * sphere.radius_m;  // no edge is longer
  if (longest_m > stand_off_.shortest_m)
    sphere.stand_off_m = std::min(stand_off_.highest_m, stand_off_.of_edge * longest_m);
  return sphere;
}

void NearSurface::collect(const Vec3& p_m, double travel_m) noexcept {
  travel_left_m_ = travel_m;
  linearised_at_ = -1.0;
  const double reach_m = radius_m_ + travel_m + moved_m_;
  candidate_count_ = 0;
  for (int i = 0; i < surface_->triangle_count(); ++i) {
    const double far_m = sphere(i).radius_m + sphere(i).stand_off_m + reach_m;
    candidates_[at(candidate_count_)] = static_cast<std::int16_t>(i);
    candidate_count_ += (sphere(i).centre_m - p_m).squaredNorm() <= far_m * far_m ? 1 : 0;
  }
}

double NearSurface::linearise(const Vec3& p_m, double fraction) noexcept {
  const MovingSurface& surface = *surface_;
  const bool is_still = !(surface.largest_motion_m() > 0.0);
  if ((is_still ? linearised_at_ >= 0.0 : fraction == linearised_at_) && p_m == linearised_m_) return clearance_m_;
  linearised_at_ = fraction;
  linearised_m_ = p_m;
  const double far_m = radius_m_ + travel_left_m_ + surface.largest_motion_m();
  near_count_ = 0;
  nearest_ = -1;
  clearance_m_ = far_m;
  for (int i = 0; i < candidate_count_; ++i) {
    const int local = candidates_[at(i)];
    const geometry::TrianglePoint nearest = surface.closest_point(p_m, local, fraction);
    const Vec3 away_m = p_m - nearest.position_m;
    const double distance_m = away_m.norm();
    if (!(distance_m <= far_m + stand_off_m(local)))
      continue;  // also what a triangle without area may give: not a number
    if (nearest_ < 0 || distance_m < clearance_m_) nearest_ = near_count_;
    clearance_m_ = std::min(clearance_m_, distance_m);
    half_spaces_[at(near_count_)].normal =
        distance_m > kSamePoint_m ? Vec3(away_m / distance_m) : Vec3(surface.frame_W(local, fraction).col(2));
    near_[at(near_count_++)] = {local, distance_m, nearest.position_m, nearest.barycentric};
  }
  tests_ += candidate_count_;
  drop_far_candidates();
  return clearance_m_;
}

/// What is out of reach now stays so: the way allowed only shrinks until triangles are collected anew.
void NearSurface::drop_far_candidates() noexcept {
  for (int i = 0; i < near_count_; ++i) candidates_[at(i)] = static_cast<std::int16_t>(near_[at(i)].local);
  candidate_count_ = near_count_;
}

Projection NearSurface::project_at(const Vec3& goal_m, double radius_m) noexcept {
  for (int i = 0; i < near_count_; ++i) {
    half_spaces_[at(i)].offset_m = half_spaces_[at(i)].normal.dot(near_[at(i)].point_m) + radius_m;
  }
  return project_to_half_spaces(goal_m, std::span(half_spaces_.data(), at(near_count_)));
}

Projection NearSurface::project(const Vec3& goal_m) noexcept {
  Projection result = project_at(goal_m, radius_m_);
  if (result.feasible) return result;
  double low_m = 0.999 * std::min(clearance_m_, radius_m_);
  double high_m = radius_m_;
  for (int halving = 0; halving < 4; ++halving) {
    const double middle_m = 0.5 * (low_m + high_m);
    (project_at(goal_m, middle_m).feasible ? low_m : high_m) = middle_m;
  }
  result = project_at(goal_m, low_m);
  if (!result.feasible) result.point_m = linearised_m_;
  return result;
}

Vec3 NearSurface::allowed(const Vec3& from_m, const Vec3& wanted_m) noexcept {
  Vec3 move_m = wanted_m;
  const double length_m = move_m.norm();
  if (length_m > travel_left_m_) move_m *= travel_left_m_ / length_m;
  const Vec3 from_centre_m = from_m - coverage_centre_m_;
  const double inside_m2 = coverage_m_ * coverage_m_ - from_centre_m.squaredNorm();
  if ((from_centre_m + move_m).squaredNorm() > std::max(coverage_m_ * coverage_m_, from_centre_m.squaredNorm())) {
    // |centre + share * move| = coverage, solved for the share
    const double half_b = from_centre_m.dot(move_m);
    const double a = move_m.squaredNorm();
    const double share = inside_m2 > 0.0 ? (std::sqrt(half_b * half_b + a * inside_m2) - half_b) / a : 0.0;
    move_m *= std::clamp(share, 0.0, 1.0);
  }
  travel_left_m_ = std::max(0.0, travel_left_m_ - move_m.norm());
  return move_m;
}

int NearSurface::nearest_beside(const Vec3& p_m, std::int32_t surface, const Vec3& outward, double reach_m,
                                std::span<NearestPoint> found) const noexcept {
  const auto surface_of = [&](const NearestPoint& point) { return surface_->triangle(point.local).surface; };
  const auto is_nearer = [](const NearestPoint& a, const NearestPoint& b) { return a.distance_m < b.distance_m; };
  std::size_t count = 0;
  for (int i = 0; i < surface_->triangle_count(); ++i) {
    const double far_m = sphere(i).radius_m + reach_m + moved_m_;
    if ((sphere(i).centre_m - p_m).squaredNorm() > far_m * far_m) continue;
    const bool is_touched = surface_->triangle(i).surface == surface;
    const Vec3 face = is_touched ? face_normal_W(*surface_, i) : Vec3(Vec3::Zero());
    if (is_touched && face.dot(outward) > kSameSide) continue;
    const geometry::TrianglePoint nearest = surface_->closest_point(p_m, i, 1.0);
    const NearestPoint point{i, (p_m - nearest.position_m).norm(), nearest.position_m, nearest.barycentric};
    if (!(point.distance_m > 0.0 && point.distance_m <= reach_m)) continue;
    const Vec3 to_centre = (p_m - nearest.position_m) / point.distance_m;
    if (is_touched && (to_centre.dot(outward) > kOtherSide || to_centre.dot(face) < kOnItsFace)) continue;
    const auto known = found.first(count);
    auto place = std::find_if(known.begin(), known.end(),
                              [&](const NearestPoint& other) { return surface_of(other) == surface_of(point); });
    if (place == known.end() && count < found.size()) {
      found[count++] = point;
      continue;
    }
    if (place == known.end()) place = std::max_element(known.begin(), known.end(), is_nearer);
    if (place != known.end() && is_nearer(point, *place)) *place = point;
  }
  std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), is_nearer);
  return static_cast<int>(count);
}

double NearSurface::relative_motion_m(const Vec3& carried_m) const noexcept {
  double largest_m2 = 0.0;
  for (int i = 0; i < candidate_count_; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      largest_m2 =
          std::max(largest_m2, (surface_->corner_motion_m(candidates_[at(i)], corner) - carried_m).squaredNorm());
    }
  }
  return std::sqrt(largest_m2);
}

}  // namespace myotact::haptics
