#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "prepare/volume/label_volume.h"

// Segmented volumes of other programs: NRRD 0001 to 0005 (.nrrd, .nhdr with its data file beside it, 3D Slicer's
// .seg.nrrd with its layers), NIfTI-1 and -2 (.nii, .nii.gz), MetaImage (.mha, .mhd with its data file beside it).
// tools/prepare/volume/README.md says what is taken of each.

namespace myotact::prepare {

/// Whether the file's name is that of a format which read_label_volume() reads; the content is not looked at.
bool is_label_volume(const std::filesystem::path& path);

/// Reads labels, names and places; brings the lattice to metres in the specimen frame (specimen_frame.h). At least one
/// segment. Notes tell the sampling, what was taken for granted, empty segments and segments in several pieces. Takes 2
/// bytes a point and layer, and never more than the file can fill. Throws Error: NoInput when the file or its data file
/// is not there, BadData when it cannot be used, naming file, field, value, what is allowed and a remedy.
LabelVolume read_label_volume(const std::filesystem::path& path);

/// The same of a file's bytes in memory, named `file` in errors and by its ending; data files beside it are refused.
LabelVolume parse_label_volume(std::string_view bytes, const std::string& file);

}  // namespace myotact::prepare
