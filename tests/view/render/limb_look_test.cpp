// The look of a muscle in pictures: strands along its fibres that fade with distance, tendon that is whiter.

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"
#include "view/pictures/offscreen.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

constexpr int kSize = 240;

/// A bar of 120 x 40 x 40 mm with fibres along x, seen from +y: fibres run across the picture. Its last third is
/// tendon.
class LimbLook : public ::testing::Test {
 protected:
  void SetUp() override {
    specimen_ = myotact::testing::single_muscle({{-0.09, 0.0, 0.03}, 0.12, 0.04, {12, 4, 4}, 4});
    try {
      renderer_ = std::make_unique<OffscreenRenderer>(specimen_, kSize, kSize);
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
  }
  /// Of the belly's middle, from where a pixel is so wide.
  Image from(float pixel_m, float target_x_m = -0.06f) const {
    ViewState view = start_view(specimen_, 1.0f);
    view.lines = false;
    view.camera.target_world_m = {target_x_m, 0.02f, 0.03f};
    view.camera.azimuth_rad = 1.5707963f;
    view.camera.elevation_rad = 0.0f;
    view.camera.distance_m = 0.5f * kSize * pixel_m / std::tan(0.5f * Camera::kFieldOfView_rad);
    return renderer_->render(myotact::testing::frame_at_rest(specimen_), view);
  }
  static double brightness(const Image& image, int x, int y) {
    const auto i = 3 * static_cast<std::size_t>(y * image.width + x);
    return image.rgb[i] + image.rgb[i + 1] + image.rgb[i + 2];
  }
  /// Mean change from a pixel to the next, in a square of pixels round the middle.
  static double roughness(const Image& image, int dx, int dy, int half) {
    double sum = 0.0;
    for (int y = kSize / 2 - half; y < kSize / 2 + half; ++y) {
      for (int x = kSize / 2 - half; x < kSize / 2 + half; ++x) {
        sum += std::abs(brightness(image, x + dx, y + dy) - brightness(image, x, y));
      }
    }
    return sum / (4.0 * half * half);
  }

  anatomy::Specimen specimen_;
  std::unique_ptr<OffscreenRenderer> renderer_;
};

TEST_F(LimbLook, StrandsRunAlongTheFibres) {
  const Image near = from(1e-4f);
  const double across = roughness(near, 0, 1, 80), along = roughness(near, 1, 0, 80);
  EXPECT_GT(across, 2.0);  // of 765
  EXPECT_GT(across, 3.0 * along);
}

TEST_F(LimbLook, StrandsFadeWithDistanceInsteadOfFlickering) {
  // Bundles of 5 mm at 0.1 mm a pixel, at 1 mm, and where a pixel is as wide as a bundle.
  const double shallow = roughness(from(1e-3f), 0, 1, 12);
  const double none = roughness(from(4e-3f), 0, 1, 3);
  EXPECT_GT(shallow, 1.0);
  EXPECT_LT(none, 4.0);  // what is left is the light, which falls off over the whole bar
  // Half a pixel to the side the far picture stays as it is.
  const Image far = from(4e-3f), shifted = from(4e-3f, -0.06f + 2e-3f);
  EXPECT_NEAR(brightness(far, kSize / 2, kSize / 2), brightness(shifted, kSize / 2, kSize / 2), 6.0);
}

TEST_F(LimbLook, ABellyIsRedAndTendonWhite) {
  const Image belly = from(2e-4f), tendon = from(2e-4f, 0.02f);
  const auto i = 3 * static_cast<std::size_t>(kSize / 2 * kSize + kSize / 2);
  EXPECT_GT(belly.rgb[i], 2 * belly.rgb[i + 1]);
  EXPECT_LT(tendon.rgb[i] - tendon.rgb[i + 2], 60);
  EXPECT_GT(tendon.rgb[i + 1], 1.5 * belly.rgb[i + 1]);
}

}  // namespace
}  // namespace myotact::view
