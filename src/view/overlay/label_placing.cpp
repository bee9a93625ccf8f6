#include "view/overlay/label_placing.h"

#include <algorithm>
#include <cmath>

namespace myotact::view {

namespace {

/// An anchor is past the middle when it is so far beyond it, as a share of the subject's width.
constexpr float kStay = 0.12f;

struct Column {
  std::vector<LabelWish> wishes;
  float height = 0.0f;  // of all names, with a gap below each

  void add(const LabelWish& wish, float gap) {
    wishes.push_back(wish);
    height += wish.size.y + gap;
  }
  float widest() const {
    float width = 0.0f;
    for (const LabelWish& wish : wishes) width = std::max(width, wish.size.x);
    return width;
  }
};

/// Tops of names that follow one another, nearest to where they would like to be: the wishes less the heights before
/// them are made to rise by pooling neighbours that do not (isotonic regression).
std::vector<float> spread(const Column& column, const LabelArea& area) {
  struct Pool {
    float sum = 0.0f;
    int count = 0;
    float mean() const { return sum / static_cast<float>(count); }
  };
  std::vector<Pool> pools;
  float before = 0.0f;
  for (const LabelWish& wish : column.wishes) {
    pools.push_back({wish.anchor.y - 0.5f * wish.size.y - before, 1});
    before += wish.size.y + area.gap;
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back() = {pools.back().sum + last.sum, pools.back().count + last.count};
    }
  }
  const float lowest = area.lowest.y, highest = std::max(lowest, area.highest.y - before + area.gap);
  std::vector<float> tops;
  before = 0.0f;
  for (const Pool& pool : pools) {
    for (int i = 0; i < pool.count; ++i) {
      tops.push_back(std::clamp(pool.mean(), lowest, highest) + before);
      before += column.wishes[tops.size() - 1].size.y + area.gap;
    }
  }
  return tops;
}

bool prefers_left(const LabelWish& wish, const LabelArea& area, std::span<const PlacedLabel> previous) {
  const auto before = std::find_if(previous.begin(), previous.end(), [&](const auto& p) { return p.id == wish.id; });
  if (before == previous.end()) return wish.anchor.x < wish.middle;
  const float stay = kStay * (area.subject_right - area.subject_left);
  return wish.anchor.x < wish.middle + (before->on_left ? stay : -stay);
}

void place_column(Column& column, const LabelArea& area, bool on_left, std::vector<PlacedLabel>& placed) {
  std::stable_sort(column.wishes.begin(), column.wishes.end(), [](const LabelWish& a, const LabelWish& b) {
    return a.anchor.y != b.anchor.y ? a.anchor.y < b.anchor.y : a.id < b.id;
  });
  const std::vector<float> tops = spread(column, area);
  const float widest = column.widest();
  const float inner = on_left ? std::max(area.subject_left, area.lowest.x + widest)
                              : std::min(area.subject_right, area.highest.x - widest);
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const LabelWish& wish = column.wishes[i];
    placed.push_back({wish.id, {on_left ? inner - wish.size.x : inner, tops[i]}, on_left});
  }
}

}  // namespace

std::vector<PlacedLabel> place_labels(std::span<const LabelWish> wishes, const LabelArea& area,
                                      std::span<const PlacedLabel> previous) {
  std::vector<LabelWish> order(wishes.begin(), wishes.end());
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
  const glm::vec2 room = area.highest - area.lowest;
  float widest = 0.0f;
  for (const LabelWish& wish : order) {
    if (wish.size.x <= room.x) widest = std::max(widest, wish.size.x);
  }
  const bool two_columns = 2.0f * widest + area.gap <= room.x;
  Column left, right;
  for (const LabelWish& wish : order) {
    if (wish.size.x > room.x) continue;
    const bool to_left = two_columns && prefers_left(wish, area, previous);
    const auto fits = [&](const Column& column) { return column.height + wish.size.y <= room.y; };
    Column& wanted = to_left ? left : right;
    Column& other = to_left ? right : left;
    if (fits(wanted)) {
      wanted.add(wish, area.gap);
    } else if (two_columns && fits(other)) {
      other.add(wish, area.gap);
    }
  }
  std::vector<PlacedLabel> placed;
  place_column(left, area, true, placed);
  place_column(right, area, false, placed);
  return placed;
}

}  // namespace myotact::view
