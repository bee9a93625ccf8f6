#include "prepare/volume/map_segments.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "anatomy/name_search.h"
#include "core/at.h"
#include "core/error.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

/// A name of a known part, as names are compared.
struct PlainName {
  std::string plain;
  std::size_t part;
  int rank;  // key, Latin, English, synonym
};
constexpr int kRanks = 4;
const std::array<std::string, kRanks> kRankNames = {"key", "Latin name", "English name", "synonym"};

/// Finds known parts by any of their names.
class NameBook {
 public:
  explicit NameBook(const std::vector<KnownPart>& known) : known_(known) {
    for (std::size_t i = 0; i < known.size(); ++i) {
      add(known[i].key, i, 0);
      if (const auto dot = known[i].key.find('.'); dot != std::string::npos) add(known[i].key.substr(dot + 1), i, 0);
      add(known[i].name_la, i, 1);
      add(known[i].name_en, i, 2);
      for (const std::string& synonym : known[i].synonyms) add(synonym, i, 3);
    }
  }

  /// The parts that have this name in the best rank where any has.
  std::pair<std::vector<std::size_t>, int> find(const std::string& name) const {
    for (const std::string& plain : {plain_name(name), name_without_bone(name)}) {
      if (plain.empty()) continue;
      for (int rank = 0; rank < kRanks; ++rank) {
        std::set<std::size_t> parts;
        for (const PlainName& entry : names_) {
          if (entry.rank == rank && entry.plain == plain) parts.insert(entry.part);
        }
        if (!parts.empty()) return {{parts.begin(), parts.end()}, rank};
      }
    }
    return {{}, kRanks};
  }

  /// Keys of the parts whose names need the fewest slips of typing.
  std::vector<std::string> nearest(const std::string& name) const {
    constexpr std::size_t kShown = 3, kCompared = 64;
    const std::string plain = plain_name(name).substr(0, kCompared);
    std::map<std::size_t, int> slips;  // part -> fewest
    for (const PlainName& entry : names_) {
      const int here = anatomy::typing_slips(plain, std::string_view(entry.plain).substr(0, kCompared));
      const auto place = slips.try_emplace(entry.part, here).first;
      place->second = std::min(place->second, here);
    }
    std::vector<std::pair<int, std::size_t>> order;
    for (const auto& [part, count] : slips) order.emplace_back(count, part);
    std::sort(order.begin(), order.end());
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < std::min(order.size(), kShown); ++i) keys.push_back(known_[order[i].second].key);
    return keys;
  }

 private:
  void add(const std::string& name, std::size_t part, int rank) {
    if (std::string plain = plain_name(name); !plain.empty()) names_.push_back({std::move(plain), part, rank});
  }

  const std::vector<KnownPart>& known_;
  std::vector<PlainName> names_;
};

std::string shown(const Segment& segment) {
  return fmt::format("\"{}\" (label {}{})", segment.name, segment.label,
                     segment.layer == 0 ? "" : fmt::format(", layer {}", segment.layer));
}

class Mapper {
 public:
  Mapper(const std::vector<Segment>& segments, const std::vector<KnownPart>& known, const MapRules& rules)
      : segments_(segments), known_(known), rules_(rules), book_(known) {}

  SegmentMap map() {
    const std::vector<const SegmentRow*> rows = match_rows();
    const std::set<std::size_t> bones = match_bones();
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      SegmentChoice choice;
      choice.segment = segments_[i];
      if (rows[i]) {
        by_table(choice, *rows[i]);
      } else if (!by_name(choice)) {
        by_kind(choice, bones.contains(i));
      }
      result_.choices.push_back(std::move(choice));
    }
    ignore_other_side();
    make_keys_unique();
    for (std::size_t i = 0; i < result_.choices.size(); ++i) {
      if (!result_.choices[i].known) result_.unknown.push_back(static_cast<int>(i));
    }
    return std::move(result_);
  }

 private:
  Error row_error(const SegmentRow& row, const std::string& problem) const {
    return bad_data(rules_.table.file, fmt::format("line {}", row.line), problem);
  }

  std::vector<std::string> segment_names() const {
    std::vector<std::string> names;
    for (const Segment& segment : segments_) names.push_back(segment.name);
    return names;
  }

  static bool fits(const SegmentRow& row, const Segment& segment) {
    if (row.label && *row.label != segment.label) return false;
    if (row.layer && *row.layer != segment.layer) return false;
    return row.segment.empty() ? row.layer.value_or(0) == segment.layer : row.segment == segment.name;
  }

  /// The row of the table for each segment, or none.
  std::vector<const SegmentRow*> match_rows() const {
    std::vector<const SegmentRow*> rows(segments_.size(), nullptr);
    for (const SegmentRow& row : rules_.table.rows) {
      bool used = false;
      for (std::size_t i = 0; i < segments_.size(); ++i) {
        if (!fits(row, segments_[i])) continue;
        if (rows[i]) {
          throw row_error(row, fmt::format("decides the segment {} a second time, after line {}; remove one",
                                           shown(segments_[i]), rows[i]->line));
        }
        rows[i] = &row;
        used = true;
      }
      if (used) continue;
      const std::string what = row.segment.empty() ? fmt::format("label {}", *row.label) : "\"" + row.segment + "\"";
      throw row_error(row, fmt::format("no segment of the volume is {}; the nearest is \"{}\"", what,
                                       nearest_word(row.segment, segment_names())));
    }
    return rows;
  }

  /// The segments that --bones names.
  std::set<std::size_t> match_bones() const {
    std::set<std::size_t> bones;
    for (const std::string& name : rules_.bones) {
      const std::size_t before = bones.size();
      bool found = false;
      for (std::size_t i = 0; i < segments_.size(); ++i) {
        const bool same = segments_[i].name == name || std::to_string(segments_[i].label) == name ||
                          (!plain_name(name).empty() && plain_name(segments_[i].name) == plain_name(name));
        if (same) bones.insert(i);
        found = found || same;
      }
      if (found || bones.size() > before) continue;
      throw Error(ExitStatus::Usage, fmt::format("--bones: no segment is named \"{}\"; the nearest is \"{}\"", name,
                                                 nearest_word(name, segment_names())));
    }
    return bones;
  }

  void by_table(SegmentChoice& choice, const SegmentRow& row) const {
    choice.known = true;
    choice.why = "table";
    if (row.kind == PartKind::Ignore) {
      choice.kind = PartKind::Ignore;
      return;
    }
    const auto [parts, rank] = book_.find(row.part);
    if (parts.size() == 1) {
      choice.key = known_[parts[0]].key;
      choice.kind = row.kind.value_or(known_[parts[0]].kind);
      return;
    }
    if (!known_.empty()) {
      throw row_error(
          row, fmt::format("\"{}\" is {} of the recipe; the nearest are {}", row.part,
                           parts.empty() ? "no part" : "the name of several parts", join(book_.nearest(row.part))));
    }
    choice.key = key_from(row.part);
    if (choice.key.empty()) throw row_error(row, fmt::format("\"{}\" has no letter to make a key of", row.part));
    const auto kind = row.kind ? row.kind : kind_of(choice.segment);
    choice.kind = kind.value_or(PartKind::Muscle);
    choice.kind_is_certain = kind.has_value();
  }

  /// By the segment's own name, else by the file's hints.
  bool by_name(SegmentChoice& choice) const {
    std::vector<std::string> names = {choice.segment.name};
    names.insert(names.end(), choice.segment.hints.begin(), choice.segment.hints.end());
    for (std::size_t n = 0; n < names.size(); ++n) {
      const auto [parts, rank] = book_.find(names[n]);
      if (parts.size() > 1 && choice.nearest.empty()) {
        for (const std::size_t part : parts) choice.nearest.push_back(known_[part].key);
      }
      if (parts.size() != 1) continue;
      choice.key = known_[parts[0]].key;
      choice.kind = known_[parts[0]].kind;
      choice.known = true;
      choice.why = n == 0 ? kRankNames[at(rank)] : fmt::format("hint \"{}\" of the file", names[n]);
      choice.nearest.clear();
      return true;
    }
    return false;
  }

  static std::optional<PartKind> kind_of(const Segment& segment) {
    if (const auto kind = kind_in(segment.name)) return kind;
    for (const std::string& hint : segment.hints) {
      if (const auto kind = kind_in(hint)) return kind;
    }
    return {};
  }

  void by_kind(SegmentChoice& choice, bool listed_as_bone) {
    const Segment& segment = choice.segment;
    auto kind = kind_of(segment);
    choice.why = kind ? "its words" : listed_as_bone ? "--bones" : "nothing";
    if (!kind && listed_as_bone) kind = PartKind::Bone;
    choice.kind = kind.value_or(PartKind::Muscle);
    choice.kind_is_certain = kind.has_value();
    if (choice.nearest.empty() && !known_.empty()) choice.nearest = book_.nearest(segment.name);
    if (choice.kind == PartKind::Ignore) {
      choice.known = true;
      result_.notes.push_back(fmt::format("segment {}: neither bone nor muscle by its name; left out", shown(segment)));
      return;
    }
    choice.key = key_from(segment.name);
    if (choice.key.empty()) choice.key = fmt::format("label_{}", segment.label);
    if (!choice.kind_is_certain) {
      result_.notes.push_back(
          fmt::format("segment {}: nothing says bone or muscle; taken as a muscle. Name bones with --bones, or in the "
                      "table",
                      shown(segment)));
    }
  }

  /// Where two segments are one part and their names say left and right, the limb's own side stays.
  void ignore_other_side() {
    for (SegmentChoice& choice : result_.choices) {
      const std::string side = side_in(choice.segment.name);
      if (side.empty() || rules_.side.empty() || side == rules_.side || !choice.known || choice.why == "table")
        continue;
      const bool twin = std::any_of(result_.choices.begin(), result_.choices.end(), [&](const SegmentChoice& other) {
        return &other != &choice && other.key == choice.key && !choice.key.empty() &&
               side_in(other.segment.name) == rules_.side;
      });
      if (!twin) continue;
      result_.notes.push_back(fmt::format("segment {}: of the other side than the limb's, {}; left out",
                                          shown(choice.segment), rules_.side));
      choice.kind = PartKind::Ignore;
      choice.key.clear();
    }
  }

  Error same_part(const SegmentChoice& first, const SegmentChoice& second) const {
    return bad_data(rules_.table.file.empty() ? "segments" : rules_.table.file, first.key,
                    fmt::format("is both {} (by {}) and {} (by {}). Join them in the segmentation, or put ignore for "
                                "one in the table",
                                shown(first.segment), first.why, shown(second.segment), second.why));
  }

  /// Two segments cannot be one known part; keys made from names are numbered.
  void make_keys_unique() {
    std::map<std::string, const SegmentChoice*> first;
    for (const SegmentChoice& choice : result_.choices) {
      if (choice.key.empty() || !choice.known) continue;
      const auto [place, is_new] = first.emplace(choice.key, &choice);
      if (!is_new) throw same_part(*place->second, choice);
    }
    for (SegmentChoice& choice : result_.choices) {
      if (choice.known) continue;
      const std::string key = choice.key;
      for (int number = 2; !first.emplace(choice.key, &choice).second; ++number) {
        choice.key = fmt::format("{}_{}", key, number);
      }
    }
  }

  const std::vector<Segment>& segments_;
  const std::vector<KnownPart>& known_;
  const MapRules& rules_;
  NameBook book_;
  SegmentMap result_;
};

}  // namespace

std::vector<KnownPart> known_parts(const AnatomyData& recipe, const anatomy::FactsByKey& facts) {
  std::vector<KnownPart> known;
  for (const BoneData& bone : recipe.bones) {
    known.push_back({bone.key, PartKind::Bone, bone.name_la, bone.name_en, facts_of(facts, bone.key).synonyms});
  }
  for (const MuscleData& muscle : recipe.muscles) {
    const anatomy::Muscle& m = muscle.mechanics;
    known.push_back({m.key, PartKind::Muscle, m.name_la, m.name_en, facts_of(facts, m.key).synonyms});
  }
  return known;
}

SegmentMap map_segments(const std::vector<Segment>& segments, const std::vector<KnownPart>& known,
                        const MapRules& rules) {
  return Mapper(segments, known, rules).map();
}

SegmentTable table_of(const SegmentMap& map) {
  SegmentTable table;
  for (const SegmentChoice& choice : map.choices) {
    SegmentRow row;
    row.segment = choice.segment.name;
    row.label = choice.segment.label;
    row.layer = choice.segment.layer;
    row.kind = choice.kind;
    const bool guess = !choice.known && !choice.nearest.empty();
    row.part = guess ? choice.nearest.front() : choice.key;
    row.note = choice.known ? "by " + choice.why
               : guess      ? "a guess; may also be " + join(choice.nearest)
                            : "new: " + choice.why + " says what it is";
    table.rows.push_back(std::move(row));
  }
  return table;
}

void require_all_known(const SegmentMap& map, const std::string& file) {
  if (map.unknown.empty()) return;
  std::vector<std::string> lines;
  for (const int i : map.unknown) {
    const SegmentChoice& choice = map.choices[at(i)];
    lines.push_back(
        fmt::format("{}: nearest {}", shown(choice.segment), choice.nearest.empty() ? "none" : join(choice.nearest)));
  }
  throw bad_data(file, "segments",
                 fmt::format("{} of {} have names that the recipe does not know: {}. Rename them, or say in a table "
                             "which part each is (or ignore)",
                             map.unknown.size(), map.choices.size(), join(lines, "; ")));
}

}  // namespace myotact::prepare
