#pragma once

#include <array>
#include <vector>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

/// A triangle mesh of one surface of a scene.
struct TestMesh {
  std::vector<Vec3> vertices_m;
  std::vector<std::array<int, 3>> triangles;  // counter-clockwise from outside
};

/// Square of `cells` x `cells` cells in the plane z = 0, centred, normal +z.
TestMesh make_plane(double side_m, int cells);
/// Two planes that meet in the y axis, each rising outwards at `half_angle_rad` from the vertical; solid below.
TestMesh make_groove(double half_angle_rad, double depth_m, int cells);
/// Subdivided icosahedron: 20 x 4^levels triangles.
TestMesh make_sphere(double radius_m, int levels);
/// Closed box, centred.
TestMesh make_box(const Vec3& size_m, int cells);

/// The part of the mesh around `centre_m` as the simulation would send it: as many of the nearest triangles as fit.
void write_patch(const TestMesh& mesh, const std::vector<Vec3>& previous_m, const std::vector<Vec3>& current_m,
                 const Vec3& centre_m, messages::LocalModel& model);

/// How many times the closed surface winds round a point: 1 inside, 0 outside (van Oosterom and Strackee 1983).
double winding_number(const TestMesh& mesh, const std::vector<Vec3>& vertices_m, const Vec3& point_m);

}  // namespace myotact::haptics
