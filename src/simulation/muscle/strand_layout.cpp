#include "simulation/muscle/strand_layout.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/at.h"
#include "simulation/line/line_model.h"
#include "simulation/line/line_segment.h"
#include "simulation/muscle/muscle_tissue.h"

namespace myotact::simulation {
namespace {

/// Tendon strands are this many times stiffer than the muscle at its stiffest: nearly rigid beside it, still soft
/// enough for the solve.
constexpr double kStrandOverMuscle = 10.0;
/// Largest active stiffness of a fibre in F0 / lo: the steepest slope of the force-length curve is below 4; over the
/// range that the joints use, about 2.
constexpr double kMuscleStiffness_F0_lo = 2.0;
/// Extension over which a strand becomes taut, in optimal fibre lengths; it then carries a tenth of F0.
constexpr double kToe_lo = 0.01;

/// A point of the line stays in the string while the belly's end keeps this far from it at every angle of the joints;
/// closer, the end could pass it and the string would fold back.
constexpr double kClearance_m = 0.005;
constexpr int kAngleSamples = 9;  // over the range of each joint

/// Arc length of the place on the rest line nearest to p [m].
double place_on_line_m(const std::vector<Vec3>& line_m, const Vec3& p) {
  double best_m = 0.0, nearest = 1e300, before_m = 0.0;
  for (std::size_t k = 0; k + 1 < line_m.size(); ++k) {
    const Vec3 step = line_m[k + 1] - line_m[k];
    const double share = std::clamp(step.dot(p - line_m[k]) / std::max(step.squaredNorm(), 1e-18), 0.0, 1.0);
    const double distance = (p - line_m[k] - share * step).norm();
    if (distance < nearest) {
      nearest = distance;
      best_m = before_m + share * step.norm();
    }
    before_m += step.norm();
  }
  return best_m;
}

/// Connected tendon tets, by the smallest tet of each group.
std::vector<int> tendon_groups(const MuscleTissue& tissue) {
  std::vector<int> owner(tissue.mesh.nodes_m.size());
  std::iota(owner.begin(), owner.end(), 0);
  const auto root = [&](int node) {
    while (owner[at(node)] != node) node = owner[at(node)] = owner[at(owner[at(node)])];
    return node;
  };
  for (const TissueElement& element : tissue.elements) {
    if (!element.sheath) continue;
    for (int node : element.nodes) owner[at(root(node))] = root(element.nodes[0]);
  }
  std::vector<int> group;
  for (const TissueElement& element : tissue.elements) group.push_back(element.sheath ? root(element.nodes[0]) : -1);
  return group;
}

Vec3 middle_of(const TissueElement& element, const MuscleTissue& tissue) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < 4; ++c) sum += tissue.mesh.nodes_m[at(element.nodes[c])];
  return sum / 4.0;
}

/// Mean place along the line of the tets for which `pick` holds.
template <class Pick>
double mean_place_m(const MuscleTissue& tissue, const std::vector<Vec3>& line_m, Pick&& pick) {
  double sum = 0.0, volume = 0.0;
  for (std::size_t t = 0; t < tissue.elements.size(); ++t) {
    if (!pick(t)) continue;
    const double v = tissue.elements[t].point_volume_m3();
    sum += v * place_on_line_m(line_m, middle_of(tissue.elements[t], tissue));
    volume += v;
  }
  return volume > 0.0 ? sum / volume : 0.0;
}

/// Slope of the shape function of node a along the fibre at a point [1/m].
double slope_along_fibre(const TissueElement& element, std::size_t point, std::size_t a) {
  double sum = 0.0;
  for (std::size_t m = 0; m < 4; ++m) {
    const Vector3<double>& g = element.shape.gradient_1_m[m];
    const Vector3<double>& fibre = element.shape.fibre;
    const double slope = element.nodes.size() == LinearTet::kNodes ? shape_slope<LinearTet>(a, m, point)
                                                                   : shape_slope<QuadraticTet>(a, m, point);
    sum += slope * (g[0] * fibre[0] + g[1] * fibre[1] + g[2] * fibre[2]);
  }
  return sum;
}

/// Force at each node along the fibres when every section of the belly carries 1 N.
std::vector<double> unit_pull(const MuscleTissue& tissue) {
  std::vector<double> pull(tissue.mesh.nodes_m.size(), 0.0);
  for (const TissueElement& element : tissue.elements) {
    if (element.sheath) continue;
    for (std::size_t p = 0; p < element.points(); ++p) {
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        pull[at(element.nodes[a])] += element.point_volume_m3() * slope_along_fibre(element, p, a) / element.section_m2;
      }
    }
  }
  return pull;
}

/// Border nodes and weights of one end. Empty when the tendon does not touch the belly with free nodes.
TendonStrand border(const MuscleTissue& tissue, const std::vector<char>& of_end, double sign) {
  std::vector<char> belly(tissue.body.size(), 0), tendon(tissue.body.size(), 0);
  for (std::size_t t = 0; t < tissue.elements.size(); ++t) {
    if (tissue.elements[t].sheath && of_end[t] == 0) continue;
    for (int node : tissue.elements[t].nodes) (tissue.elements[t].sheath ? tendon : belly)[at(node)] = 1;
  }
  const std::vector<double> pull = unit_pull(tissue);
  TendonStrand strand;
  double sum = 0.0;
  for (std::size_t node = 0; node < belly.size(); ++node) {
    if (belly[node] == 0 || tendon[node] == 0 || tissue.body[node] >= 0) continue;
    const double weight = std::max(sign * pull[node], 0.0);
    if (!(weight > 0.0)) continue;
    strand.nodes.push_back(static_cast<int>(node));
    strand.weights.push_back(weight);
    sum += weight;
  }
  for (double& weight : strand.weights) weight /= sum;
  return strand;
}

Vec3 border_middle(const TendonStrand& strand, const MuscleTissue& tissue) {
  Vec3 p = Vec3::Zero();
  for (std::size_t k = 0; k < strand.nodes.size(); ++k)
    p += strand.weights[k] * tissue.mesh.nodes_m[at(strand.nodes[k])];
  return p;
}

/// The points of the line beyond the border with the surfaces on the way to them, from the border to the bone; at least
/// the line's end.
void add_points(const anatomy::MuscleLine& line, double border_place_m, bool at_insertion, TendonStrand& strand) {
  const std::vector<Vec3> line_m = line_points_L(line);
  double place_m = 0.0;
  std::size_t seen = 0;  // of line_m
  for (std::size_t k = 0; k < line.points.size(); ++k) {
    const auto* before = k > 0 ? anatomy::wrap_after(line, k - 1) : nullptr;
    const auto* after = anatomy::wrap_after(line, k);
    const std::size_t place = k == 0 ? 0 : seen + 1 + (before != nullptr ? at(kWrapPoints) : 0);
    for (; seen < place; ++seen) place_m += (line_m[seen + 1] - line_m[seen]).norm();
    const bool end = at_insertion ? k + 1 == line.points.size() : k == 0;
    const bool beyond = at_insertion ? place_m > border_place_m : place_m < border_place_m;
    if (!end && !beyond) continue;
    const auto* wrap = at_insertion ? before : after;
    strand.points.push_back(
        {line.points[k].body, line.points[k].position_m, wrap != nullptr ? std::optional(*wrap) : std::nullopt});
  }
  if (!at_insertion) std::reverse(strand.points.begin(), strand.points.end());
}

/// Length of the string from its first point on, in the skeleton's pose.
double tail_length_m(const TendonStrand& strand, const Skeleton& skeleton) {
  const TendonStrand::BodyPoint& first = strand.points[0];
  TendonStrand tail = strand;
  tail.points.erase(tail.points.begin());
  return strand_length(tail, skeleton, skeleton.body_pose(first.body) * first.rest_m);
}

/// Longest tail over the ranges of the joints, one joint at a time.
double longest_tail_m(const TendonStrand& strand, Skeleton& skeleton) {
  std::vector<double> angles(at(skeleton.joint_count()), 0.0);
  double longest = 0.0;
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (skeleton.joint(j).type != anatomy::JointType::Hinge) continue;
    const auto [low, high] = skeleton.joint(j).range_rad[0];
    for (int sample = 0; sample < kAngleSamples; ++sample) {
      angles[at(j)] = low + (high - low) * sample / (kAngleSamples - 1);
      skeleton.set_pose(angles);
      longest = std::max(longest, tail_length_m(strand, skeleton));
    }
    angles[at(j)] = 0.0;
  }
  skeleton.set_pose(angles);
  return std::max(longest, tail_length_m(strand, skeleton));
}

/// Leaves out the string's first point; the surface before it stays on the way, unless the next point has its own.
void leave_out_first(TendonStrand& strand) {
  if (!strand.points[1].wrap) strand.points[1].wrap = strand.points[0].wrap;
  strand.points.erase(strand.points.begin());
}

/// Leaves out the points that the belly's end comes too near to: a taut string keeps its length, so what its tail gains
/// the way to its first point loses. A surface that the belly's end lies in at rest is left out too. Sets the rest
/// length; the skeleton is in the file pose.
void fit_points(const Vec3& border_m, Skeleton& skeleton, TendonStrand& strand) {
  while (true) {
    auto& wrap = strand.points[0].wrap;
    if (wrap && geometry::is_inside(anatomy::surface_of(*wrap), anatomy::in_frame_of(*wrap, border_m))) wrap.reset();
    const double tail_m = tail_length_m(strand, skeleton);
    strand.rest_length_m = strand_length(strand, skeleton, border_m);
    const double gain_m = longest_tail_m(strand, skeleton) - tail_m;
    if (strand.points.size() == 1 || strand.rest_length_m - tail_m - gain_m > kClearance_m) return;
    leave_out_first(strand);
  }
}

}  // namespace

double line_length_m(const anatomy::MuscleLine& line) {
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
    const Vec3 &from_m = line.points[k].position_m, &to_m = line.points[k + 1].position_m;
    const auto* wrap = anatomy::wrap_after(line, k);
    length += wrap == nullptr ? (to_m - from_m).norm()
                              : geometry::wrap_path(anatomy::surface_of(*wrap), anatomy::in_frame_of(*wrap, from_m),
                                                    anatomy::in_frame_of(*wrap, to_m))
                                    .length_m;
  }
  return length;
}

std::vector<TendonStrand> lay_strands(const anatomy::Muscle& muscle, const anatomy::MuscleLine& line,
                                      const MuscleTissue& tissue, Skeleton& skeleton) {
  const std::vector<int> group = tendon_groups(tissue);
  const std::vector<Vec3> line_m = line_points_L(line);
  const double belly_place_m = mean_place_m(tissue, line_m, [&](std::size_t t) { return group[t] < 0; });
  std::map<int, double> place_of_group;
  for (int g : group) {
    if (g < 0 || place_of_group.contains(g)) continue;
    place_of_group[g] = mean_place_m(tissue, line_m, [&](std::size_t t) { return group[t] == g; });
  }
  std::vector<TendonStrand> strands;
  for (const bool at_insertion : {false, true}) {
    std::vector<char> of_end(group.size(), 0);
    for (std::size_t t = 0; t < group.size(); ++t) {
      of_end[t] = group[t] >= 0 && (place_of_group[group[t]] > belly_place_m) == at_insertion;
    }
    // Unit stress pulls the nodes at the insertion towards the origin: holding them takes a force along the fibres.
    TendonStrand strand = border(tissue, of_end, at_insertion ? 1.0 : -1.0);
    if (strand.nodes.empty()) continue;
    const Vec3 p = border_middle(strand, tissue);
    add_points(line, place_on_line_m(line_m, p), at_insertion, strand);
    fit_points(p, skeleton, strand);
    strand.stiffness_N_m = kStrandOverMuscle * kMuscleStiffness_F0_lo * muscle.peak_force_N / muscle.optimal_fibre_m;
    strand.at_insertion = at_insertion;
    strand.toe_m = kToe_lo * muscle.optimal_fibre_m;
    strands.push_back(strand);
  }
  return strands;
}

}  // namespace myotact::simulation
