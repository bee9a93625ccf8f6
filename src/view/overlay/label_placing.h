#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace myotact::view {

/// A name that wants to stand beside the picture of its part. Pixels, y down.
struct LabelWish {
  int id = 0;
  glm::vec2 anchor{0.0f};  // on the part
  glm::vec2 size{0.0f};
  float middle = 0.0f;  // x of the middle of what is named, at this height: anchors before it go to the left
  float weight = 0.0f;  // where there is no room for all, the heaviest stay
};

/// Where names may stand: in a column at either side of what is named, within the whole.
struct LabelArea {
  glm::vec2 lowest{0.0f}, highest{0.0f};
  float subject_left = 0.0f, subject_right = 0.0f;  // of the picture of the parts
  float gap = 2.0f;                                 // between names, at least
};

struct PlacedLabel {
  int id = 0;
  glm::vec2 corner{0.0f};  // top left
  bool on_left = false;

  bool operator==(const PlacedLabel&) const = default;
};

/// Places names so that none overlaps another and each lies in the area, as near to the height of its anchor as that
/// lets it (least squares); leader lines of a column do not cross at its names. What does not fit is left out.
/// `previous`: names change sides only when their anchors have moved well past the middle.
std::vector<PlacedLabel> place_labels(std::span<const LabelWish> wishes, const LabelArea& area,
                                      std::span<const PlacedLabel> previous = {});

}  // namespace myotact::view
