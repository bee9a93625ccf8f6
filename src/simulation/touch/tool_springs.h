#pragma once

#include <span>
#include <vector>

#include "messages/tool_state.h"
#include "simulation/limb/limb.h"
#include "simulation/touch/local_patch.h"

namespace myotact::simulation {

/// What the springs of tools hang on: skins and bones in the scene's numbering of surfaces (muscles, then bones).
struct TouchableParts {
  const anatomy::Specimen& specimen;     // whose surfaces and lines the states name
  std::span<const SkinEmbedding> skins;  // one a muscle
};

/// The way to a surface on which a hand's touch is prepared for [m]: that of a hand at 0.5 m/s while a step of 10 ms is
/// made and the next one is played.
inline constexpr double kAhead_m = 0.015;

/// For each tool in a hand that holds and touches nothing: a spring without any noticeable force at the nearest place
/// of the surfaces, within kAhead_m of its sphere's middle. With it the solve tells how that place gives way, so that
/// the hand need not take it for rigid when it gets there, and a muscle asleep wakes in time.
std::vector<ToolSpring> springs_ahead(std::span<const messages::ToolState> tools, const TouchableParts& parts,
                                      const LocalPatch& patch);

/// Springs that the tools' states ask for, tool by tool: the coupling spring of each contact, of each muscle line and
/// of each bone in hand, none of which pulls harder than a hand could. States that name something that does not exist,
/// or numbers that are not finite, give no spring: a client may send anything.
std::vector<ToolSpring> tool_springs(std::span<const messages::ToolState> tools, const TouchableParts& parts,
                                     const Limb& limb);

}  // namespace myotact::simulation
