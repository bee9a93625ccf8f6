#include "prepare/volume/read_label_volume.h"

#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "prepare/volume/dicom.h"
#include "prepare/volume/header_text.h"
#include "prepare/volume/pieces.h"
#include "prepare/volume/read_points.h"
#include "prepare/volume/volume_formats.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

using ReadHeader = VolumeFile (*)(ByteSource& source, const std::string& file);

struct Format {
  std::string_view ending;
  ReadHeader read_header;
};

constexpr std::array<Format, 6> kFormats = {{{".nrrd", read_nrrd_header},
                                             {".nhdr", read_nrrd_header},
                                             {".nii", read_nifti_header},
                                             {".nii.gz", read_nifti_header},
                                             {".mha", read_meta_image_header},
                                             {".mhd", read_meta_image_header}}};

const Format* format_of(const std::string& file) {
  const std::string name = lower(file);
  const auto found = std::find_if(kFormats.begin(), kFormats.end(),
                                  [&](const Format& format) { return name.ends_with(format.ending); });
  return found == kFormats.end() ? nullptr : &*found;
}

std::string known_endings() {
  std::vector<std::string> endings;
  for (const Format& format : kFormats) endings.emplace_back(format.ending);
  return join(endings);
}

void skip_to_points(const VolumeFile& volume, ByteSource& source, const std::string& file) {
  const std::uint64_t left = source.most_left();
  const std::uint64_t needed = size_of_points(volume.header);
  const bool from_the_end = volume.skip_bytes < 0 && left >= needed;
  const std::uint64_t skipped =
      volume.skip_bytes < 0 ? (from_the_end ? left - needed : 0) : static_cast<std::uint64_t>(volume.skip_bytes);
  if (source.skip(skipped) == skipped) return;
  throw bad_data(file, "byte skip", fmt::format("is {}, but the file ends before; correct it", volume.skip_bytes));
}

std::vector<Labels> points_of(const VolumeFile& volume, ByteSource& source, const std::string& file) {
  for (std::int64_t line = 0; line < volume.skip_lines; ++line) {
    if (source.line(0)) continue;
    throw bad_data(file, "line skip", fmt::format("is {}, but the file ends before; correct it", volume.skip_lines));
  }
  if (!volume.packed) {
    skip_to_points(volume, source, file);
    return read_points(volume.header, source, file);
  }
  const std::unique_ptr<ByteSource> plain = unpacked(source, file);
  skip_to_points(volume, *plain, file);
  return read_points(volume.header, *plain, file);
}

/// A body has fewer parts; an image of grey values has thousands.
constexpr std::size_t kMostSegments = 1000;

/// The file's segments that occur, with the labels that it does not name.
void name_segments(LabelVolume& volume, std::vector<Segment> named, const std::string& file) {
  for (std::size_t layer = 0; layer < volume.layers.size(); ++layer) {
    std::vector<char> occurs(65'536, 0);
    for (const std::uint16_t label : volume.layers[layer]) occurs[label] = 1;
    for (int label = 1; label < static_cast<int>(occurs.size()); ++label) {
      if (!occurs[at(label)]) continue;
      const auto name = std::find_if(named.begin(), named.end(), [&](const Segment& segment) {
        return segment.layer == static_cast<int>(layer) && segment.label == label;
      });
      Segment segment{fmt::format("label {}", label), label, static_cast<int>(layer), {}};
      if (name != named.end()) {
        if (!name->name.empty()) segment.name = name->name;
        segment.hints = std::move(name->hints);
        named.erase(name);
      }
      volume.segments.push_back(std::move(segment));
    }
  }
  std::vector<std::string> empty;
  for (const Segment& segment : named) empty.push_back("\"" + segment.name + "\"");
  if (!empty.empty()) volume.notes.push_back("segments that hold no point of their own, left out: " + join(empty));
  if (volume.segments.empty()) {
    throw bad_data(file, "data", "holds no segment: every point is 0. Save the segmentation, not an empty volume");
  }
  if (volume.segments.size() > kMostSegments) {
    throw bad_data(file, "data",
                   fmt::format("holds {} labels; must be 1 .. {}. Save the segmentation, not the image that it was "
                               "made of",
                               volume.segments.size(), kMostSegments));
  }
}

LabelVolume assemble(VolumeFile read, std::vector<Labels> layers, const std::string& file) {
  LabelVolume volume;
  volume.notes = std::move(read.header.notes);
  volume.lattice = lattice_of(read.header, file, volume.notes);
  volume.layers = std::move(layers);
  name_segments(volume, std::move(read.header.segments), file);
  for (std::string& note : piece_notes(volume)) volume.notes.push_back(std::move(note));
  return volume;
}

const Format& known_format(const std::string& file) {
  if (const Format* format = format_of(file)) return *format;
  throw bad_data(
      file, "",
      fmt::format("is no segmented volume by its name; must end with one of {}. Save the segmentation as one "
                  "of them (in 3D Slicer: .seg.nrrd)",
                  known_endings()));
}

/// The lattice is checked before any memory is taken for points.
VolumeFile checked_header(const Format& format, ByteSource& source, const std::string& file) {
  VolumeFile volume = format.read_header(source, file);
  std::vector<std::string> notes;
  lattice_of(volume.header, file, notes);
  return volume;
}

/// `source` as it is, or unpacked where all of it is packed, the header too (NIfTI).
class PlainSource {
 public:
  PlainSource(ByteSource& source, const std::string& file) : plain_(source) {
    if (source.peek(2) == "\x1f\x8b") unpacked_ = unpacked(source, file);
  }
  ByteSource& get() { return unpacked_ ? *unpacked_ : plain_; }

 private:
  ByteSource& plain_;
  std::unique_ptr<ByteSource> unpacked_;
};

}  // namespace

bool is_label_volume(const fs::path& path) {
  return format_of(path.filename().string()) != nullptr;
}

LabelVolume read_label_volume(const fs::path& path) {
  refuse_dicom(path);
  const std::string file = path.string();
  const Format& format = known_format(file);
  const std::unique_ptr<ByteSource> bytes = open_bytes(path);
  PlainSource source(*bytes, file);
  VolumeFile volume = checked_header(format, source.get(), file);
  if (volume.data_file.empty()) {
    std::vector<Labels> layers = points_of(volume, source.get(), file);
    return assemble(std::move(volume), std::move(layers), file);
  }
  const fs::path data = data_file_beside(path, volume.data_file, volume.data_file_field);
  const std::unique_ptr<ByteSource> beside = open_bytes(data);
  std::vector<Labels> layers = points_of(volume, *beside, data.string());
  return assemble(std::move(volume), std::move(layers), file);
}

LabelVolume parse_label_volume(std::string_view text, const std::string& file) {
  const Format& format = known_format(file);
  const std::unique_ptr<ByteSource> bytes = bytes_in_memory(text);
  PlainSource source(*bytes, file);
  VolumeFile volume = checked_header(format, source.get(), file);
  if (!volume.data_file.empty()) {
    throw bad_data(file, volume.data_file_field, "names another file; must hold its own points");
  }
  std::vector<Labels> layers = points_of(volume, source.get(), file);
  return assemble(std::move(volume), std::move(layers), file);
}

}  // namespace myotact::prepare
