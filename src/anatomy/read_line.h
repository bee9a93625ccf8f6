#pragma once

#include "anatomy/specimen.h"
#include "core/json_reader.h"

namespace myotact::anatomy {

/// A line as specimens and scenes write it: muscle, points (body, position_m, kind) and wraps, with the keys of
/// `specimen`. Throws Error BadData naming file and JSON pointer. Whether it makes sense is for find_line_defects.h.
MuscleLine read_line(const JsonValue& value, const Specimen& specimen);

}  // namespace myotact::anatomy
