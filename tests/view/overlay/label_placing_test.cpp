#include "view/overlay/label_placing.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace myotact::view {
namespace {

LabelArea area_of(float width, float height) {
  return {{10.0f, 5.0f}, {10.0f + width, 5.0f + height}, 0.4f * width, 0.6f * width, 3.0f};
}

bool overlap(const PlacedLabel& a, const glm::vec2& a_size, const PlacedLabel& b, const glm::vec2& b_size) {
  return a.corner.x < b.corner.x + b_size.x && b.corner.x < a.corner.x + a_size.x &&
         a.corner.y < b.corner.y + b_size.y && b.corner.y < a.corner.y + a_size.y;
}

const LabelWish& wish_of(const std::vector<LabelWish>& wishes, int id) {
  return *std::find_if(wishes.begin(), wishes.end(), [id](const LabelWish& wish) { return wish.id == id; });
}

void expect_apart_and_inside(const std::vector<LabelWish>& wishes, const LabelArea& area,
                             const std::vector<PlacedLabel>& placed) {
  constexpr float kRounding_px = 1e-2f;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const glm::vec2 size = wish_of(wishes, placed[i].id).size;
    EXPECT_GE(placed[i].corner.x, area.lowest.x - kRounding_px);
    EXPECT_GE(placed[i].corner.y, area.lowest.y - kRounding_px);
    EXPECT_LE(placed[i].corner.x + size.x, area.highest.x + kRounding_px);
    EXPECT_LE(placed[i].corner.y + size.y, area.highest.y + kRounding_px);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(overlap(placed[i], size, placed[j], wish_of(wishes, placed[j].id).size));
    }
  }
}

std::vector<LabelWish> random_wishes(std::mt19937& random, const LabelArea& area, int count) {
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  std::vector<LabelWish> wishes;
  for (int i = 0; i < count; ++i) {
    const glm::vec2 room = area.highest - area.lowest;
    wishes.push_back({i,
                      area.lowest + room * glm::vec2(share(random), share(random)),
                      {20.0f + 200.0f * share(random), share(random) < 0.3f ? 30.0f : 15.0f},
                      area.lowest.x + 0.5f * room.x,
                      share(random)});
  }
  return wishes;
}

TEST(LabelPlacing, NoNameEverOverlapsAnotherOrLeavesTheArea) {
  std::mt19937 random(11);
  for (int round = 0; round < 400; ++round) {
    const LabelArea area =
        area_of(60.0f + static_cast<float>(random() % 1500), 20.0f + static_cast<float>(random() % 900));
    const auto wishes = random_wishes(random, area, static_cast<int>(random() % 60));
    expect_apart_and_inside(wishes, area, place_labels(wishes, area));
  }
}

TEST(LabelPlacing, WhereThereIsRoomEachNameStandsAtTheHeightOfItsAnchorOnItsSide) {
  const LabelArea area = area_of(1000.0f, 600.0f);
  const std::vector<LabelWish> wishes{{1, {420.0f, 100.0f}, {80.0f, 16.0f}, 500.0f, 1.0f},
                                      {2, {580.0f, 300.0f}, {90.0f, 16.0f}, 500.0f, 1.0f}};
  const auto placed = place_labels(wishes, area);
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0], (PlacedLabel{1, {area.subject_left - 80.0f, 92.0f}, true}));
  EXPECT_EQ(placed[1], (PlacedLabel{2, {area.subject_right, 292.0f}, false}));
}

TEST(LabelPlacing, NamesThatCrowdAreShiftedAsLittleAsPossible) {
  // Two of the same height at the same place: half of height and gap each way.
  const LabelArea area = area_of(1000.0f, 600.0f);
  const std::vector<LabelWish> wishes{{1, {600.0f, 300.0f}, {80.0f, 16.0f}, 500.0f, 1.0f},
                                      {2, {620.0f, 300.0f}, {80.0f, 16.0f}, 500.0f, 1.0f}};
  const auto placed = place_labels(wishes, area);
  EXPECT_NEAR(placed[0].corner.y, 292.0f - 9.5f, 1e-3f);
  EXPECT_NEAR(placed[1].corner.y, 292.0f + 9.5f, 1e-3f);
}

TEST(LabelPlacing, TheHeaviestStayWhereThereIsNoRoomForAll) {
  std::mt19937 random(5);
  const LabelArea area = area_of(500.0f, 60.0f);
  const auto wishes = random_wishes(random, area, 30);
  const auto placed = place_labels(wishes, area);
  ASSERT_FALSE(placed.empty());
  EXPECT_LT(placed.size(), wishes.size());
  const auto heaviest =
      std::max_element(wishes.begin(), wishes.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
  EXPECT_TRUE(std::any_of(placed.begin(), placed.end(), [&](const auto& p) { return p.id == heaviest->id; }));
}

TEST(LabelPlacing, ATremblingAnchorDoesNotSendItsNameFromSideToSide) {
  const LabelArea area = area_of(1000.0f, 600.0f);
  std::vector<LabelWish> wishes{{1, {499.0f, 100.0f}, {80.0f, 16.0f}, 500.0f, 1.0f}};
  auto placed = place_labels(wishes, area);
  EXPECT_TRUE(placed[0].on_left);
  wishes[0].anchor.x = 503.0f;
  placed = place_labels(wishes, area, placed);
  EXPECT_TRUE(placed[0].on_left);
  wishes[0].anchor.x = 560.0f;
  placed = place_labels(wishes, area, placed);
  EXPECT_FALSE(placed[0].on_left);
}

}  // namespace
}  // namespace myotact::view
