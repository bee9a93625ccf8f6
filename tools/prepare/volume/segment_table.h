#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "prepare/volume/segment_names.h"

// A table that a person edits: which part each segment is. CSV with the columns segment, label, layer, part, kind,
// note; read with commas, semicolons or tabs between them, as spreadsheets save it.

namespace myotact::prepare {

struct SegmentRow {
  std::string segment;           // its name; empty: by label and layer
  std::optional<int> label;      // 1 .. 65535
  std::optional<int> layer;      // 0 where it is left out
  std::string part;              // key or name of the part; empty with kind ignore
  std::optional<PartKind> kind;  // nothing: as the part has it, or by its name
  std::string note;              // for the person
  int line = 0;                  // in the file
};

struct SegmentTable {
  std::string file;  // for errors
  std::vector<SegmentRow> rows;
};

/// Throws Error: NoInput, or BadData naming file, line and column, what is allowed and the nearest name.
SegmentTable read_segment_table(const std::filesystem::path& path);
SegmentTable parse_segment_table(const std::string& text, const std::string& file);

/// The text of a table, with commas.
std::string segment_table_text(const SegmentTable& table);

/// Writes the table whole or not at all. Throws Error InputOutput.
void write_segment_table(const std::filesystem::path& path, const SegmentTable& table);

}  // namespace myotact::prepare
