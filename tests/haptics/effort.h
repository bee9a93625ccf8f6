#pragma once

namespace myotact::haptics {

#if defined(__SANITIZE_ADDRESS__)  // how g++ says it
inline constexpr bool kAddressSanitizer = true;
#elif defined(__has_feature)  // how clang++ does
inline constexpr bool kAddressSanitizer = __has_feature(address_sanitizer);
#else
inline constexpr bool kAddressSanitizer = false;
#endif

/// Ticks that a long case plays. Unoptimised code under the address sanitizer runs some hundred times slower: there a
/// tenth of the ticks looks for broken memory, the whole number is for the release build.
inline constexpr int kEffort = kAddressSanitizer ? 1 : 10;

}  // namespace myotact::haptics
