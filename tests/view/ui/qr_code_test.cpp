#include "view/ui/qr_code.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

/// Seven modules a side: a dark ring, a light one, a dark middle (ISO/IEC 18004, finder patterns).
bool is_finder_dark(int row, int column) {
  const int ring = std::max(std::abs(row - 3), std::abs(column - 3));
  return ring == 3 || ring <= 1;
}

TEST(QrCode, ReadersFindItByThreeOfItsCornersAndCountItByTheLinesBetween) {
  const auto code = qr_code("http://192.168.7.5:7481/#token=00112233445566778899aabbccddeeff");
  ASSERT_TRUE(code);
  EXPECT_EQ((code->width - 17) % 4, 0) << "every version has four modules more a side";
  const int far = code->width - 7;
  for (const auto& [top, left] : {std::array{0, 0}, std::array{0, far}, std::array{far, 0}}) {
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 7; ++column) {
        EXPECT_EQ(code->is_dark(top + row, left + column), is_finder_dark(row, column)) << row << ' ' << column;
      }
    }
  }
  for (int i = 8; i < far - 1; ++i) {
    EXPECT_EQ(code->is_dark(6, i), i % 2 == 0);
    EXPECT_EQ(code->is_dark(i, 6), i % 2 == 0);
  }
  EXPECT_FALSE(code->is_dark(-1, 0) || code->is_dark(0, code->width)) << "the margin is light";
}

TEST(QrCode, ATextThatIsTooLongHasNone) {
  EXPECT_FALSE(qr_code(std::string(5000, 'x'))) << "the largest holds 2953 bytes";
}

}  // namespace
}  // namespace myotact::view
