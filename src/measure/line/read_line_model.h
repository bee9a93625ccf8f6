#pragma once

#include "core/json_reader.h"
#include "measure/line/line_model_file.h"

namespace myotact::measure {

/// load_line_model() of a file's content.
LineModel read_line_model(const JsonValue& value);

}  // namespace myotact::measure
