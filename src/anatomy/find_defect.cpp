#include <cmath>

#include <fmt/format.h>

#include "anatomy/specimen.h"
#include "core/text.h"

namespace myotact::anatomy {

namespace {

std::string defect_of_skeleton(const Specimen& specimen) {
  if (specimen.bodies.empty()) return "bodies: is empty; a specimen needs at least one body";
  for (const Body& body : specimen.bodies) {
    if (!(body.mass_kg > 0.0)) return fmt::format("body {}: mass_kg is {}; must be > 0", body.key, to_text(body.mass_kg));
  }
  for (const Joint& joint : specimen.joints) {
    if (joint.parent == joint.child) return fmt::format("joint {}: parent and child are the same body", joint.key);
    const std::size_t wanted = static_cast<std::size_t>(joint.type == JointType::Weld        ? 0
                                                        : joint.type == JointType::Hinge     ? 1
                                                        : joint.type == JointType::Universal ? 2
                                                                                             : 3);
    if (joint.axes.size() != wanted || joint.range_rad.size() != wanted) {
      return fmt::format("joint {}: has {} axes and {} ranges; its type needs {} of each", joint.key, joint.axes.size(),
                         joint.range_rad.size(), wanted);
    }
    for (const Vec3& axis : joint.axes) {
      if (std::abs(axis.norm() - 1.0) > 1e-6) return fmt::format("joint {}: an axis is not of length 1", joint.key);
    }
    for (const auto& [lowest, highest] : joint.range_rad) {
      if (!(lowest < highest)) return fmt::format("joint {}: range_rad must rise", joint.key);
    }
  }
  return "";
}

std::string defect_of_mechanics(const Muscle& muscle) {
  struct Bound {
    const char* name;
    double value, lowest, highest;
  };
  constexpr double kHalfPi = 1.5707963267948966;
  for (const Bound& b : {Bound{"peak_force_N", muscle.peak_force_N, 1e-3, 1e5},
                         Bound{"optimal_fibre_m", muscle.optimal_fibre_m, 1e-4, 1.0},
                         Bound{"pennation_rad", muscle.pennation_rad, 0.0, 0.9 * kHalfPi},
                         Bound{"rest_stretch", muscle.rest_stretch, 0.3, 1.8},
                         Bound{"tendon_slack_m", muscle.tendon_slack_m, 0.0, 1.0},
                         Bound{"activation_tau_s", muscle.activation_tau_s, 1e-3, 1.0},
                         Bound{"deactivation_tau_s", muscle.deactivation_tau_s, 1e-3, 1.0}}) {
    if (!(b.value >= b.lowest && b.value <= b.highest)) {
      return fmt::format("muscle {}: {} is {}; must be between {} and {}", muscle.key, b.name, to_text(b.value),
                         to_text(b.lowest), to_text(b.highest));
    }
  }
  return "";
}

std::string defect_of_tets(const Muscle& muscle, std::size_t body_count) {
  const auto& tets = muscle.tets;
  if (tets.corners.empty()) return fmt::format("muscle {}: has no tets", muscle.key);
  if (muscle.fibres.size() != tets.corners.size() || muscle.regions.size() != tets.corners.size() ||
      (!muscle.sections_m2.empty() && muscle.sections_m2.size() != tets.corners.size())) {
    return fmt::format("muscle {}: must have one fibre, region and section a tet", muscle.key);
  }
  if (muscle.attachments.size() != tets.nodes_m.size()) {
    return fmt::format("muscle {}: must have one attachment a node", muscle.key);
  }
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    const double volume = geometry::corner_volume_m3(tets, t);
    if (!(volume > 0.0)) {
      return fmt::format("muscle {}: tet {} has volume {} m^3; must be > 0. Run myotact-prepare on the surface again",
                         muscle.key, t, to_text(volume));
    }
    if (std::abs(muscle.fibres[t].norm() - 1.0) > 1e-6) {
      return fmt::format("muscle {}: the fibre of tet {} is not of length 1", muscle.key, t);
    }
    if (!muscle.sections_m2.empty() && !(muscle.sections_m2[t] > 0.0)) {
      return fmt::format("muscle {}: the section of tet {} must be > 0", muscle.key, t);
    }
  }
  bool attached = false;
  for (std::size_t n = 0; n < muscle.attachments.size(); ++n) {
    if (muscle.attachments[n] < -1 || muscle.attachments[n] >= static_cast<int>(body_count)) {
      return fmt::format("muscle {}: node {} is attached to body {}; must be -1 .. {}", muscle.key, n,
                         muscle.attachments[n], static_cast<int>(body_count) - 1);
    }
    attached |= muscle.attachments[n] >= 0;
  }
  return attached ? "" : fmt::format("muscle {}: no node is attached to a body; it would float away", muscle.key);
}

std::string defect_of_surface(const std::string& what, const geometry::TriangleMesh& surface) {
  const int bad = geometry::bad_edge_count(surface);
  if (surface.triangles.empty()) return what + ": has no triangles";
  return bad == 0 ? "" : fmt::format("{}: is not closed ({} bad edges); close it and prepare it again", what, bad);
}

std::string defect_of_lines(const Specimen& specimen) {
  std::vector<int> lines_of_muscle(specimen.muscles.size(), 0);
  for (const MuscleLine& line : specimen.lines) {
    const std::string& key = specimen.muscles[static_cast<std::size_t>(line.muscle)].key;
    if (line.points.size() < 2) return fmt::format("line of {}: needs at least two points", key);
    if (line.points.front().kind != LinePointKind::Origin || line.points.back().kind != LinePointKind::Insertion) {
      return fmt::format("line of {}: must begin with an origin and end with an insertion", key);
    }
    ++lines_of_muscle[static_cast<std::size_t>(line.muscle)];
  }
  for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
    if (lines_of_muscle[m] != 1) {
      return fmt::format("muscle {}: has {} lines; must have one", specimen.muscles[m].key, lines_of_muscle[m]);
    }
  }
  return "";
}

}  // namespace

std::string find_defect(const Specimen& specimen) {
  if (auto defect = defect_of_skeleton(specimen); !defect.empty()) return defect;
  for (const Bone& bone : specimen.bones) {
    if (auto defect = defect_of_surface("bone " + bone.key, bone.surface); !defect.empty()) return defect;
  }
  for (const Muscle& muscle : specimen.muscles) {
    if (auto defect = defect_of_mechanics(muscle); !defect.empty()) return defect;
    if (auto defect = defect_of_tets(muscle, specimen.bodies.size()); !defect.empty()) return defect;
    if (auto defect = defect_of_surface("skin of " + muscle.key, muscle.skin); !defect.empty()) return defect;
  }
  return defect_of_lines(specimen);
}

}  // namespace myotact::anatomy
