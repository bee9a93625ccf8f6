#include "view/look/visibility.h"

namespace myotact::view {

float opacity_of(const ViewState& view, const std::vector<bool>& superficial, const Part& part) {
  const PartLook& look = look_of(view, part);
  if (look.hidden) return 0.0f;
  const float share = look.faded ? kFadedShare : 1.0f;
  if (part.kind == PartKind::Bone) return share * view.layers.bones;
  const auto m = static_cast<std::size_t>(part.index);
  const bool outer = m >= superficial.size() || superficial[m];
  return share * (outer ? view.layers.superficial : view.layers.deep);
}

glm::vec4 kept_half_space(const SectionPlane& section, const ViewBox& limb) {
  if (!section.on) return {0.0f, 0.0f, 0.0f, 1.0f};
  const float place_m =
      limb.lowest_m[section.axis] + section.share * (limb.highest_m[section.axis] - limb.lowest_m[section.axis]);
  glm::vec4 half_space(0.0f);
  half_space[section.axis] = section.flipped ? 1.0f : -1.0f;
  half_space.w = section.flipped ? -place_m : place_m;
  return half_space;
}

}  // namespace myotact::view
