#pragma once

#include <string>
#include <vector>

#include "anatomy/part_facts.h"
#include "prepare/recipe/anatomy_data.h"
#include "prepare/volume/label_volume.h"
#include "prepare/volume/segment_names.h"
#include "prepare/volume/segment_table.h"

// Which part of the limb each segment of a volume is.
//
//   const LabelVolume volume = read_label_volume(file);
//   const std::vector<KnownPart> known = known_parts(recipe, facts);       // or none, without a recipe
//   SegmentTable table = named ? read_segment_table(named) : SegmentTable();
//   const SegmentMap map = map_segments(volume.segments, known, {table, bones, recipe.side});
//   if (!map.unknown.empty())  ->  write_segment_table(beside, table_of(map)) for a person, and
//   require_all_known(map, file)  with a recipe; without one, unknown segments have a key made from their name.

namespace myotact::prepare {

/// A part that a recipe has, with all its names.
struct KnownPart {
  std::string key;
  PartKind kind = PartKind::Muscle;
  std::string name_la, name_en;
  std::vector<std::string> synonyms;
};

/// The bones and muscles of a recipe; `facts` holds the synonyms (assets/canine/names.json).
std::vector<KnownPart> known_parts(const AnatomyData& recipe, const anatomy::FactsByKey& facts);

/// What was decided of one segment.
struct SegmentChoice {
  Segment segment;
  PartKind kind = PartKind::Muscle;
  std::string key;                   // of the part: the recipe's, the table's or made from the name; empty: ignored
  bool known = false;                // a part of the recipe, or decided by the table
  bool kind_is_certain = true;       // false: no name, table, hint or --bones says what it is
  std::string why;                   // "key", "Latin name", "synonym \"biceps\"", "table", ...
  std::vector<std::string> nearest;  // keys that it may be, the likeliest first; for unknown segments
};

struct SegmentMap {
  std::vector<SegmentChoice> choices;  // one a segment, in their order; keys are unique but for ignored ones
  std::vector<int> unknown;            // indices of choices that are not known
  std::vector<std::string> notes;      // what a person should check
};

struct MapRules {
  SegmentTable table;              // goes before everything else; empty: none
  std::vector<std::string> bones;  // names or labels of segments that are bones where nothing else says
  std::string side;                // of the limb, "left" or "right": where both sides are there, the other is ignored
};

/// Decides by the table, then by key, Latin name, English name, synonym, the file's hints; then the kind alone by
/// words, hints and `bones`; the rest are muscles, with a note. Without known parts the key is made from the name.
/// Throws Error BadData when two segments are one part, when the table names a segment or a part that is not there, and
/// Usage when `bones` does; each names the nearest.
SegmentMap map_segments(const std::vector<Segment>& segments, const std::vector<KnownPart>& known,
                        const MapRules& rules);

/// The table with what was decided and, for unknown segments, what is likeliest, for a person to edit.
SegmentTable table_of(const SegmentMap& map);

/// Throws Error BadData that lists the unknown segments of `file` with the nearest parts and says how to decide.
void require_all_known(const SegmentMap& map, const std::string& file);

}  // namespace myotact::prepare
