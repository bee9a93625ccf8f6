#pragma once

#include <memory>
#include <string>
#include <vector>

namespace myotact::device {

/// A maker's library, loaded while the program runs: it is not part of this program and on most machines not there.
/// Stays loaded as long as one of its copies lives.
class VendorLibrary {
 public:
  /// The first of `names` that loads: paths where they have a slash, else what the system's loader finds.
  /// Throws Error Unavailable naming `what` ("libHD of OpenHaptics"), each name tried and why it did not load.
  VendorLibrary(const std::string& what, const std::vector<std::string>& names);

  const std::string& path() const { return path_; }  // the name that loaded

  /// Lets `function` be the library's `symbol`; the caller vouches for its signature. Throws Error Unavailable naming
  /// library and symbol: another version of it.
  template <typename Function>
  void bind(const char* symbol, Function*& function) const {
    function = reinterpret_cast<Function*>(address(symbol));
  }
  /// The same where older versions may lack it: null then.
  template <typename Function>
  void bind_if_there(const char* symbol, Function*& function) const noexcept {
    function = reinterpret_cast<Function*>(address_or_null(symbol));
  }

 private:
  void* address(const char* symbol) const;
  void* address_or_null(const char* symbol) const noexcept;

  std::string what_, path_;
  std::shared_ptr<void> handle_;
};

}  // namespace myotact::device
