#pragma once

#include "anatomy/specimen.h"
#include "core/json_reader.h"

namespace myotact::anatomy {

/// A body as specimens and recipes write it: key, mass_kg, com_m, inertia_kg_m2, estimated. Throws Error BadData naming
/// file and JSON pointer.
Body read_body(const JsonValue& value);

}  // namespace myotact::anatomy
