#pragma once

namespace myotact::testing {

#if defined(__SANITIZE_ADDRESS__)  // how g++ says it
inline constexpr bool kAddressSanitizer = true;
#elif defined(__has_feature)  // how clang++ does
inline constexpr bool kAddressSanitizer = __has_feature(address_sanitizer);
#else
inline constexpr bool kAddressSanitizer = false;
#endif

}  // namespace myotact::testing
