#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "prepare/volume/header_text.h"
#include "prepare/volume/volume_formats.h"

// What 3D Slicer writes of segments into a NRRD header: SegmentN_Name, SegmentN_LabelValue, SegmentN_Layer,
// SegmentN_Tags. Files without layers have one; before version 4.11 there was one a segment, with neither value nor
// layer.

namespace myotact::prepare {

namespace {

constexpr int kMostSegments = 65'536;  // as many as there are labels

/// "Segment12_Name" -> 12 and "Name".
std::optional<std::pair<int, std::string>> split_key(const std::string& key) {
  constexpr std::string_view kStart = "Segment";
  if (!key.starts_with(kStart)) return {};
  int number = -1;
  const char* end = key.data() + key.size();
  const auto [after, error] = std::from_chars(key.data() + kStart.size(), end, number);
  if (error != std::errc() || number < 0 || number >= kMostSegments || after == end || *after != '_') return {};
  return std::pair(number, std::string(after + 1, end));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

/// "name:value|name:value|" of which the terminology is
/// "TerminologyEntry:LIST~CATEGORY~TYPE~MODIFIER~LIST~REGION~MODIFIER" with codes "SCHEME^VALUE^MEANING": the meanings
/// of regions and types, which say what a part is; categories only say that it is tissue.
std::vector<std::string> hints_of(std::string_view tags) {
  constexpr std::string_view kTerminology = "TerminologyEntry:";
  std::vector<std::string> hints;
  for (const std::string_view tag : split(tags, '|')) {
    if (!tag.starts_with(kTerminology)) continue;
    const auto entries = split(tag.substr(kTerminology.size()), '~');
    for (const std::size_t entry : {5U, 6U, 2U, 3U}) {
      if (entry >= entries.size()) continue;
      const auto code = split(entries[entry], '^');
      if (code.size() == 3 && !trimmed(code[2]).empty()) hints.emplace_back(trimmed(code[2]));
    }
  }
  return hints;
}

int whole(const std::string& value, int largest, const FieldPlace& place) {
  const auto number = parse_integers(value, 1, place)[0];
  if (number >= 0 && number <= largest) return static_cast<int>(number);
  throw bad_data(place.file, place.field, fmt::format("is {}; must be 0 .. {}", number, largest));
}

}  // namespace

std::vector<Segment> read_slicer_segments(const NrrdText& text, const std::string& file) {
  constexpr int kUnknown = -1;
  std::map<int, Segment> segments;
  for (const auto& [key, value] : text.pairs) {
    const auto split = split_key(key);
    if (!split) continue;
    const auto& [number, what] = *split;
    Segment& segment = segments.try_emplace(number, Segment{"", kUnknown, kUnknown, {}}).first->second;
    if (what == "Name") segment.name = trimmed(value);
    if (what == "LabelValue") segment.label = whole(value, 65'535, {file, key});
    if (what == "Layer") segment.layer = whole(value, kMostSegments, {file, key});
    if (what == "Tags") segment.hints = hints_of(value);
  }
  std::vector<Segment> found;
  for (auto& [number, segment] : segments) {
    if (segment.layer == kUnknown) segment.layer = segment.label == kUnknown ? number : 0;
    if (segment.label == kUnknown) segment.label = 1;
    found.push_back(std::move(segment));
  }
  return found;
}

}  // namespace myotact::prepare
