#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "prepare/volume/label_volume.h"

// Volumes for 3D Slicer and for read_label_volume(): NRRD in LPS millimetres, gzip, the same bytes for the same volume.

namespace myotact::prepare {

/// Writes a segmentation (name it .seg.nrrd, as Slicer wants): unsigned char or, for labels above 255, short; several
/// layers as Slicer's list. Segments keep name, label and layer; Slicer colours them by their order. The file is
/// written whole or not at all. Throws Error InputOutput.
void write_label_volume(const std::filesystem::path& path, const LabelVolume& volume);

/// Writes one byte a point, x fastest, without segments. Throws Error InputOutput.
void write_scalars(const std::filesystem::path& path, const Lattice& lattice, std::span<const std::uint8_t> bytes);

}  // namespace myotact::prepare
