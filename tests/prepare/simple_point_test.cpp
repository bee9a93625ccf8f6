#include "prepare/part/simple_point.h"

#include <random>

#include <gtest/gtest.h>

#include "prepare/field/level_set.h"
#include "prepare/part/film.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {
namespace {

constexpr Neighbourhood kMiddleBit = Neighbourhood{1} << 13;
constexpr double kStep_m = 1e-3;

/// Pieces and handles of the surface that is extracted around the nodes of a block, the rest of space being outside.
std::pair<std::size_t, int> pieces_and_genus(Neighbourhood body) {
  const auto field = [&](const Vec3& p) {
    double nearest_m = 3.0 * kStep_m;
    for (int bit = 0; bit < 27; ++bit) {
      if ((body >> bit & 1U) == 0) continue;
      const Vec3 node_m = kStep_m * Vec3(bit % 3, bit / 3 % 3, bit / 9);
      nearest_m = std::min(nearest_m, (p - node_m).norm());
    }
    return nearest_m - 0.6 * kStep_m;
  };
  const Eigen::AlignedBox3d box(Vec3::Constant(-kStep_m), Vec3::Constant(3.0 * kStep_m));
  const geometry::TriangleMesh surface = extract_level_set(field, box, kStep_m);
  return {pieces_of(surface).size(), genus(surface)};
}

TEST(SimplePoint, GoesWithoutChangingPiecesOrTunnels) {
  std::mt19937 random(7);
  int simple = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Neighbourhood body = (random() & ((1U << 27) - 1U)) | kMiddleBit;
    if (!is_simple(body)) continue;
    ++simple;
    EXPECT_EQ(pieces_and_genus(body), pieces_and_genus(body & ~kMiddleBit)) << body;
  }
  EXPECT_GT(simple, 300);
}

TEST(SimplePoint, StaysWhereItHoldsTogetherOrCloses) {
  const Neighbourhood all = (1U << 27) - 1U;
  EXPECT_FALSE(is_simple(all));                               // inside: a cavity would open
  EXPECT_FALSE(is_simple(kMiddleBit));                        // alone: a piece would be lost
  EXPECT_FALSE(is_simple(kMiddleBit | 1U << 12 | 1U << 14));  // in a row: it would come apart
  const Neighbourhood layer = 0777U << 9;                     // the nine nodes of one z
  EXPECT_FALSE(is_simple(layer));                             // in a sheet: a handle would open
  EXPECT_TRUE(is_simple(layer | 0777U));                      // under the surface of a thick one
  EXPECT_TRUE(is_simple(kMiddleBit | 1U << 12));              // at the end of a row
}

}  // namespace
}  // namespace myotact::prepare
