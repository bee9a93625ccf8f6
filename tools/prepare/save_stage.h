#pragma once

#include <filesystem>

#include "prepare/limb_work.h"

namespace myotact::prepare {

/// Writes a limb that is still on its way, for people who look at one stage: what the surfaces are by now
/// (bones/KEY.ply, muscles/KEY.ply: a scan in metres that can be prepared further), and, as far as there are any, skins
/// (skins/KEY.ply), tets with fibres (cages/KEY.vtk) and the reports (stage.jsonl). Throws Error InputOutput.
void save_stage(const LimbWork& limb, const std::filesystem::path& folder);

}  // namespace myotact::prepare
