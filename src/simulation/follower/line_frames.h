#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// Rest position -> where it is now: p = linear x + offset. World frame.
struct Affine {
  Mat3 linear = Mat3::Identity();
  Vec3 offset_m = Vec3::Zero();

  Vec3 operator*(const Vec3& x_m) const { return linear * x_m + offset_m; }
};

/// How the tissue about a muscle's line moves with the bones: stations along the line, each with the map of the
/// cross-section through it.
///
///   rest  o----s----s----s----o        now   o---s      s at the same share of its segment's length,
///         origin          insertion              \ s    turned with the line, wider where it is shorter
///                                                  s---o
///
/// Between points of one body the maps are that body's pose exactly. Between points of two bodies the section turns
/// from the one's rotation to the other's (twist by a smooth step of the way along) and then with the line's own
/// tangent, taken over a window so that a kink at a via point becomes a bend; across the line it is scaled by the root
/// of rest length over length, which keeps its volume. At the end the maps themselves are rounded off over the window.
class LineFrames {
 public:
  /// At the file pose. `window_m` > 0: length along the line over which tangent and stretch are taken to either side.
  LineFrames(const anatomy::MuscleLine& line, double window_m);

  std::size_t size() const { return stations_.size(); }  // >= 2
  /// Where the station lies along the rest line [m], rising from 0.
  double arc_m(std::size_t station) const { return stations_[station].arc_m; }
  double length_m() const { return stations_.back().arc_m; }
  /// Along the rest line, of the place nearest to a rest position [m].
  double nearest_arc_m(const Vec3& rest_m) const;

  /// All maps in the skeleton's pose, one a station.
  void follow(const Skeleton& skeleton, std::vector<Affine>& maps) const;

 private:
  struct Segment {
    int from_body = -1, to_body = -1;
    bool rigid = false;  // its points and its surface ride on one body
  };
  struct Station {
    int edge = 0;        // of the polyline: between its points edge and edge + 1
    double along = 0.0;  // 0 .. 1 within it
    int segment = 0;     // of the line, between two of its points
    double way = 0.0;    // 0 .. 1 within the segment, by rest length
    double arc_m = 0.0;  // from the origin, at rest
    Vec3 rest_m = Vec3::Zero();
    Vec3 tangent = Vec3::UnitX();       // at rest, over the window
    std::size_t before = 0, after = 0;  // stations at the window's ends
    double window_m = 0.0;              // from the one to the other at rest, station by station
  };
  void lay_stations();
  void open_windows(double window_m);
  void round_off(std::vector<Affine>& maps) const;
  Mat3 rotation_at(const Station& station, const Vec3& tangent, const Skeleton& skeleton) const;

  anatomy::MuscleLine line_;
  std::vector<Segment> segments_;
  std::vector<int> edge_segment_;  // of each edge of the polyline
  std::vector<Vec3> rest_points_m_;
  std::vector<Station> stations_;
};

}  // namespace myotact::simulation
