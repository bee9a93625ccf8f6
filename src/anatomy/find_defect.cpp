#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "anatomy/farthest.h"
#include "anatomy/find_line_defects.h"
#include "anatomy/mechanics_defects.h"
#include "anatomy/specimen.h"
#include "core/text.h"

namespace myotact::anatomy {

namespace {

/// The middle of a scanned muscle may run through a bone where the surfaces overlap: by 5.1 mm in the canine set (the
/// deep digital flexor in the tibia). A muscle whose bones are one body in this specimen is only a shape.
constexpr LineRules kScannedLine{.deepest_via_m = 6e-3, .crosses_joint = false};

using Defects = std::vector<std::string>;

void add(Defects& defects, std::string defect) {
  if (!defect.empty()) defects.push_back(std::move(defect));
}

bool is_index(int index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

/// Keys become names of files and of columns.
std::string defect_of_key(const std::string& kind, const std::string& key) {
  const bool plain = std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
  });
  constexpr std::size_t kLongestKey = 100;
  if (plain && !key.empty() && key.front() != '.' && key.size() <= kLongestKey) return "";
  return fmt::format("{} \"{}\": a key must be 1 to {} of a-z, 0-9, _ and ., and not begin with a point", kind,
                     key.substr(0, kLongestKey), kLongestKey);
}

void find_key_defects(const Specimen& specimen, Defects& defects) {
  for (const Body& body : specimen.bodies) add(defects, defect_of_key("body", body.key));
  for (const Bone& bone : specimen.bones) add(defects, defect_of_key("bone", bone.key));
  for (const Joint& joint : specimen.joints) add(defects, defect_of_key("joint", joint.key));
  for (const Muscle& muscle : specimen.muscles) add(defects, defect_of_key("muscle", muscle.key));
}

/// References between the parts; the other checks rely on them.
void find_reference_defects(const Specimen& specimen, Defects& defects) {
  const std::size_t bodies = specimen.bodies.size();
  for (const Bone& bone : specimen.bones) {
    if (is_index(bone.body, bodies)) continue;
    defects.push_back(fmt::format("bone {}: its body is {}; there are {}", bone.key, bone.body, bodies));
  }
  for (const Joint& joint : specimen.joints) {
    if (is_index(joint.parent, bodies) && is_index(joint.child, bodies)) continue;
    defects.push_back(
        fmt::format("joint {}: its bodies are {} and {}; there are {}", joint.key, joint.parent, joint.child, bodies));
  }
  const auto is_muscle = [&](int m) { return is_index(m, specimen.muscles.size()); };
  for (const MuscleLine& line : specimen.lines) {
    if (!is_muscle(line.muscle)) {
      defects.push_back(fmt::format("a line names muscle {}; there are {}", line.muscle, specimen.muscles.size()));
    }
    for (const LinePoint& point : line.points) {
      if (is_index(point.body, bodies)) continue;
      defects.push_back(fmt::format("a line names body {}; there are {}", point.body, bodies));
    }
    for (const LineWrap& wrap : line.wraps) {
      if (is_index(wrap.body, bodies)) continue;
      defects.push_back(fmt::format("a wrap of a line names body {}; there are {}", wrap.body, bodies));
    }
  }
  for (const MuscleGroup& group : specimen.groups) {
    const bool known = is_index(group.joint, specimen.joints.size()) &&
                       std::all_of(group.flexors.begin(), group.flexors.end(), is_muscle) &&
                       std::all_of(group.extensors.begin(), group.extensors.end(), is_muscle);
    if (!known) defects.push_back("a group names a joint or a muscle that is not there");
  }
}

std::string defect_of_body(const Body& body) {
  if (!(body.mass_kg > 0.0 && body.mass_kg <= 1e3)) {
    return fmt::format("body {}: mass_kg is {}; must be > 0 and at most 1000", body.key, to_text(body.mass_kg));
  }
  if (!is_near(body.com_m)) return fmt::format("body {}: com_m must lie within 10 m; are the units metres?", body.key);
  const auto& [xx, yy, zz, xy, xz, yz] = body.inertia_kg_m2;
  Mat3 inertia;
  inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const bool positive = inertia.allFinite() && xx > 0.0 && xx * yy - xy * xy > 0.0 && inertia.determinant() > 0.0;
  return positive ? ""
                  : fmt::format("body {}: inertia_kg_m2 must be positive definite, in the order xx yy zz xy xz yz",
                                body.key);
}

std::size_t axis_count(JointType type) {
  switch (type) {
    case JointType::Weld:
      return 0;
    case JointType::Hinge:
      return 1;
    case JointType::Universal:
      return 2;
    case JointType::Ball:
      return 3;
  }
  return 0;
}

std::string defect_of_joint(const Joint& joint) {
  if (joint.parent == joint.child) return fmt::format("joint {}: parent and child are the same body", joint.key);
  if (!is_near(joint.centre_m)) {
    return fmt::format("joint {}: centre_m must lie within 10 m; are the units metres?", joint.key);
  }
  const std::size_t wanted = axis_count(joint.type);
  if (joint.axes.size() != wanted || joint.range_rad.size() != wanted) {
    return fmt::format("joint {}: has {} axes and {} ranges; its type needs {} of each", joint.key, joint.axes.size(),
                       joint.range_rad.size(), wanted);
  }
  for (const Vec3& axis : joint.axes) {
    if (!(std::abs(axis.norm() - 1.0) <= 1e-6)) return fmt::format("joint {}: an axis is not of length 1", joint.key);
  }
  for (const auto& [lowest, highest] : joint.range_rad) {
    if (!(lowest < highest)) return fmt::format("joint {}: range_rad must rise", joint.key);
  }
  return "";
}

void find_skeleton_defects(const Specimen& specimen, Defects& defects) {
  if (specimen.bodies.empty()) defects.push_back("bodies: is empty; a specimen needs at least one body");
  for (const Body& body : specimen.bodies) add(defects, defect_of_body(body));
  for (const Joint& joint : specimen.joints) add(defects, defect_of_joint(joint));
}

void find_mechanics_defects(const Muscle& muscle, Defects& defects) {
  struct Bound {
    const char* name;
    double value, lowest, highest;
  };
  constexpr double kHalfPi = 1.5707963267948966;
  for (const Bound& b :
       {Bound{"peak_force_N", muscle.peak_force_N, 1e-3, 1e5},
        Bound{"optimal_fibre_m", muscle.optimal_fibre_m, 1e-4, 1.0},
        Bound{"pennation_rad", muscle.pennation_rad, 0.0, 0.9 * kHalfPi},
        Bound{"rest_stretch", muscle.rest_stretch, 0.3, 1.8}, Bound{"tendon_slack_m", muscle.tendon_slack_m, 0.0, 1.0},
        Bound{"activation_tau_s", muscle.activation_tau_s, 1e-3, 1.0},
        Bound{"deactivation_tau_s", muscle.deactivation_tau_s, 1e-3, 1.0}}) {
    if (!(b.value >= b.lowest && b.value <= b.highest)) {
      defects.push_back(fmt::format("muscle {}: {} is {}; must be between {} and {}", muscle.key, b.name,
                                    to_text(b.value), to_text(b.lowest), to_text(b.highest)));
    }
  }
  // Fibres of constant width cannot be shorter than it.
  if (const double width = std::sin(muscle.pennation_rad); muscle.rest_stretch <= width) {
    defects.push_back(fmt::format("muscle {}: rest_stretch is {}; must be above {}, the sine of its pennation_rad {}",
                                  muscle.key, to_text(muscle.rest_stretch), to_text(width),
                                  to_text(muscle.pennation_rad)));
  }
}

/// Largest distance of a mid-side node from the middle of its edge, over the edge's length. At a quarter the element's
/// map folds at the corner (the quarter-point element of fracture mechanics).
constexpr double kMostMidsideOffset = 0.24;

std::string defect_of_midsides(const Muscle& muscle, std::size_t t) {
  const auto node = [&](int n) -> const Vec3& { return muscle.tets.nodes_m[static_cast<std::size_t>(n)]; };
  for (std::size_t e = 0; e < geometry::kTetEdges.size(); ++e) {
    const Vec3& a = node(muscle.tets.corners[t][static_cast<std::size_t>(geometry::kTetEdges[e][0])]);
    const Vec3& b = node(muscle.tets.corners[t][static_cast<std::size_t>(geometry::kTetEdges[e][1])]);
    const Vec3 offset = node(muscle.tets.midsides[t][e]) - 0.5 * (a + b);
    if (!(offset.norm() <= kMostMidsideOffset * (b - a).norm())) {
      return fmt::format(
          "muscle {}: tet {}: the node in the middle of edge {} is not there; the order is VTK's: edges "
          "01 12 02 03 13 23",
          muscle.key, t, e);
    }
  }
  return "";
}

/// Every node belongs to a tet, lies within reach, and the muscle hangs on something.
void find_node_defects(const Muscle& muscle, std::size_t body_count, Defects& defects) {
  const auto& tets = muscle.tets;
  std::vector<bool> used(tets.nodes_m.size(), false);
  for (const auto& tet : tets.corners) {
    for (const int n : tet) used[static_cast<std::size_t>(n)] = true;
  }
  for (const auto& tet : tets.midsides) {
    for (const int n : tet) used[static_cast<std::size_t>(n)] = true;
  }
  bool attached = false;
  for (std::size_t n = 0; n < tets.nodes_m.size(); ++n) {
    if (!used[n]) defects.push_back(fmt::format("muscle {}: node {} belongs to no tet; remove it", muscle.key, n));
    if (!is_near(tets.nodes_m[n])) {
      defects.push_back(fmt::format("muscle {}: node {} must lie within 10 m; are the units metres?", muscle.key, n));
    }
    if (muscle.attachments[n] < -1 || muscle.attachments[n] >= static_cast<int>(body_count)) {
      defects.push_back(fmt::format("muscle {}: node {} is attached to body {}; must be -1 .. {}", muscle.key, n,
                                    muscle.attachments[n], static_cast<int>(body_count) - 1));
    }
    attached |= muscle.attachments[n] >= 0;
  }
  if (!attached) {
    defects.push_back(fmt::format("muscle {}: no node is attached to a body; it would float away", muscle.key));
  }
}

std::string defect_of_tet(const Muscle& muscle, std::size_t t) {
  const double volume = geometry::corner_volume_m3(muscle.tets, t);
  if (!(volume > 0.0)) {
    return fmt::format("muscle {}: tet {} has volume {} m^3; must be > 0. Run myotact-prepare on the surface again",
                       muscle.key, t, to_text(volume));
  }
  if (muscle.tets.quadratic()) {
    if (auto defect = defect_of_midsides(muscle, t); !defect.empty()) return defect;
  }
  if (!(std::abs(muscle.fibres[t].norm() - 1.0) <= 1e-6)) {
    return fmt::format("muscle {}: the fibre of tet {} is not of length 1", muscle.key, t);
  }
  if (!muscle.sections_m2.empty() && !(muscle.sections_m2[t] > 0.0 && muscle.sections_m2[t] < 1.0)) {
    return fmt::format("muscle {}: the section of tet {} is {} m^2; must be > 0 and < 1", muscle.key, t,
                       to_text(muscle.sections_m2[t]));
  }
  return "";
}

void find_tet_defects(const Muscle& muscle, std::size_t body_count, Defects& defects) {
  const auto& tets = muscle.tets;
  if (tets.corners.empty()) return add(defects, fmt::format("muscle {}: has no tets", muscle.key));
  if (muscle.fibres.size() != tets.corners.size() || muscle.regions.size() != tets.corners.size() ||
      (!muscle.sections_m2.empty() && muscle.sections_m2.size() != tets.corners.size())) {
    return add(defects, fmt::format("muscle {}: must have one fibre, region and section a tet", muscle.key));
  }
  if (muscle.attachments.size() != tets.nodes_m.size()) {
    return add(defects, fmt::format("muscle {}: must have one attachment a node", muscle.key));
  }
  for (std::size_t t = 0; t < tets.corners.size(); ++t) add(defects, defect_of_tet(muscle, t));
  find_node_defects(muscle, body_count, defects);
}

std::string defect_of_surface(const std::string& what, const geometry::TriangleMesh& surface) {
  const int bad = geometry::bad_edge_count(surface);
  if (surface.triangles.empty()) return what + ": has no triangles";
  if (!std::all_of(surface.positions_m.begin(), surface.positions_m.end(), is_near)) {
    return what + ": a vertex lies beyond 10 m; are the units metres?";
  }
  return bad == 0 ? "" : fmt::format("{}: is not closed ({} bad edges); close it and prepare it again", what, bad);
}

void find_all_line_defects(const Specimen& specimen, Defects& defects) {
  std::vector<int> lines_of_muscle(specimen.muscles.size(), 0);
  for (const MuscleLine& line : specimen.lines) {
    for (std::string& wrong : find_line_defects(line, specimen, kScannedLine)) defects.push_back(std::move(wrong));
    ++lines_of_muscle[static_cast<std::size_t>(line.muscle)];
  }
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    if (lines_of_muscle[m] == 1) continue;
    defects.push_back(
        fmt::format("muscle {}: has {} lines; must have one", specimen.muscles[m].key, lines_of_muscle[m]));
  }
}

}  // namespace

std::vector<std::string> find_mechanics_defects(const Muscle& muscle) {
  std::vector<std::string> defects;
  find_mechanics_defects(muscle, defects);
  return defects;
}

std::vector<std::string> find_defects(const Muscle& muscle, std::size_t body_count) {
  Defects defects;
  find_mechanics_defects(muscle, defects);
  find_tet_defects(muscle, body_count, defects);
  add(defects, defect_of_surface("skin of " + muscle.key, muscle.skin));
  return defects;
}

std::vector<std::string> find_defects(const Specimen& specimen) {
  Defects defects;
  find_key_defects(specimen, defects);
  find_reference_defects(specimen, defects);
  if (!defects.empty()) return defects;
  find_skeleton_defects(specimen, defects);
  for (const Bone& bone : specimen.bones) add(defects, defect_of_surface("bone " + bone.key, bone.surface));
  for (const Muscle& muscle : specimen.muscles) {
    const Defects found = find_defects(muscle, specimen.bodies.size());
    defects.insert(defects.end(), found.begin(), found.end());
  }
  find_all_line_defects(specimen, defects);
  return defects;
}

std::string find_defect(const Specimen& specimen) {
  const Defects defects = find_defects(specimen);
  return defects.empty() ? "" : defects.front();
}

}  // namespace myotact::anatomy
