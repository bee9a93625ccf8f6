#include "simulation/follower/line_frames.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/at.h"
#include "simulation/line/line_model.h"
#include "simulation/line/line_segment.h"

namespace myotact::simulation {
namespace {

/// Stations no farther apart than this [m]: a third of what a slender belly is thick.
constexpr double kStationSpacing_m = 5e-3;
/// A longer line gets longer spacing: so many stations at most.
constexpr double kMostStations = 64.0;
/// How much a cross-section is made wider or narrower at most. A belly that shortens by half would be 1.41 times as
/// wide, and a broad sheet's border, far from its line, would sweep through its neighbours.
constexpr double kNarrowest = 0.8, kWidest = 1.25;

double smooth_step(double t) {
  return t * t * (3.0 - 2.0 * t);
}

bool on_body(const anatomy::LineWrap* wrap, int body) {
  return wrap == nullptr || wrap->body == body;
}

Vec3 place_on(const std::vector<Vec3>& points_m, int edge, double along) {
  return points_m[at(edge)] + along * (points_m[at(edge + 1)] - points_m[at(edge)]);
}

}  // namespace

LineFrames::LineFrames(const anatomy::MuscleLine& line, double window_m)
    : line_(line), rest_points_m_(line_points_L(line)) {
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i);
    const int from = line.points[i].body, to = line.points[i + 1].body;
    edge_segment_.insert(edge_segment_.end(), wrap == nullptr ? 1 : kWrapPoints + 1,
                         static_cast<int>(segments_.size()));
    segments_.push_back({from, to, from == to && on_body(wrap, from)});
  }
  lay_stations();
  open_windows(window_m);
}

/// Evenly spread over the whole length, whatever the distances of the line's own points.
void LineFrames::lay_stations() {
  const std::size_t edges = edge_segment_.size();
  std::vector<double> until_m{0.0};                                                // up to each point of the polyline
  std::vector<double> start_m(segments_.size()), length_m(segments_.size(), 0.0);  // of the segments
  for (std::size_t e = 0; e < edges; ++e) {
    const double edge_m = (rest_points_m_[e + 1] - rest_points_m_[e]).norm();
    if (e == 0 || edge_segment_[e] != edge_segment_[e - 1]) start_m[at(edge_segment_[e])] = until_m.back();
    length_m[at(edge_segment_[e])] += edge_m;
    until_m.push_back(until_m.back() + edge_m);
  }
  const double whole_m = until_m.back();
  const int parts = static_cast<int>(std::clamp(std::ceil(whole_m / kStationSpacing_m), 1.0, kMostStations));
  std::size_t e = 0;
  for (int part = 0; part <= parts; ++part) {
    const double arc_m = whole_m * part / parts;
    while (e + 1 < edges && arc_m > until_m[e + 1]) ++e;
    const double edge_m = until_m[e + 1] - until_m[e];
    const double along = edge_m > 0.0 ? std::clamp((arc_m - until_m[e]) / edge_m, 0.0, 1.0) : 0.0;
    const std::size_t segment = at(edge_segment_[e]);
    const double way = length_m[segment] > 0.0 ? (arc_m - start_m[segment]) / length_m[segment] : 0.0;
    stations_.push_back({static_cast<int>(e), along, edge_segment_[e], std::clamp(way, 0.0, 1.0), arc_m,
                         place_on(rest_points_m_, static_cast<int>(e), along)});
  }
}

void LineFrames::open_windows(double window_m) {
  const std::size_t last = stations_.size() - 1;
  std::vector<double> chords_m(stations_.size(), 0.0);  // corners of the line cut off, as in every other pose
  for (std::size_t s = 1; s <= last; ++s) {
    chords_m[s] = chords_m[s - 1] + (stations_[s].rest_m - stations_[s - 1].rest_m).norm();
  }
  for (std::size_t s = 0; s <= last; ++s) {
    Station& station = stations_[s];
    station.before = s > 0 ? s - 1 : 0;
    station.after = std::min(last, s + 1);
    while (station.before > 0 && station.arc_m - stations_[station.before].arc_m < window_m) --station.before;
    while (station.after < last && stations_[station.after].arc_m - station.arc_m < window_m) ++station.after;
    const Vec3 way = stations_[station.after].rest_m - stations_[station.before].rest_m;
    if (way.squaredNorm() > 0.0) station.tangent = way.normalized();
    station.window_m = chords_m[station.after] - chords_m[station.before];
  }
}

double LineFrames::nearest_arc_m(const Vec3& rest_m) const {
  std::vector<double> fractions = arc_fractions(rest_points_m_);
  return length_m() * nearest_place(rest_points_m_, fractions, rest_m).fraction;
}

Mat3 LineFrames::rotation_at(const Station& station, const Vec3& tangent, const Skeleton& skeleton) const {
  const Segment& segment = segments_[at(station.segment)];
  const Mat3& from = skeleton.body_pose(segment.from_body).rotation;
  Mat3 carried = from;
  if (segment.to_body != segment.from_body) {
    const Eigen::Quaterniond start(from), end(skeleton.body_pose(segment.to_body).rotation);
    carried = start.slerp(smooth_step(station.way), end).toRotationMatrix();
  }
  const Vec3 carried_tangent = carried * station.tangent;
  return Eigen::Quaterniond::FromTwoVectors(carried_tangent, tangent).toRotationMatrix() * carried;
}

void LineFrames::follow(const Skeleton& skeleton, std::vector<Affine>& maps) const {
  const std::vector<Vec3> points_m = line_points_W(line_, skeleton);
  std::vector<Vec3> places_m(stations_.size());
  std::vector<double> arc_m(stations_.size(), 0.0);
  for (std::size_t s = 0; s < stations_.size(); ++s) {
    places_m[s] = place_on(points_m, stations_[s].edge, stations_[s].along);
    if (s > 0) arc_m[s] = arc_m[s - 1] + (places_m[s] - places_m[s - 1]).norm();
  }
  maps.resize(stations_.size());
  for (std::size_t s = 0; s < stations_.size(); ++s) {
    const Station& station = stations_[s];
    const Segment& segment = segments_[at(station.segment)];
    const bool within = segment.rigid && segments_[at(stations_[station.before].segment)].rigid &&
                        segments_[at(stations_[station.after].segment)].rigid &&
                        segments_[at(stations_[station.before].segment)].to_body == segment.from_body &&
                        segments_[at(stations_[station.after].segment)].from_body == segment.to_body;
    if (within) {
      const Pose& pose = skeleton.body_pose(segment.from_body);
      maps[s] = {pose.rotation, pose.translation_m};
      continue;
    }
    const Vec3 way = places_m[station.after] - places_m[station.before];
    const double now_m = arc_m[station.after] - arc_m[station.before];
    const bool turns = way.norm() > 1e-6 && station.window_m > 0.0;
    const Vec3 tangent = turns ? Vec3(way.normalized()) : station.tangent;
    const Mat3 rotation =
        turns ? rotation_at(station, tangent, skeleton) : skeleton.body_pose(segment.from_body).rotation;
    const double wide =
        turns ? std::clamp(std::sqrt(station.window_m / std::max(now_m, 1e-6)), kNarrowest, kWidest) : 1.0;
    maps[s].linear =
        rotation * (wide * Mat3::Identity() + (1.0 - wide) * station.tangent * station.tangent.transpose());
    maps[s].offset_m = places_m[s] - maps[s].linear * station.rest_m;
  }
  round_off(maps);
}

/// Each map becomes the mean of those in its window, nearer ones counting more: a kink of the line, which holds at a
/// via point what in nature slides there, becomes a bend that the tissue about it can follow.
void LineFrames::round_off(std::vector<Affine>& maps) const {
  const std::vector<Affine> sharp = maps;
  for (std::size_t s = 0; s < maps.size(); ++s) {
    const Station& station = stations_[s];
    Affine sum{Mat3::Zero(), Vec3::Zero()};
    double weights = 0.0;
    for (std::size_t k = station.before; k <= station.after; ++k) {
      const double reach = static_cast<double>(k < s ? s - station.before : station.after - s) + 1.0;
      const double weight = 1.0 - static_cast<double>(k < s ? s - k : k - s) / reach;
      sum.linear += weight * sharp[k].linear;
      sum.offset_m += weight * sharp[k].offset_m;
      weights += weight;
    }
    maps[s] = {sum.linear / weights, sum.offset_m / weights};
  }
}

}  // namespace myotact::simulation
