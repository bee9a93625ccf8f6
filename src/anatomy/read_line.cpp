#include "anatomy/read_line.h"

#include "anatomy/read_reference.h"
#include "anatomy/read_wrap.h"

namespace myotact::anatomy {
namespace {

LinePoint read_line_point(const JsonValue& value, const Specimen& specimen) {
  JsonObject fields(value);
  LinePoint point;
  point.body = reference(fields.at("body"), specimen.bodies, "body");
  point.position_m = fields.at("position_m").vec3();
  const std::string kind = fields.at("kind").one_of({"origin", "via", "insertion"});
  point.kind = kind == "origin" ? LinePointKind::Origin : kind == "via" ? LinePointKind::Via : LinePointKind::Insertion;
  fields.finish();
  return point;
}

LineWrap read_wrap(const JsonValue& value, const Specimen& specimen) {
  JsonObject fields(value);
  LineWrap wrap = read_wrap_shape(fields);
  wrap.body = reference(fields.at("body"), specimen.bodies, "body");
  wrap.after = fields.at("after").integer_between(0, 1'000'000);  // how many points there are is checked later
  fields.finish();
  return wrap;
}

}  // namespace

MuscleLine read_line(const JsonValue& value, const Specimen& specimen) {
  JsonObject fields(value);
  MuscleLine line;
  line.muscle = reference(fields.at("muscle"), specimen.muscles, "muscle");
  for (const JsonValue& point : fields.at("points").elements()) line.points.push_back(read_line_point(point, specimen));
  if (const auto wraps = fields.find("wraps")) {
    for (const JsonValue& wrap : wraps->elements()) line.wraps.push_back(read_wrap(wrap, specimen));
  }
  fields.finish();
  return line;
}

}  // namespace myotact::anatomy
