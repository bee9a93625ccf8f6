#pragma once

#include <string>

#include "measure/stiffness_row.h"

namespace myotact::measure {

/// Why the joint is as stiff as the row says, in one to three sentences for a student: which part of K is largest and
/// which muscle has most of it, what works against it, and, where the joint is unstable, what would change that.
std::string explain_stiffness(const StiffnessRow& row);

}  // namespace myotact::measure
