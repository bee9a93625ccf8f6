#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "anatomy/find_line_defects.h"
#include "anatomy/find_wrap_defects.h"
#include "anatomy/hinge_chains.h"
#include "core/at.h"
#include "exchange/opensim_convert.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::exchange::opensim {
namespace {

using geometry::WrapShape;

/// A straight way and a surface, in the surface's frame: which side it passes, and how deep inside at most.
struct Passage {
  Vec3 towards = Vec3::Zero();  // from the centre or the axis to the way
  double depth = -1.0;          // 1 through the middle, 0 on the surface, negative outside
};

Passage passage_of(const WrapObject& wrap, const Vec3& p_m, const Vec3& q_m) {
  const bool cylinder = wrap.shape == WrapShape::Cylinder;
  const Vec3 scale(1.0 / wrap.radii_m.x(), 1.0 / wrap.radii_m.y(), cylinder ? 0.0 : 1.0 / wrap.radii_m.z());
  const Vec3 p = p_m.cwiseProduct(scale), q = q_m.cwiseProduct(scale), way = q - p;
  if (p.norm() <= 1.0 || q.norm() <= 1.0 || !(way.squaredNorm() > 0.0))
    return {};  // an end inside: OpenSim goes through
  const double share = std::clamp(-p.dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vec3 nearest = p + share * way;
  const double z_m = p_m.z() + share * (q_m.z() - p_m.z());
  if (cylinder && std::abs(z_m) > 0.5 * wrap.length_m) return {};
  return {nearest.cwiseQuotient(cylinder ? Vec3(scale.x(), scale.y(), 1.0) : scale), 1.0 - nearest.norm()};
}

/// A specimen's chains of hinges in poses that go through each joint's range by itself.
class Poses {
 public:
  explicit Poses(const anatomy::Specimen& specimen)
      : chains_(anatomy::with_hinge_chains(bodies_and_joints(specimen))), skeleton_(chains_) {}

  /// Calls visit(skeleton) in the file pose and along the range of every joint that moves one of the bodies against
  /// another.
  template <class Visit>
  void each(const std::vector<int>& bodies, Visit&& visit) {
    constexpr int kSteps = 12;
    std::vector<double> q(chains_.joints.size(), 0.0);
    skeleton_.set_pose(q);
    visit(skeleton_);
    for (std::size_t j = 0; j < q.size(); ++j) {
      const int joint = static_cast<int>(j);
      const bool first = skeleton_.is_distal(bodies.front(), joint);
      if (std::all_of(bodies.begin(), bodies.end(), [&](int b) { return skeleton_.is_distal(b, joint) == first; }))
        continue;
      const auto& [lowest, highest] = chains_.joints[j].range_rad[0];
      for (int step = 0; step <= kSteps; ++step) {
        q[j] = lowest + (highest - lowest) * step / kSteps;
        skeleton_.set_pose(q);
        visit(skeleton_);
      }
      q[j] = 0.0;
    }
  }

 private:
  static anatomy::Specimen bodies_and_joints(const anatomy::Specimen& specimen) {
    anatomy::Specimen bare;
    bare.bodies = specimen.bodies;
    bare.joints = specimen.joints;
    return bare;
  }

  anatomy::Specimen chains_;
  simulation::Skeleton skeleton_;
};

/// What a path wrap does on one segment of the line, over all poses.
struct Candidate {
  int after = -1;
  double depth = 0.0;  // largest
  double sum = 0.0;    // of the depths
  Vec3 side = Vec3::Zero();
};

struct Search {
  const WrapObject& wrap;
  Pose X_WL;  // from the specimen to the surface's frame at the file pose
  int first, last;
};

Candidate deepest(const Search& search, const anatomy::MuscleLine& line, const anatomy::Specimen& specimen) {
  std::vector<Candidate> candidates;
  for (int i = search.first; i < search.last; ++i) candidates.push_back({i, 0.0, 0.0, Vec3::Zero()});
  std::vector<int> bodies = {search.wrap.body};
  for (int i = search.first; i <= search.last; ++i) bodies.push_back(line.points[at(i)].body);
  Poses(specimen).each(bodies, [&](const simulation::Skeleton& skeleton) {
    const Pose X_WW = search.X_WL * skeleton.body_pose(search.wrap.body).inverse();
    const auto place = [&](int i) {
      return X_WW * (skeleton.body_pose(line.points[at(i)].body) * line.points[at(i)].position_m);
    };
    for (Candidate& candidate : candidates) {
      const Passage passage = passage_of(search.wrap, place(candidate.after), place(candidate.after + 1));
      if (!(passage.depth > 0.0)) continue;
      candidate.depth = std::max(candidate.depth, passage.depth);
      candidate.sum += passage.depth;
      if (passage.towards.norm() > 0.0) candidate.side += (1.0 - passage.depth) * passage.towards.normalized();
    }
  });
  const auto best = std::max_element(candidates.begin(), candidates.end(),
                                     [](const Candidate& a, const Candidate& b) { return a.sum < b.sum; });
  return best == candidates.end() ? Candidate{} : *best;
}

/// The wrap as a line has it; X_LW is the surface's pose in the specimen.
anatomy::LineWrap made_wrap(const WrapObject& wrap, const Pose& X_LW, const Candidate& candidate) {
  anatomy::LineWrap made;
  made.body = wrap.body;
  made.after = candidate.after;
  made.shape = wrap.shape;
  made.centre_m = X_LW.translation_m;
  made.axes = X_LW.rotation.transpose();
  made.radii_m = wrap.radii_m;
  Vec3 side = wrap.quadrant.norm() > 0.0 ? wrap.quadrant : candidate.side;
  if (wrap.shape == WrapShape::Cylinder) side.z() = 0.0;
  if (side.norm() > 0.0) made.side = X_LW.rotation * side.normalized();
  return made;
}

}  // namespace

void add_wraps(const RawModel& raw, const Muscle& muscle, const std::vector<int>& points, const Placed& placed,
               anatomy::MuscleLine& line) {
  const int count = static_cast<int>(points.size());
  for (const PathWrap& path_wrap : muscle.wraps) {
    const WrapObject& wrap = raw.wraps[at(path_wrap.object)];
    const auto in_line = [&](int point) { return std::max(0, points[at(std::clamp(point, 0, count - 1))]); };
    const int first = in_line(path_wrap.first),
              last = path_wrap.last < 0 ? in_line(count - 1) : in_line(path_wrap.last);
    if (!(wrap.radii_m.minCoeff() > 0.0)) {
      throw wrap.element.error("its radii must be greater than 0");
    }
    const Pose X_LW = placed.X_LB[at(wrap.body)] * wrap.X_BW;
    Candidate best = deepest({wrap, X_LW.inverse(), first, last}, line, placed.specimen);
    // One segment and one side leave nothing to find out: it may act where several joints move at once.
    const bool certain = last == first + 1 && wrap.quadrant.norm() > 0.0;
    if (certain) best.after = first;
    if (!(best.sum > 0.0) && !certain) {
      path_wrap.element.tell(
          fmt::format("left out of {}: over the joints' ranges its path never meets {}", muscle.name, wrap.name));
      continue;
    }
    line.wraps.push_back(made_wrap(wrap, X_LW, best));
    const auto defects = anatomy::find_wrap_defects(line, "");
    if (defects.empty()) continue;
    line.wraps.pop_back();
    path_wrap.element.tell(
        fmt::format("left out of {}: {}", muscle.name, defects.front().substr(defects.front().find("wrap"))));
  }
}

}  // namespace myotact::exchange::opensim
