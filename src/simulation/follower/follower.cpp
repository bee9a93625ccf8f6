#include "simulation/follower/follower.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/at.h"
#include "simulation/follower/mesh_fields.h"
#include "simulation/line/line_model.h"

namespace myotact::simulation {
namespace {

/// A body's hold on the tissue about an attachment fades over the belly's mean radius, at least over this [m].
constexpr double kShortestFade_m = 4e-3;
/// A share below this is none.
constexpr double kLeastShare = 1e-3;

/// Of a straight belly of that volume and length.
double mean_radius_m(const MeshFields& fields, double length_m) {
  return std::sqrt(fields.volume_m3.sum() / (std::numbers::pi * std::max(length_m, 1e-3)));
}

double rest_length_m(const anatomy::MuscleLine& line) {
  const std::vector<Vec3> points_m = line_points_L(line);
  double length_m = 0.0;
  for (std::size_t i = 1; i < points_m.size(); ++i) length_m += (points_m[i] - points_m[i - 1]).norm();
  return length_m;
}

/// Whether no joint moves the two bodies against each other: one body, or several that are welded.
bool move_together(const Skeleton& skeleton, int a, int b) {
  for (int j = 0; j < skeleton.joint_count(); ++j) {
    if (skeleton.is_distal(a, j) != skeleton.is_distal(b, j)) return false;
  }
  return true;
}

/// A body with which every clamped node, point and surface of the line moves; else -1.
int only_body(const std::vector<int>& attachment, const anatomy::MuscleLine& line, const Skeleton& skeleton) {
  const int body = line.points.front().body;
  const auto differs = [&](const auto& part) { return !move_together(skeleton, part.body, body); };
  const bool line_differs = std::any_of(line.points.begin(), line.points.end(), differs) ||
                            std::any_of(line.wraps.begin(), line.wraps.end(), differs);
  const bool clamps_differ = std::any_of(attachment.begin(), attachment.end(), [&](int clamp) {
    return clamp >= 0 && !move_together(skeleton, clamp, body);
  });
  return line_differs || clamps_differ ? -1 : body;
}

/// Where each node lies along the line: the nearest place of the line jumps on the inside of a bend, so it is smoothed.
void find_stations(const geometry::TetMesh& mesh, const MeshFields& fields, double smoothing_m, Follower& follower) {
  Eigen::VectorXd arc_m(static_cast<Eigen::Index>(mesh.nodes_m.size()));
  for (std::size_t i = 0; i < mesh.nodes_m.size(); ++i) {
    arc_m[static_cast<Eigen::Index>(i)] = follower.frames.nearest_arc_m(mesh.nodes_m[i]);
  }
  arc_m = smoothed(fields, arc_m, smoothing_m);
  const double last = static_cast<double>(follower.frames.size() - 1);
  const double spacing_m = follower.frames.length_m() / last;
  for (std::size_t i = 0; i < mesh.nodes_m.size(); ++i) {
    const double place = spacing_m > 0.0 ? std::clamp(arc_m[static_cast<Eigen::Index>(i)] / spacing_m, 0.0, last) : 0.0;
    FollowerNode& node = follower.nodes[i];
    node.station = static_cast<std::size_t>(std::min(std::floor(place), last - 1.0));
    node.next_share = place - static_cast<double>(node.station);
    node.station_share = 1.0 - node.next_share;
  }
}

/// Three of the bodies that hold the node most, and the line the rest.
void set_shares(const Eigen::RowVectorXd& body_share, const std::vector<int>& bodies, FollowerNode& node) {
  std::vector<Eigen::Index> order(at(static_cast<int>(body_share.size())));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return body_share[a] > body_share[b]; });
  double held = 0.0;
  for (std::size_t k = 0; k < std::min(order.size(), FollowerNode::kMostBodies); ++k) {
    const double share = std::min(body_share[order[k]], 1.0 - held);
    if (share < kLeastShare) break;
    node.bodies[k] = bodies[static_cast<std::size_t>(order[k])];
    node.body_shares[k] = share;
    held += share;
  }
  if (1.0 - held < kLeastShare) {
    for (double& share : node.body_shares) share /= held;
    held = 1.0;
  }
  node.station_share *= 1.0 - held;
  node.next_share *= 1.0 - held;
}

void find_holds(const std::vector<int>& attachment, const MeshFields& fields, double fade_m, Follower& follower) {
  std::vector<int> bodies;
  std::vector<char> held;
  for (const int body : attachment) {
    held.push_back(body >= 0);
    if (body >= 0 && std::find(bodies.begin(), bodies.end(), body) == bodies.end()) bodies.push_back(body);
  }
  std::sort(bodies.begin(), bodies.end());
  const auto nodes = static_cast<Eigen::Index>(attachment.size());
  Eigen::MatrixXd share = Eigen::MatrixXd::Zero(nodes, static_cast<Eigen::Index>(bodies.size()));
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const int body = attachment[static_cast<std::size_t>(i)];
    const auto found = std::find(bodies.begin(), bodies.end(), body);
    if (found != bodies.end()) share(i, found - bodies.begin()) = 1.0;
  }
  const Eigen::MatrixXd faint = bodies.empty() ? share : faded(fields, held, share, fade_m);
  for (Eigen::Index i = 0; i < nodes; ++i) {
    const bool clamped = held[static_cast<std::size_t>(i)] != 0;
    const Eigen::RowVectorXd here = clamped ? share.row(i) : Eigen::RowVectorXd(faint.row(i).cwiseMax(0.0));
    set_shares(here, bodies, follower.nodes[static_cast<std::size_t>(i)]);
  }
}

/// The cell of a table's angles that holds `angle_rad`, and how far in it lies.
struct Cell {
  std::size_t first = 0;
  float share = 0.0f;  // of the next sample
};

Cell cell_of(const std::vector<double>& angles_rad, double angle_rad) {
  const double angle = std::clamp(angle_rad, angles_rad.front(), angles_rad.back());
  std::size_t i = 0;
  while (i + 2 < angles_rad.size() && angle > angles_rad[i + 1]) ++i;
  return {i, static_cast<float>((angle - angles_rad[i]) / (angles_rad[i + 1] - angles_rad[i]))};
}

void add_shift(const FollowerTable& table, std::span<const double> angles_rad, Eigen::Matrix3Xf& shift_m) {
  const Cell cell = cell_of(table.angles_rad, angles_rad[at(table.joint)]);
  shift_m += (1.0f - cell.share) * table.rest_shift_m[cell.first] + cell.share * table.rest_shift_m[cell.first + 1];
}

}  // namespace

Follower make_follower(const geometry::TetMesh& mesh, const std::vector<int>& attachment,
                       const anatomy::MuscleLine& line, const Skeleton& skeleton) {
  const MeshFields fields = make_mesh_fields(mesh);
  const double radius_m = mean_radius_m(fields, rest_length_m(line));
  const double fade_m = std::max(kShortestFade_m, radius_m);
  Follower follower{LineFrames(line, std::max(kShortestFade_m, radius_m)), {}, {}, -1, {}};
  follower.nodes.resize(mesh.nodes_m.size());
  follower.only_body = only_body(attachment, line, skeleton);
  find_stations(mesh, fields, radius_m, follower);
  find_holds(attachment, fields, fade_m, follower);
  return follower;
}

void follower_maps(const Follower& follower, const Skeleton& skeleton, std::vector<Affine>& maps) {
  maps.resize(follower.nodes.size());
  if (follower.only_body >= 0) {
    const Pose& pose = skeleton.body_pose(follower.only_body);
    std::fill(maps.begin(), maps.end(), Affine{pose.rotation, pose.translation_m});
    return;
  }
  std::vector<Affine> stations;
  follower.frames.follow(skeleton, stations);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const FollowerNode& node = follower.nodes[i];
    const Affine &here = stations[node.station], &next = stations[node.station + 1];
    maps[i].linear = node.station_share * here.linear + node.next_share * next.linear;
    maps[i].offset_m = node.station_share * here.offset_m + node.next_share * next.offset_m;
    for (std::size_t k = 0; k < FollowerNode::kMostBodies && node.bodies[k] >= 0; ++k) {
      const Pose& pose = skeleton.body_pose(node.bodies[k]);
      maps[i].linear += node.body_shares[k] * pose.rotation;
      maps[i].offset_m += node.body_shares[k] * pose.translation_m;
    }
  }
}

void follower_shift(const Follower& follower, std::span<const double> angles_rad, Eigen::Matrix3Xf& shift_m) {
  shift_m.setZero(3, static_cast<Eigen::Index>(follower.nodes.size()));
  for (const FollowerTable& table : follower.tables) add_shift(table, angles_rad, shift_m);
}

void place_follower(const geometry::TetMesh& mesh, const Skeleton& skeleton, Follower& follower,
                    Eigen::VectorXd& position_m) {
  std::vector<double> angles_rad;
  for (int j = 0; j < skeleton.joint_count(); ++j) angles_rad.push_back(skeleton.angle_rad(j));
  if (angles_rad == follower.placed_rad) return;
  std::vector<Affine> maps;
  follower_maps(follower, skeleton, maps);
  Eigen::Matrix3Xf shift_m;
  if (!follower.tables.empty()) follower_shift(follower, angles_rad, shift_m);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    Vec3 rest_m = mesh.nodes_m[i];
    if (!follower.tables.empty()) rest_m += shift_m.col(column).cast<double>();
    position_m.segment<3>(3 * column) = maps[i] * rest_m;
  }
  follower.placed_rad = angles_rad;
}

}  // namespace myotact::simulation
