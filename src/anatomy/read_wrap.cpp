#include "anatomy/read_wrap.h"

#include <Eigen/Geometry>

namespace myotact::anatomy {

using geometry::WrapShape;

Mat3 axes_about(const Vec3& axis) {
  Mat3 axes;
  axes.row(2) = axis.transpose();
  axes.row(0) = axis.unitOrthogonal().transpose();
  axes.row(1) = axis.cross(Vec3(axes.row(0))).transpose();
  return axes;
}

LineWrap read_wrap_shape(JsonObject& fields) {
  LineWrap wrap;
  const std::string shape = fields.at("shape").one_of({"cylinder", "sphere", "ellipsoid"});
  wrap.shape = shape == "cylinder" ? WrapShape::Cylinder : shape == "sphere" ? WrapShape::Sphere : WrapShape::Ellipsoid;
  wrap.centre_m = fields.at("centre_m").vec3();
  wrap.side = fields.at("side").vec3();
  if (wrap.shape == WrapShape::Cylinder) wrap.axes = axes_about(fields.at("axis").vec3());
  if (wrap.shape != WrapShape::Ellipsoid) {
    wrap.radii_m.setConstant(fields.at("radius_m").number());
    return wrap;
  }
  wrap.radii_m = fields.at("radii_m").vec3();
  const auto rows = fields.at("axes").elements(3);
  for (int row = 0; row < 3; ++row) wrap.axes.row(row) = rows[static_cast<std::size_t>(row)].vec3().transpose();
  return wrap;
}

}  // namespace myotact::anatomy
