#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "anatomy/specimen.h"
#include "geometry/tet_mesh.h"
#include "simulation/follower/line_frames.h"
#include "simulation/skeleton/skeleton.h"

namespace myotact::simulation {

/// What a node's motion is blended from. Shares sum to 1.
struct FollowerNode {
  static constexpr std::size_t kMostBodies = 3;
  std::size_t station = 0;     // the one before it along the line
  double station_share = 0.0;  // of that station, and of the next
  double next_share = 0.0;
  std::array<int, kMostBodies> bodies{-1, -1, -1};
  std::array<double, kMostBodies> body_shares{};  // 0 where there is none
};

/// Displacements of the rest position at sampled angles of one joint, between them linear. Zero at the file pose.
struct FollowerTable {
  int joint = -1;
  std::vector<double> angles_rad;              // rising, at least 2
  std::vector<Eigen::Matrix3Xf> rest_shift_m;  // one a sample, one column a node
};

/// A muscle that nothing solves for and that follows the bones. p = M(q) (x + shift(q)): x the node's rest position,
/// M its blend of the maps along the muscle's line (line_frames.h) and of the bodies that clamp the muscle, shift what
/// keeps it on the bones and out of them (bone_fit.h).
struct Follower {
  LineFrames frames;
  std::vector<FollowerNode> nodes;    // one a node of the mesh
  std::vector<FollowerTable> tables;  // none: line and bodies alone
  int only_body = -1;                 // with which all of it moves; else -1
  std::vector<double> placed_rad;     // the angles it was placed at last; empty: not yet
};

/// `attachment`: one a node, body or -1. `skeleton` in any pose. The mesh has tets with volume, the line at least 2
/// points.
Follower make_follower(const geometry::TetMesh& mesh, const std::vector<int>& attachment,
                       const anatomy::MuscleLine& line, const Skeleton& skeleton);

/// Maps of all nodes in the skeleton's pose, without the tables.
void follower_maps(const Follower& follower, const Skeleton& skeleton, std::vector<Affine>& maps);
/// Sum of the tables' shifts at these angles (one a joint; outside a table's range its end counts), one column a node.
void follower_shift(const Follower& follower, std::span<const double> angles_rad, Eigen::Matrix3Xf& shift_m);

/// Puts all nodes (3 numbers a node, world) where the skeleton's pose has them. Does nothing when the pose is the one
/// it was placed in last.
void place_follower(const geometry::TetMesh& mesh, const Skeleton& skeleton, Follower& follower,
                    Eigen::VectorXd& position_m);

}  // namespace myotact::simulation
