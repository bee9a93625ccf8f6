#pragma once

#include <functional>

#include "prepare/limb_work.h"

// What happens to a limb between reading and writing, one function a stage. Each works on all parts, in as many threads
// as the settings say, calls `done` after each part (from any of these threads), fills in the reports, and throws Error
// BadData naming part, stage, place and remedy.

namespace myotact::prepare {

using PartDone = std::function<void()>;

/// Surfaces become closed, outward and free of crossings, or are refused.
void repair_surfaces(LimbWork& limb, const PartDone& done);
/// Muscles give way to each other and to the bones.
void part_muscles(LimbWork& limb, const PartDone& done);
/// Surfaces of thousands of triangles become fine ones and skins.
void remesh_surfaces(LimbWork& limb, const PartDone& done);
/// Cages, filled with tetrahedra.
void fill_cages(LimbWork& limb, const PartDone& done);
/// The parts of the cages that are fixed to bodies.
void attach_muscles(LimbWork& limb, const PartDone& done);
/// Fibre directions, sections and regions.
void lay_fibres(LimbWork& limb, const PartDone& done);
/// Muscle lines and their moment arms.
void trace_lines(LimbWork& limb, const PartDone& done);
/// Skins that still reach into each other are moved apart; what remains is listed.
void settle_skins(LimbWork& limb, const PartDone& done);

}  // namespace myotact::prepare
