#include "anatomy/read_body.h"

namespace myotact::anatomy {

Body read_body(const JsonValue& value) {
  JsonObject fields(value);
  Body body;
  body.key = fields.at("key").string();
  body.mass_kg = fields.at("mass_kg").number_between(1e-6, 1e3);
  body.com_m = fields.at("com_m").vec3();
  const auto inertia = fields.at("inertia_kg_m2").elements(6);
  for (std::size_t i = 0; i < 6; ++i) body.inertia_kg_m2[i] = inertia[i].number();
  body.estimated = fields.boolean_or("estimated", true);
  fields.finish();
  return body;
}

}  // namespace myotact::anatomy
