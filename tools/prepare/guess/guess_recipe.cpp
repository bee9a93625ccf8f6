#include "prepare/guess/guess_recipe.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "prepare/guess/muscle_ends.h"

namespace myotact::prepare {

namespace {

/// As assets/canine takes them where nothing was measured: 0.3 MPa, fibres half as long as the muscle, parallel, at
/// 0.8 of their optimum; time constants of Thelen 2003.
constexpr double kTension_Pa = 3e5;
constexpr double kFibreOfLength = 0.5;
constexpr double kRestStretch = 0.8;
constexpr double kFlesh_kg_m3 = 1060.0;
/// A hinge's group takes muscles with at least this moment arm [m]; nearer to the axis the side is chance.
constexpr double kLeastArm_m = 2e-3;

/// Open or inside-out surfaces have the volume that a spindle fills of its box instead.
double muscle_volume_m3(const geometry::TriangleMesh& surface) {
  constexpr double kFilled = 0.4;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : surface.positions_m) box.extend(p);
  const double boxed_m3 = box.isEmpty() ? 1e-9 : box.sizes().cwiseMax(1e-3).prod();
  const double enclosed_m3 = std::abs(geometry::enclosed_volume_m3(surface));
  return enclosed_m3 > 0.0 && enclosed_m3 < 1.001 * boxed_m3 ? enclosed_m3 : kFilled * boxed_m3;
}

/// What the rest relies on; how good the surface is else is for the repair to say.
void check_surface(const NamedSurface& part) {
  const int vertices = static_cast<int>(part.surface.positions_m.size());
  if (part.surface.triangles.empty()) {
    throw bad_data(part.key, "surface", "is empty: it has no triangles; export the surface again");
  }
  for (const auto& triangle : part.surface.triangles) {
    for (const int v : triangle) {
      if (v >= 0 && v < vertices) continue;
      throw bad_data(part.key, "surface",
                     fmt::format("names vertex {}; must be 0 .. {}. Export it again", v, vertices - 1));
    }
  }
  for (const Vec3& p : part.surface.positions_m) {
    if (!p.allFinite()) throw bad_data(part.key, "surface", "has a vertex that is not finite; export it again");
  }
}

const NamedPart* named(const std::string& key, const KnownParts& known) {
  const auto found = std::find_if(known.begin(), known.end(), [&](const NamedPart& part) { return part.key == key; });
  return found == known.end() ? nullptr : &*found;
}

anatomy::Muscle mechanics_of(const NamedSurface& muscle, double length_m, const KnownParts& known) {
  anatomy::Muscle m;
  const NamedPart* part = named(muscle.key, known);
  m.key = muscle.key;
  m.name_la = part ? part->name_la : spoken_name(muscle.key);
  m.name_en = part ? part->name_en : spoken_name(muscle.key);
  m.material = "muscle";
  m.optimal_fibre_m = std::clamp(kFibreOfLength * length_m, 1e-3, 0.5);
  m.peak_force_N = std::clamp(kTension_Pa * muscle_volume_m3(muscle.surface) / m.optimal_fibre_m, 0.1, 2e4);
  m.rest_stretch = kRestStretch;
  m.tendon_slack_m = std::clamp(length_m - kRestStretch * m.optimal_fibre_m, 0.0, 1.0);
  m.estimated = {"peak_force_N",   "optimal_fibre_m",  "pennation_rad",     "rest_stretch",
                 "tendon_slack_m", "activation_tau_s", "deactivation_tau_s"};
  m.sources = {"not measured: default. 0.3 MPa over volume / fibre length, fibres half as long as the muscle, parallel",
               "time constants: Thelen 2003 (10.1115/1.1531112)"};
  return m;
}

MuscleMarks marks_of(int muscle, const LimbMarks& marks) {
  MuscleMarks found;
  const auto take = [&](const std::vector<MarkedMuscle>& from, std::vector<Vec3>& to) {
    for (const MarkedMuscle& mark : from) {
      if (mark.muscle == muscle) to.insert(to.end(), mark.points_m.begin(), mark.points_m.end());
    }
  };
  take(marks.origins, found.origins_m);
  take(marks.insertions, found.insertions_m);
  for (const MarkedMuscle& line : marks.lines) {
    if (line.muscle == muscle) found.line_m = line.points_m;
  }
  return found;
}

template <class Surfaces>
std::vector<std::string> keys_of(const Surfaces& surfaces) {
  std::vector<std::string> keys;
  for (const NamedSurface& surface : surfaces) keys.push_back(surface.key);
  return keys;
}

int body_of(const AttachmentSite& site, const AnatomyData& anatomy) {
  if (site.body >= 0) return site.body;
  for (const BoneData& bone : anatomy.bones) {
    if (bone.key == site.bones.front()) return bone.body;
  }
  return 0;
}

/// The bodies that a joint moves: its child and all beyond.
std::vector<bool> moved_by(int joint, const AnatomyData& anatomy) {
  std::vector<bool> moved(anatomy.bodies.size(), false);
  moved[at(anatomy.joints[at(joint)].child)] = true;
  for (std::size_t turn = 0; turn < anatomy.bodies.size(); ++turn) {
    for (int j = 0; j < static_cast<int>(anatomy.joints.size()); ++j) {
      const anatomy::Joint& other = anatomy.joints[at(j)];
      if (j != joint && moved[at(other.parent)]) moved[at(other.child)] = true;
    }
  }
  return moved;
}

/// By the moment arm of the straight way from end to end; positive flexes.
GroupData group_of(int joint, const AnatomyData& anatomy) {
  GroupData group{joint, {}, {}};
  const anatomy::Joint& hinge = anatomy.joints[at(joint)];
  const std::vector<bool> moved = moved_by(joint, anatomy);
  for (const MuscleData& muscle : anatomy.muscles) {
    const AttachmentSite &origin = muscle.origins.front(), &insertion = muscle.insertions.front();
    const bool origin_moves = moved[at(body_of(origin, anatomy))];
    if (origin_moves == moved[at(body_of(insertion, anatomy))]) continue;
    const Vec3 moving_m = origin_moves ? origin.point_m : insertion.point_m;
    const Vec3 still_m = origin_moves ? insertion.point_m : origin.point_m;
    const Vec3 pull = (still_m - moving_m).normalized();
    const double arm_m = pull.dot(hinge.axes.front().cross(moving_m - hinge.centre_m));
    if (arm_m > kLeastArm_m) group.flexors.push_back(muscle.mechanics.key);
    if (arm_m < -kLeastArm_m) group.extensors.push_back(muscle.mechanics.key);
  }
  return group;
}

class Guesser {
 public:
  Guesser(const Strangers& strangers, const KnownParts& known) : strangers_(strangers), known_(known) {}

  GuessedRecipe guess() {
    if (strangers_.bones.empty() && strangers_.muscles.empty()) {
      throw bad_data(strangers_.name, "", "holds no surface; name a folder with one file a part, or files");
    }
    for (const auto* parts : {&strangers_.bones, &strangers_.muscles}) {
      for (const NamedSurface& part : *parts) check_surface(part);
    }
    AnatomyData& anatomy = result_.anatomy;
    anatomy.name = strangers_.name;
    anatomy.species = anatomy.breed = "not stated";
    anatomy.side = "left";
    anatomy.source = strangers_.source;
    anatomy.licence = "not stated";
    const LimbMarks marks =
        understand_markups(strangers_.markups, keys_of(strangers_.bones), keys_of(strangers_.muscles));
    add_bones(marks);
    for (int m = 0; m < static_cast<int>(strangers_.muscles.size()); ++m) add_muscle(m, marks);
    anatomy.bodies = skeleton_.bodies;
    anatomy.joints = skeleton_.joints;
    for (int j = 0; j < static_cast<int>(anatomy.joints.size()); ++j) {
      if (anatomy.joints[at(j)].type != anatomy::JointType::Hinge) continue;
      anatomy.groups.push_back(group_of(j, anatomy));
    }
    tell_of_mechanics();
    return std::move(result_);
  }

 private:
  void add_bones(const LimbMarks& marks) {
    const auto& bones = strangers_.bones;
    for (int b = 0; b < static_cast<int>(bones.size()); ++b) {
      const std::string& key = bones[at(b)].key;
      const NamedPart* part = named(key, known_);
      const std::string name = spoken_name(key);
      result_.anatomy.bones.push_back({key, part ? part->name_la : name, part ? part->name_en : name, b, "", {}});
      distances_.emplace_back(bones[at(b)].surface);
      tell_of_name(key, fmt::format("/bones/{}/key", b));
    }
    if (!bones.empty()) {
      skeleton_ = guess_skeleton(bones, marks.joints, result_.decisions);
      return;
    }
    if (!marks.joints.empty())
      throw bad_data("markups", "joint " + marks.joints.front().key, "joins bones; none is there");
    skeleton_.bodies = {stand_at(long_axis(strangers_.muscles.front().surface).tips_m[0])};
  }

  void add_muscle(int m, const LimbMarks& marks) {
    const NamedSurface& surface = strangers_.muscles[at(m)];
    const std::string pointer = fmt::format("/muscles/{}", m);
    const LongAxis axis = long_axis(surface.surface);
    MuscleData data;
    data.mechanics = mechanics_of(surface, axis.length_m(), known_);
    tell_of_name(surface.key, pointer + "/key");
    guess_ends({surface, axis, marks_of(m, marks), pointer}, {strangers_.bones, distances_, skeleton_}, data,
               result_.decisions);
    const double mass_kg = kFlesh_kg_m3 * muscle_volume_m3(surface.surface);
    for (const auto* sites : {&data.origins, &data.insertions}) {
      add_flesh(skeleton_.bodies[at(body_of(sites->front(), result_.anatomy))], 0.5 * mass_kg);
    }
    result_.anatomy.muscles.push_back(std::move(data));
  }

  void tell_of_name(const std::string& key, const std::string& pointer) {
    if (named(key, known_)) return;
    const std::vector<std::string> similar = similar_parts(key, known_);
    std::string text = "is no name that is known, and is kept";
    if (!similar.empty()) text += "; if it means " + join(similar, " or ") + ", change its key";
    result_.decisions.push_back({"names", key, std::move(text), similar, pointer});
  }

  void tell_of_mechanics() {
    if (strangers_.muscles.empty()) return;
    result_.decisions.push_back({"mechanics",
                                 "",
                                 "forces, fibre lengths and pennation of all muscles were not measured: defaults by "
                                 "volume and length. Put measured ones into the recipe",
                                 {},
                                 "/muscles"});
  }

  const Strangers& strangers_;
  const KnownParts& known_;
  GuessedRecipe result_;
  GuessedSkeleton skeleton_;
  std::vector<BoneDistance> distances_;
};

}  // namespace

GuessedRecipe guess_recipe(const Strangers& strangers, const KnownParts& known) {
  return Guesser(strangers, known).guess();
}

}  // namespace myotact::prepare
