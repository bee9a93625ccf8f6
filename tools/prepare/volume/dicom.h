#pragma once

#include <filesystem>

namespace myotact::prepare {

/// Throws Error BadData that names programs which convert, when the path is a DICOM file, by its ending or its content,
/// or a folder that holds one. Scanners write DICOM; it holds grey values, as a rule, and no segmentation.
void refuse_dicom(const std::filesystem::path& path);

}  // namespace myotact::prepare
