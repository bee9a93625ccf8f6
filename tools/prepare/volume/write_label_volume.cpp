#include "prepare/volume/write_label_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <zlib.h>

#include "core/at.h"
#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "prepare/volume/specimen_frame.h"

namespace myotact::prepare {

namespace {

constexpr double kMillimetresPerMetre = 1e3;

/// Packs bytes with gzip. No time and no system in its header, so that the bytes depend on nothing else.
class GzipWriter {
 public:
  explicit GzipWriter(std::string& out) : out_(out), buffer_(std::size_t{1} << 16) {
    constexpr int kGzip = 16 + MAX_WBITS;
    constexpr int kMemory = 8;  // zlib's own choice
    header_.os = 255;           // unknown
    if (deflateInit2(&stream_, Z_BEST_COMPRESSION, Z_DEFLATED, kGzip, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) {
      throw Error(ExitStatus::Internal, "zlib cannot start: no memory");
    }
    deflateSetHeader(&stream_, &header_);
  }
  ~GzipWriter() { deflateEnd(&stream_); }
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  void add(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kMost = std::size_t{1} << 30;  // zlib counts 32 bits
    while (!bytes.empty()) {
      const auto part = bytes.first(std::min(bytes.size(), kMost));
      deflate_all(part, Z_NO_FLUSH);
      bytes = bytes.subspan(part.size());
    }
  }
  void finish() { deflate_all({}, Z_FINISH); }

 private:
  void deflate_all(std::span<const std::uint8_t> bytes, int flush) {
    stream_.next_in = const_cast<Bytef*>(bytes.data());  // zlib's interface lacks the const
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
      stream_.next_out = buffer_.data();
      stream_.avail_out = static_cast<uInt>(buffer_.size());
      deflate(&stream_, flush);
      out_.append(reinterpret_cast<const char*>(buffer_.data()), buffer_.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  std::string& out_;
  std::vector<Bytef> buffer_;
  z_stream stream_{};
  gz_header header_{};
};

/// "(x,y,z)" of a vector in the specimen frame, as LPS millimetres.
std::string lps_text(const Vec3& specimen_m) {
  const Vec3 lps_mm = kMillimetresPerMetre * (specimen_from_lps().transpose() * specimen_m);
  const auto text = [](double value) { return to_text(value == 0.0 ? 0.0 : value); };  // no "-0"
  return fmt::format("({},{},{})", text(lps_mm.x()), text(lps_mm.y()), text(lps_mm.z()));
}

std::string header_of(const Lattice& lattice, std::size_t layers, const char* type) {
  const bool list = layers > 1;
  const auto& n = lattice.counts;
  std::string header = "NRRD0005\n";
  header += fmt::format("type: {}\ndimension: {}\nspace: left-posterior-superior\n", type, list ? 4 : 3);
  header += fmt::format("sizes: {}{} {} {}\n", list ? fmt::format("{} ", layers) : "", n[0], n[1], n[2]);
  header += fmt::format("space directions: {}{} {} {}\n", list ? "none " : "", lps_text(lattice.steps_m.col(0)),
                        lps_text(lattice.steps_m.col(1)), lps_text(lattice.steps_m.col(2)));
  header += fmt::format("kinds: {}domain domain domain\nendian: little\nencoding: gzip\n", list ? "list " : "");
  return header + fmt::format("space origin: {}\n", lps_text(lattice.origin_m));
}

/// Colours that lie far apart for neighbours in the list: each hue is a golden section from the last.
Vec3 colour_of(std::size_t index) {
  constexpr double kGoldenSection = 0.6180339887498949;
  const double hue = std::fmod(static_cast<double>(index) * kGoldenSection, 1.0);
  Vec3 colour;
  for (int channel = 0; channel < 3; ++channel) {
    const double away = std::abs(std::fmod(hue + channel / 3.0, 1.0) * 6.0 - 3.0);  // 0 opposite .. 3 at the channel
    colour[channel] = 0.35 + 0.55 * std::clamp(away - 1.0, 0.0, 1.0);               // neither black nor glaring
  }
  return colour;
}

struct Box {
  std::array<int, 3> low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<int>::max()};
  std::array<int, 3> high{-1, -1, -1};

  void extend(const std::array<int, 3>& point) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }
};

/// Of every label of a layer: the points that it reaches to. Slicer shows nothing outside.
std::vector<Box> boxes_of(const Labels& labels, const Lattice& lattice) {
  std::vector<Box> boxes(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1);
  std::size_t point = 0;
  std::array<int, 3> p{};
  for (p[2] = 0; p[2] < lattice.counts[2]; ++p[2]) {
    for (p[1] = 0; p[1] < lattice.counts[1]; ++p[1]) {
      for (p[0] = 0; p[0] < lattice.counts[0]; ++p[0], ++point) {
        if (labels[point] != 0) boxes[labels[point]].extend(p);
      }
    }
  }
  return boxes;
}

/// As NRRD wants it in a key/value pair: on one line.
std::string escaped(const std::string& text) {
  std::string line;
  for (const char c : text) {
    if (c == '\\') {
      line += "\\\\";
    } else if (c == '\n') {
      line += "\\n";
    } else {
      line += c == '\r' ? ' ' : c;
    }
  }
  return line;
}

std::string segment_fields(const Segment& segment, std::size_t number, const Box& box) {
  const Vec3 colour = colour_of(number);
  const std::string start = fmt::format("Segment{}_", number);
  std::string fields;
  fields += fmt::format("{}Color:={:.6g} {:.6g} {:.6g}\n", start, colour.x(), colour.y(), colour.z());
  fields += start + "ColorAutoGenerated:=1\n";
  fields += fmt::format("{}Extent:={} {} {} {} {} {}\n", start, box.low[0], box.high[0], box.low[1], box.high[1],
                        box.low[2], box.high[2]);
  fields += fmt::format("{}ID:=Segment_{}\n", start, number + 1);
  fields += fmt::format("{}LabelValue:={}\n", start, segment.label);
  fields += fmt::format("{}Layer:={}\n", start, segment.layer);
  fields += fmt::format("{}Name:={}\n", start, escaped(segment.name));
  return fields + start + "NameAutoGenerated:=0\n" + start + "Tags:=|\n";
}

std::string segmentation_fields(const LabelVolume& volume) {
  std::string fields;
  for (std::size_t layer = 0; layer < volume.layers.size(); ++layer) {
    const std::vector<Box> boxes = boxes_of(volume.layers[layer], volume.lattice);
    for (std::size_t i = 0; i < volume.segments.size(); ++i) {
      const Segment& segment = volume.segments[i];
      if (segment.layer == static_cast<int>(layer)) fields += segment_fields(segment, i, boxes[at(segment.label)]);
    }
  }
  return fields +
         "Segmentation_ContainedRepresentationNames:=Binary labelmap|\n"
         "Segmentation_ConversionParameters:=\n"
         "Segmentation_MasterRepresentation:=Binary labelmap\n"
         "Segmentation_ReferenceImageExtentOffset:=0 0 0\n";
}

/// The labels of all layers, point by point, in as many bytes each.
void pack(GzipWriter& gzip, const LabelVolume& volume, std::size_t bytes_each) {
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  std::vector<std::uint8_t> chunk;
  for (std::size_t point = 0; point < volume.lattice.size(); ++point) {
    for (const Labels& layer : volume.layers) {
      chunk.push_back(static_cast<std::uint8_t>(layer[point] & 0xff));
      if (bytes_each == 2) chunk.push_back(static_cast<std::uint8_t>(layer[point] >> 8));
    }
    if (chunk.size() < kChunk) continue;
    gzip.add(chunk);
    chunk.clear();
  }
  gzip.add(chunk);
}

}  // namespace

void write_label_volume(const std::filesystem::path& path, const LabelVolume& volume) {
  require_writable(path);
  const bool wide = std::any_of(volume.layers.begin(), volume.layers.end(), [](const Labels& layer) {
    return std::any_of(layer.begin(), layer.end(), [](std::uint16_t label) { return label > 255; });
  });
  std::string bytes = header_of(volume.lattice, volume.layers.size(), wide ? "unsigned short" : "unsigned char");
  bytes += segmentation_fields(volume) + "\n";
  GzipWriter gzip(bytes);
  pack(gzip, volume, wide ? 2 : 1);
  gzip.finish();
  write_file(path, bytes);
}

void write_scalars(const std::filesystem::path& path, const Lattice& lattice, std::span<const std::uint8_t> bytes) {
  require_writable(path);
  std::string file = header_of(lattice, 1, "unsigned char") + "\n";
  GzipWriter gzip(file);
  gzip.add(bytes);
  gzip.finish();
  write_file(path, file);
}

}  // namespace myotact::prepare
