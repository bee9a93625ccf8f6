#include "prepare/guess/muscle_ends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/at.h"

namespace myotact::prepare {

namespace {

/// A muscle lies on bone where it is no farther from it [m]: the canine set's attachments do, and two voxels of a CT
/// are as wide.
constexpr double kReach_m = 2e-3;
/// An end farther from its bone than this is not led to it [m]; the attach stage refuses 30 mm.
constexpr double kHangs_m = 0.025;

/// One end as found: on a bone, or at a tip.
struct End {
  int bone = -1;  // that it lies on or is nearest to
  Vec3 point_m = Vec3::Zero();
  double area_m2 = 0.0;
  double gap_m = 0.0;  // to that bone
};

class EndFinder {
 public:
  EndFinder(const LooseMuscle& muscle, const EndBones& bones)
      : surface_(muscle.surface.surface), axis_(muscle.axis), bones_(bones) {}

  /// Origin first.
  std::array<End, 2> find() const {
    const auto contacts = find_contacts(surface_, axis_, bones_.distances, kReach_m);
    const ContactPair pair = choose_ends(contacts, surface_, axis_);
    const auto on_bone = [&](int c) {
      return End{contacts[at(c)].bone, contacts[at(c)].centre_m, contacts[at(c)].area_m2, 0.0};
    };
    std::array<End, 2> ends = {at_tip(0), at_tip(1)};
    if (pair.second >= 0) {
      ends = {on_bone(pair.first), on_bone(pair.second)};
    } else if (pair.first >= 0) {
      const End known = on_bone(pair.first);
      const bool low = (known.point_m - axis_.tips_m[0]).norm() < (known.point_m - axis_.tips_m[1]).norm();
      ends = {known, ends[low ? 1 : 0]};
    }
    if (is_proximal(ends[1], ends[0])) std::swap(ends[0], ends[1]);
    return ends;
  }

  /// A marked place: on the bone that is nearest.
  End at_place(const Vec3& point_m) const {
    End end{-1, point_m, 0.0, std::numeric_limits<double>::infinity()};
    for (int b = 0; b < static_cast<int>(bones_.bones.size()); ++b) {
      Vec3 place_m;
      const double gap_m = bones_.distances[at(b)].nearest_m(point_m, place_m);
      if (gap_m < end.gap_m) end.gap_m = gap_m, end.bone = b;
    }
    return end;
  }

  bool is_proximal(const End& a, const End& b) const {
    const auto steps = [&](const End& end) { return end.bone < 0 ? 0 : bones_.skeleton.steps_from_root[at(end.bone)]; };
    if (steps(a) != steps(b)) return steps(a) < steps(b);
    if (bones_.bones.empty()) return a.point_m.z() > b.point_m.z();  // limbs hang down
    return (a.point_m - bones_.skeleton.root_m).norm() < (b.point_m - bones_.skeleton.root_m).norm();
  }

 private:
  /// The place of the surface that is nearest to the tip.
  End at_tip(std::size_t tip) const {
    Vec3 point_m = axis_.tips_m[tip];
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Vec3& p : surface_.positions_m) {
      const double distance_m = (p - axis_.tips_m[tip]).norm();
      if (distance_m < nearest_m) nearest_m = distance_m, point_m = p;
    }
    return at_place(point_m);
  }

  const geometry::TriangleMesh& surface_;
  const LongAxis& axis_;
  const EndBones& bones_;
};

AttachmentSite site_of(const End& end, const EndBones& bones) {
  AttachmentSite site;
  site.point_m = end.point_m;
  site.area_m2 = end.area_m2;
  if (end.bone >= 0 && end.gap_m <= kHangs_m) {
    site.bones = {bones.bones[at(end.bone)].key};
  } else {
    site.body = std::max(0, end.bone);
  }
  return site;
}

Decision decision_on(const LooseMuscle& muscle, const char* which, const End& end, const EndBones& bones) {
  const std::string& bone = bones.bones[at(end.bone)].key;
  std::string text = fmt::format("{} taken on {}, where its surface lies on it", which, bone);
  if (end.gap_m > kReach_m) {
    text = fmt::format(
        "its {} touches no bone: the nearest, {}, is {:.1f} mm away, and it {}. Mark the place (a point "
        "named \"{} {}\"), name the bone in the recipe, or segment the tendon",
        which, bone, 1e3 * end.gap_m, end.gap_m <= kHangs_m ? "was led there" : "moves with it and hangs in the air",
        which, muscle.surface.key);
  }
  return {"attachments", muscle.surface.key,           std::move(text),
          {bone},        muscle.pointer + "/" + which, end.gap_m <= kReach_m};
}

/// Points of a marked line, from origin to insertion, on the bodies of its ends, whichever bone is nearer.
std::vector<anatomy::LinePoint> line_of(std::vector<Vec3> points_m, const std::array<End, 2>& ends,
                                        const EndBones& bones) {
  const double as_drawn = (points_m.front() - ends[0].point_m).norm() + (points_m.back() - ends[1].point_m).norm();
  const double turned = (points_m.back() - ends[0].point_m).norm() + (points_m.front() - ends[1].point_m).norm();
  if (turned < as_drawn) std::reverse(points_m.begin(), points_m.end());
  const auto body_of = [](const End& end) { return std::max(0, end.bone); };
  std::vector<anatomy::LinePoint> line;
  for (const Vec3& p : points_m) {
    int body = body_of(ends[0]);
    Vec3 place_m;
    if (body != body_of(ends[1]) &&
        bones.distances[at(body_of(ends[1]))].nearest_m(p, place_m) < bones.distances[at(body)].nearest_m(p, place_m)) {
      body = body_of(ends[1]);
    }
    line.push_back({body, p, anatomy::LinePointKind::Via});
  }
  line.front() = {body_of(ends[0]), line.front().position_m, anatomy::LinePointKind::Origin};
  line.back() = {body_of(ends[1]), line.back().position_m, anatomy::LinePointKind::Insertion};
  return line;
}

}  // namespace

void guess_ends(const LooseMuscle& muscle, const EndBones& bones, MuscleData& data, std::vector<Decision>& decisions) {
  const EndFinder finder(muscle, bones);
  const MuscleMarks& marks = muscle.marks;
  std::array<End, 2> ends = finder.find();
  if (!marks.line_m.empty()) {
    ends = {finder.at_place(marks.line_m.front()), finder.at_place(marks.line_m.back())};
    if (finder.is_proximal(ends[1], ends[0])) std::swap(ends[0], ends[1]);
  }
  const std::array<const std::vector<Vec3>*, 2> marked = {&marks.origins_m, &marks.insertions_m};
  const std::array<std::vector<AttachmentSite>*, 2> sites = {&data.origins, &data.insertions};
  for (const std::size_t e : {0u, 1u}) {
    if (!marked[e]->empty()) ends[e] = finder.at_place(marked[e]->front());
    if (!bones.bones.empty()) decisions.push_back(decision_on(muscle, e == 0 ? "origin" : "insertion", ends[e], bones));
    sites[e]->push_back(site_of(ends[e], bones));
    for (std::size_t more = 1; more < marked[e]->size(); ++more) {
      sites[e]->push_back(site_of(finder.at_place((*marked[e])[more]), bones));
    }
  }
  if (bones.bones.empty()) {
    decisions.push_back({"attachments",
                         muscle.surface.key,
                         "there is no bone: both tips along its longest direction are held fast",
                         {},
                         muscle.pointer + "/origin"});
  }
  if (!marks.line_m.empty()) data.line = line_of(marks.line_m, ends, bones);
}

}  // namespace myotact::prepare
