#include "layer/report_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "floor_engine.h"

namespace myotact::layer {
namespace {

using ::testing::HasSubstr;

messages::ReportedContact good(double depth_m = 1e-3) {
  return {0, {0.01, 0.02, 0.0}, {0, 0, 1}, depth_m};
}

/// A good contact, a bad one and a good one: the bad one goes, and is reported once however often it comes.
void expect_taken_out(const messages::ReportedContact& bad, ReportDefect defect, const std::string& told) {
  FloorEngine engine;
  ReportCheck check(engine);
  for (std::uint64_t times = 1; times <= 3; ++times) {
    messages::ReportedContacts reported;
    reported.count = 3;
    reported.contacts = {good(2e-3), bad, good(1e-3)};
    check.clean(reported);
    ASSERT_EQ(reported.count, 2);
    EXPECT_EQ(reported.contacts[0].penetration_m, 2e-3);
    EXPECT_EQ(reported.contacts[1].penetration_m, 1e-3);
    const auto news = check.take_news();
    ASSERT_EQ(news.size(), times == 1 ? 1u : 0u);
    if (times == 1) {
      EXPECT_THAT(news.front(), HasSubstr("floor: ")) << news.front();
      EXPECT_THAT(news.front(), HasSubstr(told)) << news.front();
    }
    for (const ReportDefectText& text : report_defect_texts()) {
      EXPECT_EQ(check.count(text.defect), text.defect == defect ? times : 0u) << text.name;
    }
  }
}

TEST(ReportCheck, TakesOutWhatIsNoNumber) {
  auto bad = good();
  bad.penetration_m = kNaN;
  expect_taken_out(bad, ReportDefect::NotFinite, "not a number");
  bad = good();
  bad.point_world_m[1] = kNaN;
  expect_taken_out(bad, ReportDefect::NotFinite, "surface 0");
  bad = good();
  bad.normal_world[2] = kNaN;
  expect_taken_out(bad, ReportDefect::NotFinite, "time step");
  bad = good();
  bad.point_world_m[0] = 1e9;
  expect_taken_out(bad, ReportDefect::NotFinite, "not a number");
}

TEST(ReportCheck, TakesOutContactsWithoutANormal) {
  auto bad = good();
  bad.normal_world = {};
  expect_taken_out(bad, ReportDefect::NoNormal, "length 0; must be 1");
  bad.normal_world = {0, 0, 2};
  expect_taken_out(bad, ReportDefect::NoNormal, "length 2");
  bad.normal_world = {0, 0, 0.9};
  expect_taken_out(bad, ReportDefect::NoNormal, "length 0.9");
}

TEST(ReportCheck, TakesOutWhatIsApart) {
  expect_taken_out(good(-1e-3), ReportDefect::NegativeDepth, "-0.001 m; must be 0 or more");
}

TEST(ReportCheck, TakesOutBodiesThatAreNotThere) {
  auto bad = good();
  bad.surface = 1;
  expect_taken_out(bad, ReportDefect::NoSuchBody, "surface 1; must be at least 0 and less than 1");
  bad.surface = -1;
  expect_taken_out(bad, ReportDefect::NoSuchBody, "surface -1");
}

TEST(ReportCheck, TakesOutBodiesThatTheEngineLost) {
  FloorEngine engine;
  engine.lost = true;
  ReportCheck check(engine);
  messages::ReportedContacts reported;
  reported.count = 1;
  reported.contacts[0] = good();
  check.clean(reported);
  EXPECT_EQ(reported.count, 0);
  EXPECT_EQ(check.count(ReportDefect::LostBody), 1u);
}

TEST(ReportCheck, TakesNoMoreThanThereIsRoomFor) {
  FloorEngine engine;
  ReportCheck check(engine);
  messages::ReportedContacts reported;
  reported.contacts.fill(good());
  reported.count = 1'000'000;
  check.clean(reported);
  EXPECT_EQ(reported.count, messages::kMaxReportedContacts);
  reported.count = -3;
  check.clean(reported);
  EXPECT_EQ(reported.count, 0);
  EXPECT_EQ(check.count(ReportDefect::TooMany), 2u);
}

TEST(ReportCheck, AReportOfAToolThatIsNowhereIsNone) {
  FloorEngine engine;
  ReportCheck check(engine);
  messages::ReportedContacts reported;
  reported.tool_world_m[0] = kNaN;
  reported.count = 1;
  reported.contacts[0] = good();
  check.clean(reported);
  EXPECT_EQ(reported.count, 0);
  EXPECT_EQ(reported.tool_world_m[0], 0.0);
  EXPECT_EQ(check.count(ReportDefect::NotFinite), 1u);
}

TEST(ReportCheck, CountsUnsoundSurfacesAndSilences) {
  FloorEngine engine;
  ReportCheck check(engine);
  messages::LocalModel model;
  check.look_at(model);
  EXPECT_EQ(check.count(ReportDefect::UnsoundSurface), 0u);
  model.vertex_count = 1;
  model.current_world_m[0][0] = kNaN;
  check.look_at(model);
  EXPECT_EQ(check.count(ReportDefect::UnsoundSurface), 1u);
  check.note_silence(0.25);
  EXPECT_EQ(check.count(ReportDefect::Silent), 1u);
  const auto news = check.take_news();
  ASSERT_EQ(news.size(), 2u);
  EXPECT_THAT(news[1], HasSubstr("nothing for 0.25 s"));
}

TEST(ReportCheck, EveryDefectHasAText) {
  const auto texts = report_defect_texts();
  for (std::size_t i = 0; i < kReportDefects; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(texts[i].defect), i);
    EXPECT_FALSE(texts[i].name.empty() || texts[i].remedy.empty());
  }
}

}  // namespace
}  // namespace myotact::layer
