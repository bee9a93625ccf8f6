#pragma once

#include "anatomy/specimen.h"
#include "core/json_reader.h"
#include "learn/lesson.h"

namespace myotact::learn {

/// A step's `task`. Throws Error BadData.
Task read_task(const JsonValue& value, const anatomy::Specimen& specimen);

/// The part of that key, muscle or bone; throws Error BadData that names the nearest one.
Part require_part(const JsonValue& name, const anatomy::Specimen& specimen);
int require_muscle(const JsonValue& name, const anatomy::Specimen& specimen);
int require_bone(const JsonValue& name, const anatomy::Specimen& specimen);

}  // namespace myotact::learn
