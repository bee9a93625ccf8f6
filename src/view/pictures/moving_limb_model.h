#pragma once

#include <array>
#include <vector>

#include "anatomy/specimen.h"
#include "geometry/glb.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// What moves of a frame.
struct LimbMoment {
  double time_s = 0.0;
  std::vector<std::array<double, 12>> body_poses;                // as in a frame
  std::vector<std::vector<std::array<float, 3>>> skins_world_m;  // likewise
};

/// How far a vertex of a moving model may be from where the frame has it.
inline constexpr double kModelTolerance_m = 5e-5;

/// The limb of limb_model() as it moves: bones are translated and rotated; a muscle's skin is that of the first moment
/// plus so many shapes, with weights over time, as keep every vertex of every moment within the tolerance. The shapes
/// are the strongest ones of its motion (proper orthogonal decomposition), so that a file of seconds stays small. Times
/// begin at 0. At least one moment, all of this specimen.
geometry::GlbScene moving_limb_model(const anatomy::Specimen& specimen, const std::vector<LimbMoment>& moments,
                                     const ViewState& view);

}  // namespace myotact::view
