#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "prepare/volume/header_text.h"
#include "prepare/volume/volume_formats.h"

// MetaImage, ITK's own format (MetaIO's documentation: "Key = value" lines, the last of which is ElementDataFile).
// Places are LPS millimetres.

namespace myotact::prepare {

namespace {

constexpr std::size_t kLongestField = std::size_t{1} << 16;
constexpr int kMostLines = 10'000;

using Fields = std::vector<std::pair<std::string, std::string>>;

Fields read_fields(ByteSource& source, const std::string& file) {
  Fields fields;
  for (int number = 1; number <= kMostLines; ++number) {
    const auto line = source.line(kLongestField);
    if (!line) break;
    if (trimmed(*line).empty()) continue;
    const std::size_t sign = line->find('=');
    if (sign == std::string::npos || line->size() == kLongestField) {
      throw bad_data(file, fmt::format("line {}", number),
                     fmt::format("\"{}\" is not \"Key = value\"; no MetaImage?", line->substr(0, 60)));
    }
    fields.emplace_back(trimmed(line->substr(0, sign)), trimmed(line->substr(sign + 1)));
    if (fields.back().first == "ElementDataFile") return fields;
  }
  throw bad_data(file, "ElementDataFile", "is missing at the end of the header; save the file again");
}

/// A direction by the letters of the side it comes from and goes to: 'R' is from right to left, +x of LPS.
std::optional<Vec3> direction_from(char letter) {
  switch (letter) {
    case 'R':
      return Vec3(1, 0, 0);
    case 'L':
      return Vec3(-1, 0, 0);
    case 'A':
      return Vec3(0, 1, 0);
    case 'P':
      return Vec3(0, -1, 0);
    case 'I':
      return Vec3(0, 0, 1);
    case 'S':
      return Vec3(0, 0, -1);
    default:
      return {};
  }
}

class MetaImageHeader {
 public:
  MetaImageHeader(ByteSource& source, const std::string& file) : file_(file), fields_(read_fields(source, file)) {}

  VolumeFile read() {
    check_kind();
    read_type();
    const auto sizes = parse_integers(at_field("DimSize"), 3, {file_, "DimSize"});
    set_counts(result_.header, {sizes[0], sizes[1], sizes[2]}, 1, file_, "DimSize");
    read_places();
    read_data();
    return std::move(result_);
  }

 private:
  Error error(const std::string& field, const std::string& problem) const { return bad_data(file_, field, problem); }

  /// The value of the first of these names that the file has: some fields have two or three.
  std::optional<std::string> find(std::initializer_list<const char*> names) const {
    for (const char* wanted : names) {
      for (const auto& [name, value] : fields_) {
        if (name == wanted) return value;
      }
    }
    return {};
  }
  std::string at_field(const char* name) const {
    if (auto value = find({name})) return *value;
    throw error(name, "is missing from the header; save the file again");
  }
  bool is_true(std::initializer_list<const char*> names) const {
    const std::string value = lower(find(names).value_or("false"));
    if (value == "true" || value == "1") return true;
    if (value == "false" || value == "0") return false;
    throw error(*names.begin(), fmt::format("\"{}\" must be True or False", value.substr(0, 60)));
  }
  void require(const char* name, const std::string& allowed, const std::string& remedy) const {
    const std::string value = find({name}).value_or(allowed);
    if (lower(value) == lower(allowed)) return;
    throw error(name, fmt::format("\"{}\" must be {}: {}", value.substr(0, 60), allowed, remedy));
  }

  void check_kind() const {
    require("ObjectType", "Image", "only pictures hold labels");
    require("NDims", "3", "save a single volume");
    require("ElementNumberOfChannels", "1", "several values a point are no segmentation");
    require("BinaryData", "True", "save it as binary");
  }

  void read_type() {
    static const std::vector<std::pair<std::string, ScalarType>> kTypes = {
        {"MET_CHAR", {1, true}},        {"MET_UCHAR", {1, false}},      {"MET_SHORT", {2, true}},
        {"MET_USHORT", {2, false}},     {"MET_INT", {4, true}},         {"MET_UINT", {4, false}},
        {"MET_LONG", {4, true}},        {"MET_ULONG", {4, false}},      {"MET_LONG_LONG", {8, true}},
        {"MET_ULONG_LONG", {8, false}}, {"MET_FLOAT", {4, true, true}}, {"MET_DOUBLE", {8, true, true}}};
    const std::string type = at_field("ElementType");
    const auto found = std::find_if(kTypes.begin(), kTypes.end(), [&](const auto& t) { return t.first == type; });
    if (found == kTypes.end()) {
      throw error("ElementType",
                  fmt::format("\"{}\" is no type of numbers that is read; save it as MET_USHORT", type.substr(0, 60)));
    }
    result_.header.type = found->second;
    result_.header.big_endian = is_true({"BinaryDataByteOrderMSB", "ElementByteOrderMSB"});
  }

  double millimetres() const {
    const auto unit = find({"DistanceUnits"});
    if (!unit || *unit == "?") return 1.0;
    if (const auto scale = millimetres_in(*unit)) return *scale;
    throw error("DistanceUnits", fmt::format("\"{}\" must be mm, cm or um", unit->substr(0, 60)));
  }

  /// As ITK says it: by the sides that the axes come from, RAI for LPS. Nothing where it is not known.
  std::optional<Mat3> anatomical_directions() const {
    const auto letters = find({"AnatomicalOrientation"});
    if (!letters || letters->size() != 3 || letters->find('?') != std::string::npos) return {};
    Mat3 directions;
    for (int axis = 0; axis < 3; ++axis) {
      const auto direction = direction_from((*letters)[at(axis)]);
      if (!direction) return {};
      directions.col(axis) = *direction;
    }
    return directions;
  }

  /// The direction of one axis after the other. ITK reads them and only reports AnatomicalOrientation.
  Mat3 read_directions() {
    const auto anatomical = anatomical_directions();
    const auto text = find({"TransformMatrix", "Rotation", "Orientation"});
    if (!text) {
      result_.header.notes.emplace_back(anatomical ? "no TransformMatrix: directions by AnatomicalOrientation"
                                                   : "no directions in the file: taken as left, posterior, superior");
      return anatomical.value_or(Mat3::Identity());
    }
    const auto numbers = parse_numbers(*text, 9, {file_, "TransformMatrix"});
    Mat3 directions;
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 3; ++i) directions(i, axis) = numbers[at(3 * axis + i)];
      const double length = directions.col(axis).norm();
      constexpr double kRounding = 1e-3;
      if (!(std::abs(length - 1.0) <= kRounding)) {
        throw error("TransformMatrix", fmt::format("axis {} is {} long; must be 1: lengths belong into ElementSpacing",
                                                   axis, to_text(length)));
      }
    }
    constexpr double kNear = 0.7;  // within 45 degrees
    if (anatomical && (anatomical->array() * directions.array()).colwise().sum().minCoeff() < kNear) {
      result_.header.notes.push_back(
          fmt::format("AnatomicalOrientation: \"{}\" is not what TransformMatrix says (RAI is none turned); "
                      "TransformMatrix is taken, as ITK does",
                      *find({"AnatomicalOrientation"})));
    }
    return directions;
  }

  void read_places() {
    VolumeHeader& header = result_.header;
    const double scale = millimetres();
    Vec3 spacing = Vec3::Ones();
    header.steps_field = "ElementSpacing";
    if (const auto text = find({"ElementSpacing", "ElementSize"})) {
      const auto mm = parse_numbers(*text, 3, {file_, "ElementSpacing"});
      spacing = {mm[0], mm[1], mm[2]};
      if (!(spacing.minCoeff() > 0.0)) {
        throw error("ElementSpacing", fmt::format("\"{}\" must be above zero", text->substr(0, 60)));
      }
    } else {
      header.notes.emplace_back("the file gives no ElementSpacing: taken as 1 mm");
    }
    header.steps_mm = scale * read_directions() * spacing.asDiagonal();
    if (const auto text = find({"Offset", "Position", "Origin"})) {
      const auto mm = parse_numbers(*text, 3, {file_, "Offset"});
      header.origin_mm = scale * Vec3(mm[0], mm[1], mm[2]);
    }
  }

  void read_data() {
    result_.packed = is_true({"CompressedData"});
    const std::string data = fields_.back().second;
    if (data != "LOCAL" && data != "local" && data != "Local") result_.data_file = data;
    result_.data_file_field = "ElementDataFile";
    if (data.empty()) throw error("ElementDataFile", "is empty; must be LOCAL or the name of a file");
    const auto skip = find({"HeaderSize"});
    if (!skip || result_.data_file.empty()) return;
    result_.skip_bytes = parse_integers(*skip, 1, {file_, "HeaderSize"})[0];
    if (result_.skip_bytes < (result_.packed ? 0 : -1)) {
      throw error("HeaderSize", "must be at least 0, or -1 without CompressedData");
    }
  }

  const std::string& file_;
  Fields fields_;
  VolumeFile result_;
};

}  // namespace

VolumeFile read_meta_image_header(ByteSource& source, const std::string& file) {
  return MetaImageHeader(source, file).read();
}

}  // namespace myotact::prepare
