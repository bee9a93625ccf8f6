#include "prepare/recipe/read_line.h"

#include <nlohmann/json.hpp>

#include "anatomy/read_wrap.h"
#include "prepare/recipe/index_of.h"

namespace myotact::prepare {
namespace {

using geometry::WrapShape;

/// Farther from its axis than this no joint of a limb is crossed [m].
constexpr double kFarthestCrossing_m = 0.5;

/// A cylinder about the joint's own axis.
anatomy::LineWrap cylinder_about(const anatomy::Joint& joint, JsonObject& fields) {
  if (joint.type != anatomy::JointType::Hinge) {
    throw fields.value().error("its joint is no hinge and has no axis to lie about; give centre_m, axis and side");
  }
  anatomy::LineWrap wrap;
  fields.at("shape").one_of({"cylinder"});
  wrap.shape = WrapShape::Cylinder;
  wrap.centre_m = joint.centre_m;
  wrap.axes = anatomy::axes_about(joint.axes[0]);
  wrap.radii_m.setConstant(fields.at("radius_m").number());
  return wrap;
}

}  // namespace

CrossingData read_crossing(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  CrossingData crossing;
  const JsonValue joint = fields.at("joint");
  crossing.joint = index_of(joint, data.joints, "joint");
  if (data.joints[static_cast<std::size_t>(crossing.joint)].type != anatomy::JointType::Hinge) {
    throw joint.error("must be a hinge: distances are from its axis");
  }
  crossing.proximal_m = fields.at("proximal_m").number_between(0.0, kFarthestCrossing_m);
  if (const auto distal = fields.find("distal_m")) {
    crossing.distal_m = distal->number_between(0.0, kFarthestCrossing_m);
  }
  if (const auto point = fields.find("distal_point_m")) crossing.distal_point_m = point->vec3();
  fields.finish();
  return crossing;
}

WrapData read_wrap(const JsonValue& value, const AnatomyData& data) {
  JsonObject fields(value);
  WrapData wrap;
  wrap.joint = index_of(fields.at("joint"), data.joints, "joint");
  const anatomy::Joint& joint = data.joints[static_cast<std::size_t>(wrap.joint)];
  wrap.side_is_given = value.raw().contains("side");
  const bool own_axis = !value.raw().contains("centre_m") && !wrap.side_is_given;
  wrap.wrap = own_axis ? cylinder_about(joint, fields) : anatomy::read_wrap_shape(fields);
  const auto body = fields.find("body");
  wrap.wrap.body = body ? index_of(*body, data.bodies, "body") : joint.parent;
  fields.finish();
  return wrap;
}

std::vector<anatomy::LinePoint> read_line(const JsonValue& value, const AnatomyData& data) {
  std::vector<anatomy::LinePoint> points;
  for (const JsonValue& v : value.elements()) {
    JsonObject fields(v);
    points.push_back({index_of(fields.at("body"), data.bodies, "body"), fields.at("position_m").vec3(),
                      anatomy::LinePointKind::Via});
    fields.finish();
  }
  if (points.size() < 2) throw value.error("must have two points or more, from origin to insertion");
  points.front().kind = anatomy::LinePointKind::Origin;
  points.back().kind = anatomy::LinePointKind::Insertion;
  return points;
}

}  // namespace myotact::prepare
