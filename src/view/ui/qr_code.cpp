#include "view/ui/qr_code.h"

#include <memory>

#include <qrencode.h>

#include "core/at.h"

namespace myotact::view {

bool QrCode::is_dark(int row, int column) const {
  const bool inside = row >= 0 && column >= 0 && row < width && column < width;
  return inside && dark[at(row * width + column)];
}

std::optional<QrCode> qr_code(const std::string& text) {
  const std::unique_ptr<QRcode, decltype(&QRcode_free)> code(QRcode_encodeString8bit(text.c_str(), 0, QR_ECLEVEL_L),
                                                             &QRcode_free);
  if (!code) return std::nullopt;
  QrCode made{code->width, {}};
  for (int module = 0; module < code->width * code->width; ++module) made.dark.push_back((code->data[module] & 1) != 0);
  return made;
}

}  // namespace myotact::view
