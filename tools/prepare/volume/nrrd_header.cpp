#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/at.h"
#include "core/error.h"
#include "core/text.h"
#include "prepare/volume/header_text.h"
#include "prepare/volume/volume_formats.h"

// NRRD 0001 to 0005, as teem defines it (https://teem.sourceforge.net/nrrd/format.html).

namespace myotact::prepare {

namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 20;    // Slicer's tags have some hundred letters
constexpr std::size_t kLongestHeader = std::size_t{1} << 24;  // a thousand segments of Slicer have 1 MB

/// Fields that the format knows, as this reader calls them, without blanks: old files write some without.
const std::vector<std::string> kFields = {
    "blocksize",      "content",        "number",      "type",       "dimension",   "sizes",
    "spacings",       "axismins",       "axismaxs",    "centers",    "centerings",  "labels",
    "units",          "kinds",          "min",         "max",        "oldmin",      "oldmax",
    "thicknesses",    "endian",         "encoding",    "lineskip",   "byteskip",    "datafile",
    "space",          "spacedimension", "sampleunits", "spaceunits", "spaceorigin", "measurementframe",
    "spacedirections"};

std::string without_blanks(std::string_view text) {
  std::string kept;
  for (const char c : text) {
    if (c != ' ' && c != '\t') kept += c;
  }
  return kept;
}

/// "\\" and "\n" as key/value pairs escape them.
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == 'n' || text[i + 1] == '\\');
    if (escape) ++i;
    plain += escape && text[i] == 'n' ? '\n' : text[i];
  }
  return plain;
}

void read_line_into(NrrdText& text, const std::string& line, int number, const std::string& file) {
  if (line.starts_with('#')) return;
  const std::string place = fmt::format("line {}", number);
  const std::size_t colon = line.find(':');
  if (colon == std::string::npos) {
    throw bad_data(file, place,
                   fmt::format("\"{}\" is neither \"field: value\" nor \"key:=value\"", line.substr(0, 60)));
  }
  if (line.compare(colon, 2, ":=") == 0) {
    text.pairs.emplace_back(unescaped(line.substr(0, colon)), unescaped(line.substr(colon + 2)));
    return;
  }
  const std::string name = lower(without_blanks(line.substr(0, colon)));
  if (std::find(kFields.begin(), kFields.end(), name) == kFields.end()) {
    throw bad_data(file, place,
                   fmt::format("\"{}\" is no field of NRRD; the nearest is \"{}\"", line.substr(0, colon).substr(0, 60),
                               nearest_word(name, kFields)));
  }
  const bool twice =
      std::any_of(text.fields.begin(), text.fields.end(), [&](const auto& f) { return f.first == name; });
  if (twice) throw bad_data(file, place, fmt::format("states \"{}\" for the second time; remove one", name));
  text.fields.emplace_back(name, trimmed(line.substr(colon + 1)));
}

NrrdText read_text(ByteSource& source, const std::string& file) {
  const std::string magic = source.line(kLongestLine).value_or("");
  if (magic.size() != 8 || !magic.starts_with("NRRD000") || magic[7] < '1' || magic[7] > '5') {
    throw bad_data(
        file, "line 1",
        fmt::format("\"{}\"; must be NRRD0001 .. NRRD0005. It is no NRRD file; give it the ending of its own "
                    "format, or save it again",
                    magic.substr(0, 20)));
  }
  NrrdText text;
  std::size_t size = 0;
  for (int number = 2;; ++number) {
    const auto line = source.line(kLongestLine);
    if (!line || line->empty()) return text;
    size += line->size();
    if (line->size() == kLongestLine || size > kLongestHeader) {
      throw bad_data(file, fmt::format("line {}", number), "is longer than a header's: no empty line ends the header");
    }
    read_line_into(text, *line, number, file);
  }
}

/// The words of a list, where those between quotes hold blanks.
std::vector<std::string> quoted_words(std::string_view text) {
  std::vector<std::string> words;
  while (!(text = trimmed(text)).empty()) {
    const bool quoted = text.front() == '"';
    if (quoted) text.remove_prefix(1);
    const std::size_t end = std::min(text.find_first_of(quoted ? "\"" : " \t"), text.size());
    words.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

/// One vector an axis; nothing for "none". "(1,0,0) (0, 1, 0) none".
std::vector<std::optional<Vec3>> parse_vectors(std::string_view text, const FieldPlace& place) {
  std::vector<std::optional<Vec3>> vectors;
  while (!(text = trimmed(text)).empty()) {
    if (text.starts_with("none")) {
      text.remove_prefix(4);
      vectors.emplace_back();
      continue;
    }
    const std::size_t end = text.find(')');
    if (text.front() != '(' || end == std::string_view::npos) {
      throw bad_data(place.file, place.field,
                     fmt::format("\"{}\" is no vector; must be like (1,0,0), or none", text.substr(0, 60)));
    }
    std::string numbers(text.substr(1, end - 1));
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    const std::vector<double> v = parse_numbers(numbers, 3, place);
    vectors.emplace_back(Vec3(v[0], v[1], v[2]));
    text.remove_prefix(end + 1);
  }
  return vectors;
}

/// Turns a header's text into what it means.
class Meaning {
 public:
  Meaning(const NrrdText& text, const std::string& file) : text_(text), file_(file) {}

  VolumeFile read() {
    read_type();
    read_sizes();
    read_places();
    read_encoding();
    result_.header.segments = read_slicer_segments(text_, file_);
    return std::move(result_);
  }

 private:
  std::optional<std::string> find(const std::string& field) const {
    for (const auto& [name, value] : text_.fields) {
      if (name == field) return value;
    }
    return {};
  }

  std::string at_field(const std::string& field) const {
    if (auto value = find(field)) return *value;
    throw bad_data(file_, field, "is missing from the header; save the file again");
  }

  Error error(const std::string& field, const std::string& problem) const { return bad_data(file_, field, problem); }

  void read_type() {
    using Names = std::vector<std::string>;
    static const std::vector<std::pair<Names, ScalarType>> kTypes = {
        {{"signed char", "int8", "int8_t"}, {1, true}},
        {{"uchar", "unsigned char", "uint8", "uint8_t"}, {1, false}},
        {{"short", "short int", "signed short", "signed short int", "int16", "int16_t"}, {2, true}},
        {{"ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"}, {2, false}},
        {{"int", "signed int", "int32", "int32_t"}, {4, true}},
        {{"uint", "unsigned int", "uint32", "uint32_t"}, {4, false}},
        {{"longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"},
         {8, true}},
        {{"ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"}, {8, false}},
        {{"float"}, {4, true, true}},
        {{"double"}, {8, true, true}}};
    const std::string type = lower(at_field("type"));
    for (const auto& [names, scalar] : kTypes) {
      if (std::find(names.begin(), names.end(), type) != names.end()) {
        result_.header.type = scalar;
        return;
      }
    }
    throw error("type", fmt::format("\"{}\" is no type of numbers that is read; save it as unsigned short", type));
  }

  /// Which axis holds layers instead of places; nothing where none does.
  std::optional<std::size_t> find_list_axis(std::size_t axes) const {
    if (axes == 3) return {};
    if (const auto text = find("spacedirections")) {
      const auto vectors = parse_vectors(*text, {file_, "space directions"});
      const auto none = std::find(vectors.begin(), vectors.end(), std::nullopt);
      if (none != vectors.end()) return static_cast<std::size_t>(none - vectors.begin());
    } else if (const auto kinds = find("kinds")) {
      const auto words = quoted_words(*kinds);
      const auto list = std::find(words.begin(), words.end(), "list");
      if (list != words.end()) return static_cast<std::size_t>(list - words.begin());
    }
    throw error("dimension",
                "is 4, but no axis is a list of layers (kind \"list\", direction \"none\"): a series of volumes? Save "
                "one of them");
  }

  void read_sizes() {
    const auto axes = parse_integers(at_field("dimension"), 1, {file_, "dimension"})[0];
    if (axes != 3 && axes != 4) {
      throw error("dimension", fmt::format("is {}; must be 3, or 4 with a list of layers", axes));
    }
    axes_ = static_cast<std::size_t>(axes);
    std::vector<std::int64_t> sizes = parse_integers(at_field("sizes"), axes_, {file_, "sizes"});
    list_axis_ = find_list_axis(axes_);
    std::int64_t layers = 1;
    if (list_axis_) {
      if (*list_axis_ != 0 && *list_axis_ != 3) {
        throw error("sizes", fmt::format("the layers are axis {}; must be the first or the last", *list_axis_));
      }
      layers = sizes[*list_axis_];
      sizes.erase(sizes.begin() + static_cast<std::ptrdiff_t>(*list_axis_));
      result_.header.layers_fastest = *list_axis_ == 0;
    }
    set_counts(result_.header, {sizes[0], sizes[1], sizes[2]}, layers, file_, "sizes");
    check_kinds();
  }

  void check_kinds() const {
    const auto text = find("kinds");
    if (!text) return;
    const std::vector<std::string> kinds = quoted_words(*text);
    if (kinds.size() != axes_) throw error("kinds", fmt::format("names {} kinds; must be {}", kinds.size(), axes_));
    for (std::size_t axis = 0; axis < axes_; ++axis) {
      static const std::vector<std::string> kPlaces = {"domain", "space", "???", "none"};
      static const std::vector<std::string> kLayers = {"list", "???", "none"};
      const auto& allowed = axis == list_axis_ ? kLayers : kPlaces;
      if (std::find(allowed.begin(), allowed.end(), kinds[axis]) != allowed.end()) continue;
      throw error("kinds", fmt::format("axis {} is of the kind \"{}\"; must be {}. A picture with several values a "
                                       "point, or a series, is no segmentation",
                                       axis, kinds[axis].substr(0, 60), join(allowed, ", ")));
    }
  }

  /// What turns the file's space into LPS: a sign an axis.
  Vec3 signs_to_lps() {
    static const std::vector<std::tuple<std::string, std::string, Vec3>> kSpaces = {
        {"left-posterior-superior", "lps", Vec3(1, 1, 1)},
        {"right-anterior-superior", "ras", Vec3(-1, -1, 1)},
        {"left-anterior-superior", "las", Vec3(1, -1, 1)}};
    const std::string space = lower(find("space").value_or(""));
    for (const auto& [name, letters, signs] : kSpaces) {
      if (space == name || space == letters) return signs;
    }
    const bool unnamed = space.empty() || space == "3d-right-handed" || space == "3dr" || space == "scanner-xyz";
    if (!unnamed) {
      throw error("space", fmt::format("\"{}\" must be left-posterior-superior, right-anterior-superior or "
                                       "left-anterior-superior. Save the segmentation in one of them",
                                       space.substr(0, 60)));
    }
    if (const auto dimension = find("spacedimension"); dimension && *dimension != "3") {
      throw error("space dimension", fmt::format("is {}; must be 3", dimension->substr(0, 20)));
    }
    result_.header.notes.push_back(fmt::format("space: {} does not say where left is; taken as left-posterior-superior",
                                               space.empty() ? "the file" : "\"" + space + "\""));
    return Vec3::Ones();
  }

  double millimetres() {
    const auto text = find("spaceunits");
    if (!text) return 1.0;
    const std::vector<std::string> units = quoted_words(*text);
    std::optional<double> scale;
    for (const std::string& unit : units) {
      const auto here = trimmed(unit).empty() || unit == "???" ? 1.0 : millimetres_in(unit);
      if (!here || (scale && *scale != *here)) {
        throw error("space units", fmt::format("\"{}\" must be one of mm, cm, m, um for all axes", unit.substr(0, 60)));
      }
      scale = here;
    }
    return scale.value_or(1.0);
  }

  void read_places() {
    VolumeHeader& header = result_.header;
    const Vec3 signs = signs_to_lps();
    const double scale_mm = millimetres();
    Mat3 steps = Mat3::Identity();
    Vec3 origin = Vec3::Zero();
    if (find("spacedirections")) {
      read_directions(steps, origin);
    } else {
      read_spacings(steps, origin);
    }
    header.steps_mm = scale_mm * signs.asDiagonal() * steps;
    header.origin_mm = scale_mm * signs.cwiseProduct(origin);
  }

  void read_directions(Mat3& steps, Vec3& origin) {
    result_.header.steps_field = "space directions";
    std::vector<std::optional<Vec3>> vectors = parse_vectors(at_field("spacedirections"), {file_, "space directions"});
    if (vectors.size() != axes_) {
      throw error("space directions", fmt::format("holds {} vectors; must be {}", vectors.size(), axes_));
    }
    if (list_axis_) vectors.erase(vectors.begin() + static_cast<std::ptrdiff_t>(*list_axis_));
    for (int axis = 0; axis < 3; ++axis) {
      if (!vectors[at(axis)]) throw error("space directions", fmt::format("axis {} has none; must have one", axis));
      steps.col(axis) = *vectors[at(axis)];
    }
    if (const auto text = find("spaceorigin")) {
      const auto places = parse_vectors(*text, {file_, "space origin"});
      if (places.size() != 1 || !places[0]) throw error("space origin", "must be one vector, like (0,0,0)");
      origin = *places[0];
    }
  }

  /// The three of an axis field that belong to places; unknown ones are NaN.
  std::optional<Vec3> of_axes(const std::string& field) const {
    const auto text = find(field);
    if (!text) return {};
    std::vector<double> values = parse_numbers(*text, axes_, {file_, field});
    if (list_axis_) values.erase(values.begin() + static_cast<std::ptrdiff_t>(*list_axis_));
    return Vec3(values[0], values[1], values[2]);
  }

  void read_spacings(Mat3& steps, Vec3& origin) {
    result_.header.steps_field = "spacings";
    const auto spacings = of_axes("spacings");
    if (!spacings) {
      result_.header.notes.emplace_back("the file gives no spacing: taken as 1 mm");
    } else if (!(spacings->minCoeff() > 0.0)) {
      throw error("spacings", fmt::format("\"{}\" must be above zero", at_field("spacings").substr(0, 60)));
    } else {
      steps = spacings->asDiagonal();
    }
    const auto mins = of_axes("axismins");
    if (!mins || !mins->allFinite()) return;
    const auto centers = find("centers") ? find("centers") : find("centerings");
    const bool cell = centers && centers->find("cell") != std::string::npos;  // mins are the cells' lower faces
    origin = *mins + (cell ? 0.5 : 0.0) * steps.diagonal();
  }

  void read_encoding() {
    const std::string encoding = lower(at_field("encoding"));
    result_.packed = encoding == "gzip" || encoding == "gz";
    if (!result_.packed && encoding != "raw") {
      throw error("encoding",
                  fmt::format("\"{}\" must be raw or gzip; save it again as one of them", encoding.substr(0, 60)));
    }
    if (result_.header.type.bytes > 1) {
      const std::string endian = lower(at_field("endian"));
      if (endian != "little" && endian != "big") {
        throw error("endian", fmt::format("\"{}\" must be little or big", endian.substr(0, 60)));
      }
      result_.header.big_endian = endian == "big";
    }
    result_.data_file = find("datafile").value_or("");
    result_.data_file_field = "data file";
    if (const auto lines = find("lineskip")) result_.skip_lines = parse_integers(*lines, 1, {file_, "line skip"})[0];
    if (const auto bytes = find("byteskip")) result_.skip_bytes = parse_integers(*bytes, 1, {file_, "byte skip"})[0];
    if (result_.skip_lines < 0) throw error("line skip", "must be at least 0");
    if (result_.skip_bytes < (result_.packed ? 0 : -1)) {
      throw error("byte skip", "must be at least 0, or -1 with the encoding raw");
    }
  }

  const NrrdText& text_;
  const std::string& file_;
  std::size_t axes_ = 3;
  std::optional<std::size_t> list_axis_;
  VolumeFile result_;
};

}  // namespace

VolumeFile read_nrrd_header(ByteSource& source, const std::string& file) {
  const NrrdText text = read_text(source, file);
  return Meaning(text, file).read();
}

}  // namespace myotact::prepare
