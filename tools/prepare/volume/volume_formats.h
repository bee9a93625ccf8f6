#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "prepare/volume/byte_source.h"
#include "prepare/volume/volume_header.h"

// One reader of headers a format. All throw Error BadData naming file, field, value, what is allowed and a remedy.

namespace myotact::prepare {

/// A header, and where the bytes of its points are.
struct VolumeFile {
  VolumeHeader header;
  std::string data_file;        // its name in the header's folder; empty: after the header
  std::string data_file_field;  // that names it
  bool packed = false;          // by gzip or zlib
  std::int64_t skip_lines = 0;  // before the points, in the file as it is
  std::int64_t skip_bytes = 0;  // then, of the unpacked bytes; -1: the points are the last bytes
};

/// Each leaves `source` behind the header.
VolumeFile read_nrrd_header(ByteSource& source, const std::string& file);
VolumeFile read_nifti_header(ByteSource& source, const std::string& file);
VolumeFile read_meta_image_header(ByteSource& source, const std::string& file);

/// Text of a NRRD header, apart from what it means.
struct NrrdText {
  std::vector<std::pair<std::string, std::string>> fields;  // "sizes" -> "3 4 5"; names with small letters
  std::vector<std::pair<std::string, std::string>> pairs;   // "Segment0_Name" -> "femur"
};
/// The segments that 3D Slicer names in a header's key/value pairs, by number.
std::vector<Segment> read_slicer_segments(const NrrdText& text, const std::string& file);

}  // namespace myotact::prepare
