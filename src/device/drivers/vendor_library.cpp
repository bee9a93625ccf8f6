#include "device/drivers/vendor_library.h"

#include <algorithm>

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.h"

namespace myotact::device {

VendorLibrary::VendorLibrary(const std::string& what, const std::vector<std::string>& names) : what_(what) {
  std::string tried;
  for (const std::string& name : names) {
    // All its symbols now, so that a missing one shows here and not in a tick; none of them for anybody else. Never out
    // of memory again: threads that it leaves behind would go on in what is no more.
    if (void* handle = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
      handle_ = {handle, [](void* loaded) { ::dlclose(loaded); }};
      path_ = name;
      return;
    }
    const char* why = ::dlerror();
    tried += (tried.empty() ? "" : "; ") + (why != nullptr ? std::string(why) : name);
  }
  const auto is_searched = [](const std::string& name) { return name.find('/') == std::string::npos; };
  if (std::any_of(names.begin(), names.end(), is_searched)) {
    tried += " (looked for in LD_LIBRARY_PATH, the folders of /etc/ld.so.conf.d, /lib and /usr/lib)";
  }
  throw Error(ExitStatus::Unavailable, fmt::format("{} does not load: {}", what, tried));
}

void* VendorLibrary::address(const char* symbol) const {
  if (void* found = address_or_null(symbol)) return found;
  throw Error(ExitStatus::Unavailable,
              fmt::format("{} ({}) has no {}: another version of it is needed", what_, path_, symbol));
}

void* VendorLibrary::address_or_null(const char* symbol) const noexcept {
  return ::dlsym(handle_.get(), symbol);
}

}  // namespace myotact::device
