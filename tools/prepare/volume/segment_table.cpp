#include "prepare/volume/segment_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "core/text.h"
#include "prepare/volume/header_text.h"

namespace myotact::prepare {

namespace {

const std::vector<std::string> kColumns = {"segment", "label", "layer", "part", "kind", "note"};
constexpr std::size_t kMostRows = 100'000;

using Cells = std::vector<std::string>;

/// Cuts CSV into cells; those between quotes may hold separators, line ends and doubled quotes.
class CsvReader {
 public:
  CsvReader(std::string_view text, char separator, const std::string& file)
      : text_(text), separator_(separator), file_(file) {}

  bool at_end() const { return next_ >= text_.size(); }
  int line() const { return line_; }  // of the row that row() gives next

  Cells row() {
    Cells cells;
    while (true) {
      cells.emplace_back(trimmed(cell()));
      if (at_end()) return cells;
      const char after = text_[next_++];
      if (after == separator_) continue;
      ++line_;
      return cells;
    }
  }

 private:
  std::string cell() {
    std::string value;
    if (!at_end() && text_[next_] == '"') return quoted();
    while (!at_end() && text_[next_] != separator_ && text_[next_] != '\n') value += text_[next_++];
    return value;
  }

  std::string quoted() {
    const int begun = line_;
    std::string value;
    for (++next_; !at_end(); ++next_) {
      if (text_[next_] == '\n') ++line_;
      if (text_[next_] != '"') {
        value += text_[next_];
      } else if (next_ + 1 < text_.size() && text_[next_ + 1] == '"') {
        value += text_[++next_];
      } else {
        ++next_;
        while (!at_end() && text_[next_] != separator_ && text_[next_] != '\n') ++next_;
        return value;
      }
    }
    throw bad_data(file_, fmt::format("line {}", begun), "a quote is not closed; close it");
  }

  std::string_view text_;
  char separator_;
  const std::string& file_;
  std::size_t next_ = 0;
  int line_ = 1;
};

char separator_of(std::string_view text) {
  const std::string_view first = text.substr(0, text.find('\n'));
  char best = ',';
  for (const char candidate : {';', '\t'}) {
    if (std::count(first.begin(), first.end(), candidate) > std::count(first.begin(), first.end(), best)) {
      best = candidate;
    }
  }
  return best;
}

/// Column -> its place in a row.
std::map<std::string, std::size_t> read_header(const Cells& cells, const std::string& file) {
  std::map<std::string, std::size_t> columns;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string name = lower(cells[i]);
    if (name.empty()) continue;
    const bool known = std::find(kColumns.begin(), kColumns.end(), name) != kColumns.end();
    if (!known || !columns.emplace(name, i).second) {
      throw bad_data(file, "line 1",
                     fmt::format("the column \"{}\" is {}; the columns are {}", name.substr(0, 60),
                                 known ? "there twice" : "not known", join(kColumns)));
    }
  }
  if ((columns.contains("segment") || columns.contains("label")) && columns.contains("part")) return columns;
  throw bad_data(file, "line 1", "must name the columns segment or label, and part, for example: segment,part,kind");
}

class RowReader {
 public:
  RowReader(const std::map<std::string, std::size_t>& columns, const Cells& cells, int line, const std::string& file)
      : columns_(columns), cells_(cells), line_(line), file_(file) {}

  SegmentRow read() const {
    SegmentRow row;
    row.segment = cell("segment");
    row.label = number("label", 1);
    row.layer = number("layer", 0);
    row.part = cell("part");
    row.kind = kind();
    row.note = cell("note");
    row.line = line_;
    if (row.segment.empty() && !row.label) throw error("segment", "is empty; name the segment or its label");
    if (row.part.empty() && row.kind != PartKind::Ignore) {
      throw error("part", "is empty; name the part, or put ignore under kind");
    }
    return row;
  }

 private:
  std::string cell(const char* column) const {
    const auto place = columns_.find(column);
    return place == columns_.end() || place->second >= cells_.size() ? "" : cells_[place->second];
  }

  Error error(const char* column, const std::string& problem) const {
    return bad_data(file_, fmt::format("line {}, column {}", line_, column), problem);
  }

  std::optional<int> number(const char* column, int lowest) const {
    const std::string text = cell(column);
    if (text.empty()) return {};
    int value = -1;
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    constexpr int kHighest = 65'535;
    if (failed == std::errc() && end == text.data() + text.size() && value >= lowest && value <= kHighest) return value;
    throw error(column, fmt::format("\"{}\" must be {} .. {}", text.substr(0, 60), lowest, kHighest));
  }

  std::optional<PartKind> kind() const {
    const std::string text = lower(cell("kind"));
    if (text.empty()) return {};
    for (const PartKind kind : {PartKind::Bone, PartKind::Muscle, PartKind::Ignore}) {
      if (text == text_of(kind)) return kind;
    }
    throw error("kind", fmt::format("\"{}\" must be bone, muscle or ignore", text.substr(0, 60)));
  }

  const std::map<std::string, std::size_t>& columns_;
  const Cells& cells_;
  int line_;
  const std::string& file_;
};

std::string quoted_if_needed(const std::string& text) {
  const bool ends_trimmed = trimmed(text).size() == text.size();
  if (ends_trimmed && text.find_first_of(",;\t\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

SegmentTable parse_segment_table(const std::string& text, const std::string& file) {
  std::string_view rest = text;
  if (constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf"; rest.starts_with(kByteOrderMark)) {
    rest.remove_prefix(kByteOrderMark.size());
  }
  CsvReader reader(rest, separator_of(rest), file);
  if (reader.at_end()) throw bad_data(file, "", "is empty; the first line names the columns " + join(kColumns));
  const auto columns = read_header(reader.row(), file);
  SegmentTable table{file, {}};
  while (!reader.at_end()) {
    const int line = reader.line();
    const Cells cells = reader.row();
    const bool blank = std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); });
    if (blank) continue;
    if (table.rows.size() == kMostRows) throw bad_data(file, fmt::format("line {}", line), "is one row too many");
    table.rows.push_back(RowReader(columns, cells, line, file).read());
  }
  return table;
}

SegmentTable read_segment_table(const std::filesystem::path& path) {
  return parse_segment_table(read_file(path), path.string());
}

std::string segment_table_text(const SegmentTable& table) {
  std::string text = join(kColumns, ",") + "\n";
  const auto number = [](const std::optional<int>& value) { return value ? std::to_string(*value) : std::string(); };
  for (const SegmentRow& row : table.rows) {
    text += fmt::format("{},{},{},{},{},{}\n", quoted_if_needed(row.segment), number(row.label), number(row.layer),
                        quoted_if_needed(row.part), row.kind ? text_of(*row.kind) : "", quoted_if_needed(row.note));
  }
  return text;
}

void write_segment_table(const std::filesystem::path& path, const SegmentTable& table) {
  write_file(path, segment_table_text(table));
}

}  // namespace myotact::prepare
