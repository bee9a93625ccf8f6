#pragma once

#include <optional>
#include <string>
#include <vector>

namespace myotact::view {

/// A QR code (ISO/IEC 18004), without the light margin that readers need around it.
struct QrCode {
  int width = 0;           // modules a side
  std::vector<bool> dark;  // row by row

  /// Light outside, too.
  bool is_dark(int row, int column) const;
};

/// Empty for a text that is too long for one.
std::optional<QrCode> qr_code(const std::string& text);

}  // namespace myotact::view
