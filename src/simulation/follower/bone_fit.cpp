#include "simulation/follower/bone_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include "core/at.h"
#include "simulation/follower/mesh_fields.h"

namespace myotact::simulation {
namespace {

/// Samples of one joint no farther apart than this [rad]: 7.5 degrees. At 30 mm from the axis the straight way between
/// two leaves the circle by 0.07 mm.
constexpr double kSampleSpacing_rad = 0.1309;
/// Between two samples a vertex may be out of bounds by this much [m], half of what is asked for; else there is a
/// third, so often at most.
constexpr double kBetweenSamples_m = 1e-3;
constexpr int kMostHalvings = 2;
/// A vertex is looked at for bones this far away [m]; what has come off farther is not pulled back.
constexpr double kReach_m = 0.03;
/// One that touches none enters by less than this from one sample to the next [m]; farther out it is not looked at.
constexpr double kEntersBy_m = 0.01;
/// A vertex is no deeper in a bone at the file pose than this [m].
constexpr double kDeepest_m = 0.02;
/// What is added to a distance that bounds a search [m].
constexpr double kRounding_m = 1e-9;
/// The gap of a vertex that nobody has looked at, or with no bone in reach [m].
constexpr double kUnknown_m = std::numeric_limits<double>::infinity();
/// Out of bounds by less than this is left alone [m]; an eighth of what is asked for.
constexpr double kFine_m = 0.25e-3;
/// The surface's hold over the tissue's: a push fades into the tissue over about this length, inverted [1/m].
constexpr double kHold_1_m = 6000.0;
/// The same of clamped nodes: softer, for a bone that enters an attachment has to win.
constexpr double kClampHold_1_m = 100.0;
/// A clamped node farther than this from its own body's bones is a tendon's, that only ends there [m].
constexpr double kClampReach_m = 2e-3;
/// What nothing holds stays where line and bodies have it: a displacement dies away over about this length [m].
constexpr double kAnchor_m = 0.03;
/// This part of the tissue's resistance is to leaving the sample before, the rest to leaving line and bodies: what
/// samples have in common is what the way between them keeps.
constexpr double kKept = 0.8;
/// Corrections of one sample at most.
constexpr int kMostRounds = 12;
/// A round has gained something when what is out of bounds fell to this part.
constexpr double kLeastGain = 0.9;

using Matrix = Eigen::SparseMatrix<double>;

/// A skin vertex that can be moved, and its bounds.
struct Vertex {
  const NodeWeights* weights = nullptr;
  double area_m2 = 0.0;
  double hold_m = 0.0;  // by which it is held when it is
  BoneBounds bounds;
  /// What was seen when the vertex was last looked at: where it was, in the world and in the frame of the body that the
  /// joint moves; the gap there; and how far it may go from there before it can be out of bounds.
  struct Look {
    Vec3 at_W_m = Vec3::Zero(), at_B_m = Vec3::Zero();
    double gap_m = kUnknown_m, free_m = 0.0;
  };
  Look look, rest_look;  // the last one, and that at the file pose
  Vec3 now_m = Vec3::Zero();
  Vec3 shift_m = Vec3::Zero();  // back into its bounds
  bool held = false;            // it was out of bounds in this sample
};

std::vector<double> vertex_areas(const geometry::TriangleMesh& skin) {
  std::vector<double> area_m2(skin.positions_m.size(), 0.0);
  for (const auto& t : skin.triangles) {
    const Vec3 &a = skin.positions_m[at(t[0])], &b = skin.positions_m[at(t[1])], &c = skin.positions_m[at(t[2])];
    const double third = (b - a).cross(c - a).norm() / 6.0;
    for (const int v : t) area_m2[at(v)] += third;
  }
  return area_m2;
}

/// How much farther the nodes have to go than a vertex outside the mesh that they carry.
double lever(const NodeWeights& weights) {
  double sum = 0.0;
  for (std::size_t k = 0; k < at(weights.count); ++k) sum += std::abs(weights.weights[k]);
  return sum;
}

bool lies_on(const BoneFitInput& input, int body, const Vec3& rest_m) {
  return std::any_of(input.bones.begin(), input.bones.end(), [&](const BoneSurface& bone) {
    if (bone.body != body || bone.surface.box_distance_m(rest_m) > kClampReach_m) return false;
    const geometry::SignedPlace place = bone.surface.nearest(rest_m, kReach_m);
    return place.found && place.distance_m < kClampReach_m;
  });
}

double known_gap_m(const BoneGap& gap) {
  return gap.outward.isZero() ? kUnknown_m : std::abs(gap.distance_m);
}

/// Fits one follower in one pose after the other.
class Fitter {
 public:
  Fitter(const BoneFitInput& input, const Skeleton& skeleton, const Follower& follower);

  /// Only this joint leaves the file pose from now on.
  void move_joint(int joint);
  /// From `shift_m` (rest frame, one column a node) to the fitted one. False when nothing was out of bounds: then it
  /// stays as it is.
  bool fit(std::span<const double> angles_rad, Eigen::Matrix3Xd& shift_m);
  /// How far the worst vertex is out of bounds with that shift [m].
  double worst_m(std::span<const double> angles_rad, const Eigen::Matrix3Xd& shift_m);

 private:
  void start(std::span<const double> angles_rad, const Eigen::Matrix3Xd& shift_m);
  void measure();
  Vec3 in_moved_body(const Vec3& p_W) const;
  double way_m(const Vertex& vertex) const;
  BoneGap look_at(Vertex& vertex) const;
  double look();
  void solve();

  const BoneFitInput& in_;
  Skeleton skeleton_;
  const Follower& follower_;
  int moved_body_ = -1;  // this one and all beyond it; the others stay where they are
  std::vector<Vertex> vertices_;
  Matrix base_;    // tissue and clamps
  Matrix matrix_;  // and the held vertices
  Eigen::SimplicialLLT<Matrix> factor_;
  std::vector<Affine> maps_;
  Eigen::MatrixX3d placed_m_;   // nodes by the maps alone
  Eigen::MatrixX3d moved_m_;    // displacement from there, world
  Eigen::MatrixX3d started_m_;  // the same before the fit
};

Fitter::Fitter(const BoneFitInput& input, const Skeleton& skeleton, const Follower& follower)
    : in_(input), skeleton_(skeleton), follower_(follower) {
  const std::vector<double> file_pose(at(skeleton_.joint_count()), 0.0);
  skeleton_.set_pose(file_pose);
  const std::vector<double> area_m2 = vertex_areas(input.skin);
  for (std::size_t v = 0; v < input.embedding.vertices.size(); ++v) {
    const NodeWeights& weights = input.embedding.vertices[v];
    Vec3 rest_m = Vec3::Zero();
    for (std::size_t k = 0; k < at(weights.count); ++k) {
      rest_m += weights.weights[k] * input.mesh.nodes_m[at(weights.nodes[k])];
    }
    const BoneGap gap = gap_to_bones(input.bones, skeleton_, rest_m, kDeepest_m);
    Vertex vertex;
    vertex.weights = &weights;
    vertex.area_m2 = area_m2[v];
    vertex.hold_m = kHold_1_m * area_m2[v] / std::max(1.0, lever(weights));
    vertex.bounds = bounds_at_rest(gap);
    vertex.rest_look = {rest_m, rest_m, known_gap_m(gap), free_way_m(vertex.bounds, gap)};
    vertices_.push_back(vertex);
  }
  const MeshFields fields = make_mesh_fields(input.mesh);
  const auto nodes = static_cast<Eigen::Index>(input.mesh.nodes_m.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (const Vertex& vertex : vertices_) {
    for (std::size_t a = 0; a < at(vertex.weights->count); ++a) {
      for (std::size_t b = 0; b < at(vertex.weights->count); ++b) {
        entries.emplace_back(vertex.weights->nodes[a], vertex.weights->nodes[b], 0.0);
      }
    }
  }
  Matrix pattern(nodes, nodes);
  pattern.setFromTriplets(entries.begin(), entries.end());
  base_ = fields.stiffness_m + pattern;
  const double area_of_node_m2 = [&] {
    double sum_m2 = 0.0;
    for (const double a : area_m2) sum_m2 += a;
    return sum_m2 / static_cast<double>(nodes);
  }();
  for (Eigen::Index i = 0; i < nodes; ++i) {
    base_.coeffRef(i, i) += fields.volume_m3[i] / (kAnchor_m * kAnchor_m);
    const int body = input.attachment[static_cast<std::size_t>(i)];
    if (body >= 0 && lies_on(input, body, input.mesh.nodes_m[static_cast<std::size_t>(i)]))
      base_.coeffRef(i, i) += kClampHold_1_m * area_of_node_m2;
  }
  base_.makeCompressed();
  matrix_ = base_;
  factor_.analyzePattern(matrix_);
}

void Fitter::move_joint(int joint) {
  moved_body_ = skeleton_.joint(joint).child;
  for (Vertex& vertex : vertices_) vertex.look = vertex.rest_look;
}

void Fitter::measure() {
  for (Vertex& vertex : vertices_) {
    Vec3 p = Vec3::Zero();
    for (std::size_t k = 0; k < at(vertex.weights->count); ++k) {
      const int node = vertex.weights->nodes[k];
      p += vertex.weights->weights[k] * (placed_m_.row(node) + moved_m_.row(node)).transpose();
    }
    vertex.now_m = p;
  }
}

Vec3 Fitter::in_moved_body(const Vec3& p_W) const {
  const Pose& X_WB = skeleton_.body_pose(moved_body_);
  return X_WB.rotation.transpose() * (p_W - X_WB.translation_m);
}

/// How far a vertex has gone since it was looked at, against those bones that stand still or those that the joint
/// moves, whichever is more.
double Fitter::way_m(const Vertex& vertex) const {
  return std::max((vertex.now_m - vertex.look.at_W_m).norm(),
                  (in_moved_body(vertex.now_m) - vertex.look.at_B_m).norm());
}

/// The gap of a vertex that may be out of bounds. It changes by no more than the vertex moves against the bones, which
/// is how far one has to look.
BoneGap Fitter::look_at(Vertex& vertex) const {
  const double reach_m = std::isfinite(vertex.bounds.farthest_m) ? kReach_m : kEntersBy_m;
  const double gap_m = vertex.look.gap_m + way_m(vertex) + kRounding_m;
  const BoneGap gap = gap_to_bones(in_.bones, skeleton_, vertex.now_m, std::min(reach_m, gap_m));
  vertex.look = {vertex.now_m, in_moved_body(vertex.now_m), known_gap_m(gap), free_way_m(vertex.bounds, gap)};
  return gap;
}

/// Looks at all vertices that may be out of bounds. How far they are: sum of area and square; 0 when none is out by
/// more than is left alone.
double Fitter::look() {
  double sum_m4 = 0.0;
  bool out = false;
  for (Vertex& vertex : vertices_) {
    vertex.shift_m.setZero();
    if (vertex.look.free_m > 0.0 && way_m(vertex) < vertex.look.free_m) continue;
    const BoneGap gap = look_at(vertex);
    const double wanted_m = std::clamp(gap.distance_m, vertex.bounds.nearest_m, vertex.bounds.farthest_m);
    vertex.shift_m = (wanted_m - gap.distance_m) * gap.outward;
    sum_m4 += vertex.area_m2 * vertex.shift_m.squaredNorm();
    if (vertex.shift_m.norm() > kFine_m) out = vertex.held = true;
  }
  return out ? sum_m4 : 0.0;
}

/// The displacement that brings the held vertices where they have to be.
void Fitter::solve() {
  matrix_ = base_;
  Eigen::MatrixX3d right = kKept * (base_ * started_m_);
  for (const Vertex& vertex : vertices_) {
    if (!vertex.held) continue;
    const double hold_m = vertex.hold_m;
    Vec3 wanted_m = vertex.now_m + vertex.shift_m;
    for (std::size_t k = 0; k < at(vertex.weights->count); ++k) {
      wanted_m -= vertex.weights->weights[k] * placed_m_.row(vertex.weights->nodes[k]).transpose();
    }
    for (std::size_t a = 0; a < at(vertex.weights->count); ++a) {
      const double weight = hold_m * vertex.weights->weights[a];
      right.row(vertex.weights->nodes[a]) += weight * wanted_m.transpose();
      for (std::size_t b = 0; b < at(vertex.weights->count); ++b) {
        matrix_.coeffRef(vertex.weights->nodes[a], vertex.weights->nodes[b]) += weight * vertex.weights->weights[b];
      }
    }
  }
  factor_.factorize(matrix_);
  if (factor_.info() == Eigen::Success) moved_m_ = factor_.solve(right);
}

void Fitter::start(std::span<const double> angles_rad, const Eigen::Matrix3Xd& shift_m) {
  skeleton_.set_pose(angles_rad);
  follower_maps(follower_, skeleton_, maps_);
  placed_m_.resize(shift_m.cols(), 3);
  moved_m_.resize(shift_m.cols(), 3);
  for (Eigen::Index i = 0; i < shift_m.cols(); ++i) {
    const Affine& map = maps_[static_cast<std::size_t>(i)];
    placed_m_.row(i) = (map * in_.mesh.nodes_m[static_cast<std::size_t>(i)]).transpose();
    moved_m_.row(i) = (map.linear * shift_m.col(i)).transpose();
  }
  measure();
  for (Vertex& vertex : vertices_) vertex.held = false;
}

double Fitter::worst_m(std::span<const double> angles_rad, const Eigen::Matrix3Xd& shift_m) {
  start(angles_rad, shift_m);
  look();
  double worst_m = 0.0;
  for (const Vertex& vertex : vertices_) worst_m = std::max(worst_m, vertex.shift_m.norm());
  return worst_m;
}

bool Fitter::fit(std::span<const double> angles_rad, Eigen::Matrix3Xd& shift_m) {
  start(angles_rad, shift_m);
  started_m_ = moved_m_;
  Eigen::MatrixX3d best_m = moved_m_;
  const double first_m4 = look();
  if (first_m4 == 0.0) return false;
  double best_m4 = first_m4;
  int idle = 0;  // rounds in a row that gained next to nothing
  for (int round = 0; round < kMostRounds && best_m4 > 0.0; ++round) {
    solve();
    measure();
    const double now_m4 = look();
    const bool gains = now_m4 < kLeastGain * best_m4;
    if (now_m4 < best_m4) {
      best_m4 = now_m4;
      best_m = moved_m_;
    }
    idle = gains ? 0 : idle + 1;
    if (idle > 1) break;
  }
  moved_m_ = best_m;
  for (Eigen::Index i = 0; i < shift_m.cols(); ++i) {
    const Mat3& linear = maps_[static_cast<std::size_t>(i)].linear;
    shift_m.col(i) = linear.inverse() * moved_m_.row(i).transpose();
  }
  return true;
}

/// Angles at which a joint is sampled: the ends of its range, the file pose, and evenly between.
std::vector<double> sample_angles(const anatomy::Joint& joint) {
  const double lowest = std::min(0.0, joint.range_rad[0].first), highest = std::max(0.0, joint.range_rad[0].second);
  const int below = static_cast<int>(std::ceil(-lowest / kSampleSpacing_rad));
  const int above = static_cast<int>(std::ceil(highest / kSampleSpacing_rad));
  std::vector<double> angles;
  for (int i = below; i > 0; --i) angles.push_back(lowest * i / below);
  angles.push_back(0.0);
  for (int i = 1; i <= above; ++i) angles.push_back(highest * i / above);
  return angles;
}

std::size_t index_of_zero(const std::vector<double>& angles) {
  return static_cast<std::size_t>(std::find(angles.begin(), angles.end(), 0.0) - angles.begin());
}

/// Calls visit(index, neighbour towards zero) outwards from the file pose, first up, then down.
template <class Visit>
void outwards(const std::vector<double>& angles, Visit&& visit) {
  const std::size_t zero = index_of_zero(angles);
  for (std::size_t i = zero + 1; i < angles.size(); ++i) visit(i, i - 1);
  for (std::size_t i = zero; i-- > 0;) visit(i, i + 1);
}

/// One joint's samples while they are made.
struct JointSamples {
  std::vector<double> angles_rad;
  std::vector<Eigen::Matrix3Xd> shift_m;
};

/// Where the straight way between two samples leaves the bounds, a third is put between.
void halve_cells(Fitter& fitter, int joint, std::vector<double>& pose, JointSamples& samples) {
  JointSamples finer;
  for (std::size_t i = 0; i < samples.angles_rad.size(); ++i) {
    finer.angles_rad.push_back(samples.angles_rad[i]);
    finer.shift_m.push_back(samples.shift_m[i]);
    if (i + 1 == samples.angles_rad.size()) break;
    Eigen::Matrix3Xd between_m = 0.5 * (samples.shift_m[i] + samples.shift_m[i + 1]);
    pose[at(joint)] = 0.5 * (samples.angles_rad[i] + samples.angles_rad[i + 1]);
    if (fitter.worst_m(pose, between_m) < kBetweenSamples_m) continue;
    fitter.fit(pose, between_m);
    finer.angles_rad.push_back(pose[at(joint)]);
    finer.shift_m.push_back(between_m);
  }
  samples = std::move(finer);
}

/// The table of one joint; without samples when the joint has no part in the follower.
FollowerTable fit_joint(Fitter& fitter, const Skeleton& skeleton, int joint, Eigen::Index nodes) {
  fitter.move_joint(joint);
  JointSamples samples{sample_angles(skeleton.joint(joint)), {}};
  samples.shift_m.assign(samples.angles_rad.size(), Eigen::Matrix3Xd::Zero(3, nodes));
  std::vector<double> pose(at(skeleton.joint_count()), 0.0);
  bool any = false;
  outwards(samples.angles_rad, [&](std::size_t i, std::size_t from) {
    pose[at(joint)] = samples.angles_rad[i];
    samples.shift_m[i] = samples.shift_m[from];
    any |= fitter.fit(pose, samples.shift_m[i]);
  });
  if (!any) return {};
  for (int halving = 0; halving < kMostHalvings; ++halving) halve_cells(fitter, joint, pose, samples);
  FollowerTable table{joint, samples.angles_rad, {}};
  for (const Eigen::Matrix3Xd& shift : samples.shift_m) table.rest_shift_m.push_back(shift.cast<float>());
  return table;
}

}  // namespace

void fit_to_bones(const BoneFitInput& input, const Skeleton& skeleton, Follower& follower) {
  follower.tables.clear();
  follower.placed_rad.clear();
  if (input.bones.empty()) return;
  Fitter fitter(input, skeleton, follower);
  const auto nodes = static_cast<Eigen::Index>(input.mesh.nodes_m.size());
  std::vector<FollowerTable> tables;
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (skeleton.joint(j).type != anatomy::JointType::Hinge) continue;
    FollowerTable table = fit_joint(fitter, skeleton, j, nodes);
    if (!table.rest_shift_m.empty()) tables.push_back(std::move(table));
  }
  follower.tables = std::move(tables);
}

}  // namespace myotact::simulation
