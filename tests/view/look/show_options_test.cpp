#include "view/look/show_options.h"

#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/synthetic_specimen.h"
#include "view/look/limb_bounds.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

class ShowOptions : public ::testing::Test {
 protected:
  ViewState after(const std::vector<std::string>& options) const {
    ViewState view = start_;
    apply_show_options(options, specimen_, view);
    return view;
  }
  std::string message_of(const std::string& option) const {
    try {
      after({option});
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::Usage);
      return error.what();
    }
    ADD_FAILURE() << option << " was taken";
    return {};
  }

  anatomy::Specimen specimen_ = myotact::testing::antagonist_hinge();
  ViewState start_ = start_view(specimen_, 1.0f);
};

TEST_F(ShowOptions, EachSettingChangesWhatItNames) {
  ViewState wanted = start_;
  wanted.muscles[1].hidden = true;
  EXPECT_EQ(after({"muscles=flexor"}), wanted);
  EXPECT_EQ(after({"muscles=none", "muscles=all"}), start_);
  wanted = start_;
  wanted.muscles[0].faded = wanted.bones[0].faded = true;
  EXPECT_EQ(after({"faded=flexor," + specimen_.bones[0].key}), wanted);
  wanted = start_;
  wanted.selected_bone = 1;
  EXPECT_EQ(after({"select=extensor", "select=" + specimen_.bones[1].key}), wanted);
  wanted = start_;
  wanted.colour = MuscleColour::StiffnessShare;
  wanted.names = NameStyle::Both;
  wanted.labels = wanted.fibres = wanted.attachments = true;
  wanted.lines = false;
  wanted.layers = {0.0f, 1.0f, 1.0f};
  EXPECT_EQ(after({"colour=stiffness_share", "names=both", "labels=on", "fibres=on", "attachments=on", "lines=off",
                   "layers=deep,bones"}),
            wanted);
}

TEST_F(ShowOptions, ASectionCutsTheSideThatItNames) {
  EXPECT_EQ(after({"section=cranial:0.75"}).section, (SectionPlane{true, false, 0, 0.75f}));
  EXPECT_EQ(after({"section=caudal:0.75"}).section, (SectionPlane{true, true, 0, 0.25f}));
  EXPECT_EQ(after({"section=right:0.5"}).section, (SectionPlane{true, true, 1, 0.5f}));
  EXPECT_EQ(after({"section=dorsal:1"}).section, (SectionPlane{true, false, 2, 1.0f}));
}

TEST_F(ShowOptions, AWrongWordIsNamedWithTheNearestKnownOne) {
  using ::testing::HasSubstr;
  EXPECT_THAT(message_of("muscles=flexer"), ::testing::AllOf(HasSubstr("\"flexer\""), HasSubstr("\"flexor\"")));
  EXPECT_THAT(message_of("color=kind"), HasSubstr("\"colour\""));
  EXPECT_THAT(message_of("colour=activated"), HasSubstr("\"activation\""));
  EXPECT_THAT(message_of("labels=yes"), HasSubstr("off, on"));
  for (const char* wrong : {"", "=", "labels", "labels=", "muscles=", "muscles=flexor,,extensor", "section=cranial",
                            "section=cranial:", "section=cranial:2", "section=cranial:nan", "section=up:0.5",
                            "section=cranial:0.5:0.5", "layers=bone"}) {
    EXPECT_FALSE(message_of(wrong).empty()) << wrong;
  }
}

TEST_F(ShowOptions, ViewsAreNamesOrAngles) {
  const ViewBox box = bounds_of(specimen_);
  EXPECT_EQ(camera_of("cranial", specimen_, box, 1.5f), *standard_view("cranial", true, box, 1.5f));
  const Camera oblique = camera_of("-30,20", specimen_, box, 1.5f);
  EXPECT_NEAR(oblique.azimuth_rad, -std::numbers::pi / 6.0, 1e-6);
  EXPECT_NEAR(oblique.elevation_rad, std::numbers::pi / 9.0, 1e-6);
  for (const char* wrong : {"", "anterior", "30", "30,", "30,95", "1e9,0", "nan,0", "30,10,5"}) {
    EXPECT_THROW(camera_of(wrong, specimen_, box, 1.5f), Error) << wrong;
  }
}

TEST_F(ShowOptions, SizesAreWidthTimesHeight) {
  EXPECT_EQ(picture_size_of("1280x720").width, 1280);
  EXPECT_EQ(picture_size_of("1280x720").height, 720);
  for (const char* wrong : {"", "1280", "x", "1280x", "0x720", "1280x720x3", "1e9x10", "12.5x100", "-100x100"}) {
    EXPECT_THROW(picture_size_of(wrong), Error) << wrong;
  }
}

}  // namespace
}  // namespace myotact::view
