#pragma once

#include "support/sanitizer.h"

namespace myotact::haptics {

/// Ticks that a long case plays. Unoptimised code under the address sanitizer runs some hundred times slower: there a
/// tenth of the ticks looks for broken memory, the whole number is for the release build.
inline constexpr int kEffort = testing::kAddressSanitizer ? 1 : 10;

}  // namespace myotact::haptics
