#include "view/pictures/moving_limb_model.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/at.h"
#include "core/dense_matrix.h"
#include "view/pictures/limb_model.h"

namespace myotact::view {

namespace {

using geometry::GlbMotion;
using geometry::GlbNode;

/// Bones in their file pose, skins as they are then: what the motion is added to.
messages::SceneFrame resting_frame(const LimbMoment& moment) {
  messages::SceneFrame frame;
  frame.skins_world_m = moment.skins_world_m;
  return frame;
}

messages::SceneFrame frame_at(const LimbMoment& moment) {
  messages::SceneFrame frame = resting_frame(moment);
  frame.body_poses = moment.body_poses;
  return frame;
}

/// Of a bone's body; the shorter way round from each moment to the next.
GlbMotion body_motion(const std::vector<LimbMoment>& moments, std::size_t body) {
  GlbMotion motion;
  Eigen::Quaterniond last = Eigen::Quaterniond::Identity();
  for (const LimbMoment& moment : moments) {
    const auto& pose = moment.body_poses[body];
    Mat3 rotation;
    for (int k = 0; k < 9; ++k) rotation(k / 3, k % 3) = pose[at(4 * (k / 3) + k % 3)];
    Eigen::Quaterniond q(rotation);
    q.normalize();
    if (q.dot(last) < 0.0) q.coeffs() = -q.coeffs();
    last = q;
    motion.translations_m.push_back(
        {static_cast<float>(pose[3]), static_cast<float>(pose[7]), static_cast<float>(pose[11])});
    motion.rotations.push_back(
        {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), static_cast<float>(q.w())});
  }
  return motion;
}

/// What a list of vectors differs from the first one by, a column a moment.
using Vectors = std::vector<std::array<float, 3>>;
Eigen::MatrixXf changes(const std::vector<Vectors>& moments) {
  const auto rows = static_cast<Eigen::Index>(3 * moments.front().size());
  Eigen::MatrixXf out(rows, static_cast<Eigen::Index>(moments.size()));
  const auto numbers = [&](const Vectors& list) {
    return Eigen::Map<const Eigen::VectorXf>(list.empty() ? nullptr : list.front().data(), rows);
  };
  for (std::size_t k = 0; k < moments.size(); ++k) {
    out.col(static_cast<Eigen::Index>(k)) = numbers(moments[k]) - numbers(moments.front());
  }
  return out;
}

double farthest_m(const Eigen::MatrixXf& changes_m) {
  double farthest = 0.0;
  for (Eigen::Index k = 0; k < changes_m.cols(); ++k) {
    for (Eigen::Index i = 0; i < changes_m.rows(); i += 3) {
      farthest = std::max(farthest, static_cast<double>(changes_m.col(k).segment<3>(i).norm()));
    }
  }
  return farthest;
}

Vectors as_vectors(const Eigen::VectorXf& numbers) {
  Vectors out(static_cast<std::size_t>(numbers.size() / 3));
  for (std::size_t i = 0; i < out.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) out[i][k] = numbers[static_cast<Eigen::Index>(3 * i + k)];
  }
  return out;
}

/// Shapes and their weights: the eigenvectors of the moments' products with each other are the weights over time, and
/// what the changes have of each is its shape. Normals get the same weights.
void add_shapes(const std::vector<Vectors>& positions_m, const std::vector<Vectors>& normals, GlbNode& node) {
  Eigen::MatrixXf left_m = changes(positions_m);
  const Eigen::MatrixXf turned = changes(normals);
  const Eigen::MatrixXd products = (left_m.transpose() * left_m).cast<double>();
  const SymmetricEigen modes = symmetric_eigen(products);
  const Eigen::Index times = left_m.cols();
  for (Eigen::Index mode = times - 1; mode >= 0 && farthest_m(left_m) > kModelTolerance_m; --mode) {
    const Eigen::VectorXf weights = modes.vectors.col(mode).cast<float>();
    const Eigen::VectorXf shape_m = left_m * weights;
    left_m -= shape_m * weights.transpose();
    node.shapes.push_back({as_vectors(shape_m), as_vectors(turned * weights)});
    node.motion.weights.resize(static_cast<std::size_t>(times));
    for (Eigen::Index k = 0; k < times; ++k) node.motion.weights[static_cast<std::size_t>(k)].push_back(weights[k]);
  }
}

const std::string& key_of(const GlbNode& node) {
  static const std::string kNone;
  for (const auto& [name, text] : node.extras) {
    if (name == "key") return text;
  }
  return kNone;
}

}  // namespace

geometry::GlbScene moving_limb_model(const anatomy::Specimen& specimen, const std::vector<LimbMoment>& moments,
                                     const ViewState& view) {
  geometry::GlbScene scene = limb_model(specimen, resting_frame(moments.front()), view);
  for (const LimbMoment& moment : moments) {
    scene.times_s.push_back(static_cast<float>(moment.time_s - moments.front().time_s));
  }
  for (GlbNode& node : scene.groups[0].nodes) {
    for (const anatomy::Bone& bone : specimen.bones) {
      if (bone.key == key_of(node)) node.motion = body_motion(moments, static_cast<std::size_t>(bone.body));
    }
  }
  std::vector<GlbNode>& muscles = scene.groups[1].nodes;
  std::vector<std::vector<Vectors>> positions_m(muscles.size()), normals(muscles.size());
  for (const LimbMoment& moment : moments) {
    const geometry::GlbScene then = limb_model(specimen, frame_at(moment), view);
    for (std::size_t m = 0; m < muscles.size(); ++m) {
      positions_m[m].push_back(then.groups[1].nodes[m].positions_m);
      normals[m].push_back(then.groups[1].nodes[m].normals);
    }
  }
  for (std::size_t m = 0; m < muscles.size(); ++m) add_shapes(positions_m[m], normals[m], muscles[m]);
  return scene;
}

}  // namespace myotact::view
