#include "view/pictures/contact_sheet.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"
#include "view/view_frame.h"

namespace myotact::view {
namespace {

using myotact::testing::frame_at_rest;

class ContactSheetOfAHinge : public ::testing::Test {
 protected:
  Image sheet(const std::vector<messages::SceneFrame>& rows, const std::vector<std::string>& columns) const {
    return draw_contact_sheet(specimen_, {rows, columns, {60, 80}}, start_view(specimen_, 0.75f));
  }
  /// The lower bone lifted by a right angle, about -y; the muscles stay.
  messages::SceneFrame lifted() const {
    messages::SceneFrame frame = frame_at_rest(specimen_);
    frame.body_poses[1] = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0};
    return frame;
  }
  static bool same_cell(const Image& image, std::array<int, 2> a, std::array<int, 2> b) {
    for (int y = 0; y < 80; ++y) {
      for (int x = 0; x < 3 * 60; ++x) {
        const auto at = [&](std::array<int, 2> cell) {
          return image.rgb[static_cast<std::size_t>((80 * cell[1] + y) * 3 * image.width + 3 * 60 * cell[0] + x)];
        };
        if (at(a) != at(b)) return false;
      }
    }
    return true;
  }

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
};

TEST_F(ContactSheetOfAHinge, HasAStateARowAndASideAColumn) {
  Image image;
  try {
    image = sheet({frame_at_rest(specimen_), lifted(), frame_at_rest(specimen_)}, {"lateral", "cranial", "lateral"});
  } catch (const Error& error) {
    if (error.status() != ExitStatus::Unavailable) throw;
    GTEST_SKIP() << error.what();
  }
  EXPECT_EQ(image.width, 180);
  EXPECT_EQ(image.height, 240);
  EXPECT_TRUE(same_cell(image, {0, 0}, {2, 0}));
  EXPECT_TRUE(same_cell(image, {1, 0}, {1, 2}));
  EXPECT_FALSE(same_cell(image, {0, 0}, {1, 0}));
  EXPECT_FALSE(same_cell(image, {0, 0}, {0, 1}));
}

TEST_F(ContactSheetOfAHinge, RefusesNothingAndTooMuch) {
  const auto status = [&](const std::vector<messages::SceneFrame>& rows, const std::vector<std::string>& columns) {
    try {
      sheet(rows, columns);
    } catch (const Error& error) {
      return error.status();
    }
    return ExitStatus::Done;
  };
  EXPECT_EQ(status({}, {"lateral"}), ExitStatus::Usage);
  EXPECT_EQ(status({frame_at_rest(specimen_)}, {}), ExitStatus::Usage);
  EXPECT_EQ(status(std::vector<messages::SceneFrame>(205), {"lateral"}), ExitStatus::Usage);
}

}  // namespace
}  // namespace myotact::view
