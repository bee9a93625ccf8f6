#include "prepare/volume/dicom.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

bool is_dicom_file(const fs::path& path) {
  const std::string ending = lower(path.extension().string());
  if (ending == ".dcm" || ending == ".dicom" || ending == ".ima" || lower(path.filename().string()) == "dicomdir") {
    return true;
  }
  std::error_code unreadable;
  if (!fs::is_regular_file(path, unreadable)) return false;
  constexpr std::streamoff kPreamble_bytes = 128;
  std::array<char, 4> magic{};
  std::ifstream file(path, std::ios::binary);
  file.seekg(kPreamble_bytes);
  return file.read(magic.data(), magic.size()) && std::string_view(magic.data(), magic.size()) == "DICM";
}

/// The first files by name; a scanner's folder holds nothing else.
bool holds_dicom(const fs::path& folder) {
  constexpr std::size_t kLooked = 50;
  std::vector<fs::path> files;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  files.resize(std::min(files.size(), kLooked));
  return std::any_of(files.begin(), files.end(), is_dicom_file);
}

}  // namespace

void refuse_dicom(const fs::path& path) {
  std::error_code unreadable;
  const bool folder = fs::is_directory(path, unreadable);
  if (folder ? !holds_dicom(path) : !is_dicom_file(path)) return;
  throw bad_data(path.string(), "",
                 std::string(folder ? "is a folder of DICOM files" : "is a DICOM file") +
                     ", which are not read. Open it in 3D Slicer, segment the parts there (or load the DICOM "
                     "segmentation) and save it as .seg.nrrd; dcm2niix turns it into .nii.gz, which a program like "
                     "ITK-SNAP segments");
}

}  // namespace myotact::prepare
