#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "exchange/opensim_model.h"
#include "exchange/opensim_writer.h"
#include "simulation/line/hill_muscle.h"

namespace myotact::exchange::opensim {
namespace {

using geometry::WrapShape;

/// OpenSim wants a tendon that is longer than nothing.
constexpr double kShortestTendon_m = 1e-6;
/// A shorter one is taken as rigid by the lines, too.
constexpr double kStretchingTendon_m = 1e-4;

std::string wrap_name(const Layout& layout, const anatomy::MuscleLine& line, std::size_t wrap) {
  return fmt::format("{}_wrap_{}", layout.specimen().muscles[at(line.muscle)].key, wrap + 1);
}

/// The surface's frame with the side along x; an ellipsoid's own frame, whose axis next to the side it returns.
struct WrapFrame {
  Mat3 R_LW;
  std::string quadrant = "x";
};

WrapFrame frame_of(const anatomy::LineWrap& wrap) {
  if (wrap.shape == WrapShape::Ellipsoid) {
    const Vec3 side = wrap.axes * wrap.side;
    Eigen::Index axis = 0;
    side.cwiseAbs().maxCoeff(&axis);
    static constexpr const char* kNames[] = {"x", "y", "z"};
    return {wrap.axes.transpose(), std::string(side[axis] < 0.0 ? "-" : "") + kNames[axis]};
  }
  const Vec3 z = wrap.shape == WrapShape::Cylinder ? Vec3(wrap.axes.row(2).transpose()) : wrap.side.unitOrthogonal();
  const Vec3 x = (wrap.side - wrap.side.dot(z) * z).normalized();
  Mat3 R_LW;
  R_LW << x, z.cross(x), z;
  return {R_LW, "x"};
}

/// A specimen's cylinders have no ends; these reach past everything the line does next to them.
double cylinder_length_m(const anatomy::MuscleLine& line, const anatomy::LineWrap& wrap) {
  double reach_m = 0.0;
  for (const int point : {wrap.after, wrap.after + 1}) {
    reach_m = std::max(reach_m, (line.points[at(point)].position_m - wrap.centre_m).norm());
  }
  return 2.0 * (reach_m + wrap.radii_m[0]);
}

void write_wrap(const Layout& layout, const anatomy::MuscleLine& line, std::size_t index, pugi::xml_node objects) {
  static constexpr const char* kTags[] = {"WrapCylinder", "WrapSphere", "WrapEllipsoid"};
  const anatomy::LineWrap& wrap = line.wraps[index];
  const WrapFrame frame = frame_of(wrap);
  Mat3 R_OW;
  for (int c = 0; c < 3; ++c) R_OW.col(c) = Layout::direction(frame.R_LW.col(c));
  pugi::xml_node node = add_named(objects, kTags[static_cast<int>(wrap.shape)], wrap_name(layout, line, index));
  add_text(node, "active", "true");
  add_vec3(node, "xyz_body_rotation", xyz_of(R_OW));
  add_vec3(node, "translation", layout.in_body(wrap.body, wrap.centre_m));
  add_text(node, "quadrant", frame.quadrant);
  if (wrap.shape == WrapShape::Ellipsoid) {
    add_vec3(node, "dimensions", wrap.radii_m);
    return;
  }
  add_number(node, "radius", wrap.radii_m[0]);
  if (wrap.shape == WrapShape::Cylinder) add_number(node, "length", cylinder_length_m(line, wrap));
}

void write_path(const Layout& layout, const anatomy::MuscleLine& line, pugi::xml_node muscle) {
  pugi::xml_node path = add_named(muscle, "GeometryPath", "geometrypath");
  pugi::xml_node points = add_set(path, "PathPointSet");
  const std::string& key = layout.specimen().muscles[at(line.muscle)].key;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    pugi::xml_node point = add_named(points, "PathPoint", fmt::format("{}-P{}", key, i + 1));
    add_text(point, "socket_parent_frame", layout.path(line.points[i].body));
    add_vec3(point, "location", layout.in_body(line.points[i].body, line.points[i].position_m));
  }
  if (line.wraps.empty()) return;
  pugi::xml_node wraps = add_set(path, "PathWrapSet");
  for (std::size_t w = 0; w < line.wraps.size(); ++w) {
    pugi::xml_node wrap = add_named(wraps, "PathWrap", fmt::format("pathwrap_{}", w + 1));
    add_text(wrap, "wrap_object", wrap_name(layout, line, w));
    add_text(wrap, "method", "hybrid");
    add_text(wrap, "range", fmt::format("{} {}", line.wraps[w].after + 1, line.wraps[w].after + 2));
  }
}

double line_length(const anatomy::MuscleLine& line) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const Vec3 &p = line.points[i].position_m, &q = line.points[i + 1].position_m;
    const anatomy::LineWrap* wrap = anatomy::wrap_after(line, i);
    if (wrap == nullptr) sum_m += (q - p).norm();
    if (wrap == nullptr) continue;
    sum_m += geometry::wrap_path(surface_of(*wrap), in_frame_of(*wrap, p), in_frame_of(*wrap, q)).length_m;
  }
  return sum_m;
}

void write_muscle(const Layout& layout, const anatomy::MuscleLine& line, pugi::xml_node forces) {
  const anatomy::Muscle& muscle = layout.specimen().muscles[at(line.muscle)];
  const simulation::HillMuscle hill{muscle.peak_force_N, muscle.optimal_fibre_m, muscle.pennation_rad, 0.0,
                                    simulation::Tendon::Elastic};
  const double slack_m = simulation::tendon_slack_for_m(hill, line_length(line), muscle.rest_stretch);
  pugi::xml_node node = add_named(forces, "Millard2012EquilibriumMuscle", muscle.key);
  write_path(layout, line, node);
  add_number(node, "max_isometric_force", muscle.peak_force_N);
  add_number(node, "optimal_fiber_length", muscle.optimal_fibre_m);
  add_number(node, "tendon_slack_length", std::max(slack_m, kShortestTendon_m));
  add_number(node, "pennation_angle_at_optimal", muscle.pennation_rad);
  add_text(node, "ignore_tendon_compliance", slack_m < kStretchingTendon_m ? "true" : "false");
  add_number(node, "activation_time_constant", muscle.activation_tau_s);
  add_number(node, "deactivation_time_constant", muscle.deactivation_tau_s);
}

}  // namespace

void write_muscles(const Layout& layout, pugi::xml_node forces) {
  for (const anatomy::MuscleLine& line : layout.specimen().lines) write_muscle(layout, line, forces);
}

void write_wraps(const Layout& layout, int body, pugi::xml_node parent) {
  pugi::xml_node objects;
  for (const anatomy::MuscleLine& line : layout.specimen().lines) {
    for (std::size_t w = 0; w < line.wraps.size(); ++w) {
      if (line.wraps[w].body != body) continue;
      if (!objects) objects = add_set(parent, "WrapObjectSet");
      write_wrap(layout, line, w, objects);
    }
  }
}

}  // namespace myotact::exchange::opensim
