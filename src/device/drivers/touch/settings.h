#pragma once

#include <string>
#include <vector>

namespace myotact::device::touch {

struct TouchSettings {
  std::string library;  // path of libHD; empty: where the maker installs it
  /// Names of the devices as the maker's setup program has them, the first one "touch", the second "touch:2"; empty
  /// name: its default device.
  std::vector<std::string> configurations{""};
  /// What CHAI3D holds for safe with a Touch. The maker's library reports a figure of its own, but not in which unit:
  /// its manual says 0 .. 1, its example newtons a millimetre.
  double max_stiffness_N_m = 400.0;
};

}  // namespace myotact::device::touch
