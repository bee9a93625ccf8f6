#pragma once

namespace myotact::haptics {

/// Ticks that a long case plays. Unoptimised code under the address sanitizer runs some hundred times slower: there a
/// tenth of the ticks looks for broken memory, the whole number is for the release build.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr int kEffort = 1;
#else
inline constexpr int kEffort = 10;
#endif

}  // namespace myotact::haptics
