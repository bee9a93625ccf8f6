#pragma once

#include <filesystem>
#include <optional>

#include "prepare/partition/part_volume.h"

// A volume of parts on disk: NAME.seg.nrrd, a segmentation like any other, whose segments are named after the parts'
// keys; and NAME.margins.nrrd, one byte for each border point in the lattice's order (a line of numbers: where they
// belong follows from the labels, which takes half the room of a volume of margins).

namespace myotact::prepare {

/// NAME.margins.nrrd beside NAME.seg.nrrd.
std::filesystem::path margins_beside(const std::filesystem::path& labels);

/// Both files. Throws Error InputOutput.
void write_part_volume(const std::filesystem::path& labels, const PartVolume& volume);

/// The margins of a volume that was read from `labels`; nothing when there are none beside it. Throws Error BadData
/// when they do not belong to it.
std::optional<std::vector<std::uint8_t>> read_margins(const std::filesystem::path& labels, const Lattice& lattice,
                                                      const Labels& volume);

}  // namespace myotact::prepare
