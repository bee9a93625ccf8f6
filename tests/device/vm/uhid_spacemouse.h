#pragma once

#include <cstdint>
#include <vector>

namespace myotact::device::spacemouse {

/// A SpaceMouse Compact in software on the kernel's own HID stack, by /dev/uhid.
class UhidSpaceMouse {
 public:
  /// Plugs it in. Throws std::runtime_error: no /dev/uhid, or no right to use it.
  UhidSpaceMouse();
  ~UhidSpaceMouse();
  UhidSpaceMouse(const UhidSpaceMouse&) = delete;
  UhidSpaceMouse& operator=(const UhidSpaceMouse&) = delete;

  void send(const std::vector<std::uint8_t>& report) const;
  /// The output reports that came since the last call.
  std::vector<std::vector<std::uint8_t>> outputs() const;
  void unplug();

 private:
  int file_ = -1;
};

}  // namespace myotact::device::spacemouse
