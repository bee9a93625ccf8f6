#pragma once

#include <span>
#include <vector>

#include "messages/tool_state.h"
#include "simulation/limb/limb.h"

namespace myotact::simulation {

/// What the springs of tools hang on: skins and bones in the scene's numbering of surfaces (muscles, then bones).
struct TouchableParts {
  const anatomy::Specimen& specimen;     // whose surfaces and lines the states name
  std::span<const SkinEmbedding> skins;  // one a muscle
};

/// Springs that the tools' states ask for, tool by tool: the coupling spring of each contact, of each muscle line and
/// of each bone in hand, none of which pulls harder than a hand could. States that name something that does not exist,
/// or numbers that are not finite, give no spring: a client may send anything.
std::vector<ToolSpring> tool_springs(std::span<const messages::ToolState> tools, const TouchableParts& parts,
                                     const Limb& limb);

}  // namespace myotact::simulation
