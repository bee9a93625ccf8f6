#include "view/session/marks.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file.h"
#include "core/user_folder.h"
#include "view/ui/retold.h"
#include "view/ui/text.h"

namespace myotact::view {

namespace {

constexpr int kSchema = 1;

/// Bytes that begin a character of UTF-8, not those that go on with one.
bool begins_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u;
}

std::string text_of_length(const JsonValue& json, std::size_t most) {
  const std::string text = json.string();
  const std::size_t length = characters_in(text);
  if (length == 0 || length > most) {
    throw json.error(fmt::format("has {} characters; must have 1 to {}: write a text of that length", length, most));
  }
  return text;
}

bool has_name(const std::vector<Bookmark>& bookmarks, const std::string& name) {
  return std::any_of(bookmarks.begin(), bookmarks.end(), [&](const Bookmark& known) { return known.name == name; });
}

/// A name as part of a file's: small letters and digits, "_" for blanks, the bytes of all else as %XX.
std::string file_name_of(const std::string& name) {
  std::string safe;
  for (const char c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    const auto byte = static_cast<unsigned>(static_cast<unsigned char>(c));
    safe += plain ? std::string(1, c) : c == ' ' ? "_" : fmt::format("%{:02X}", byte);
  }
  constexpr std::size_t kLongest = 200;  // file systems allow 255 bytes
  return safe.substr(0, kLongest);
}

}  // namespace

std::size_t characters_in(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_character));
}

std::size_t bytes_of_characters(std::string_view text, std::size_t count) {
  std::size_t bytes = 0;
  for (; bytes < text.size(); ++bytes) {
    if (begins_character(text[bytes]) && count-- == 0) break;
  }
  return bytes;
}

bool add_bookmark(std::vector<Bookmark>& bookmarks, Bookmark bookmark) {
  if (bookmarks.size() >= kMostBookmarks) return false;
  const std::string wanted = bookmark.name;
  for (int i = 2; has_name(bookmarks, bookmark.name); ++i) {
    const std::string suffix = fmt::format(" ({})", i);
    bookmark.name = wanted.substr(0, bytes_of_characters(wanted, kLongestName - suffix.size())) + suffix;
  }
  bookmarks.push_back(std::move(bookmark));
  return true;
}

JoinedMarks joined(const Marks& own, const Marks& others) {
  JoinedMarks both{own};
  for (const auto& [part, text] : others.notes) {
    const auto [kept, is_new] = both.marks.notes.emplace(part, text);
    both.differing_notes += !is_new && kept->second != text ? 1 : 0;
  }
  for (const Bookmark& other : others.bookmarks) {
    // The same view under another name is the same bookmark, renamed.
    const bool known = std::any_of(own.bookmarks.begin(), own.bookmarks.end(),
                                   [&](const Bookmark& bookmark) { return bookmark.view == other.view; });
    if (!known) add_bookmark(both.marks.bookmarks, other);
  }
  return both;
}

void put_marks(const Marks& marks, nlohmann::json& object) {
  object["notes"] = marks.notes;
  object["bookmarks"] = nlohmann::json::array();
  for (const Bookmark& bookmark : marks.bookmarks) {
    object["bookmarks"].push_back({{"name", bookmark.name}, {"view", json_of(bookmark.view)}});
  }
}

Marks parse_marks(JsonObject& object) {
  Marks marks;
  if (const auto notes = object.find("notes")) {
    for (const auto& [part, text] : JsonObject(*notes).entries())
      marks.notes[part] = text_of_length(text, kLongestNote);
  }
  if (const auto bookmarks = object.find("bookmarks")) {
    for (const JsonValue& element : bookmarks->elements()) {
      JsonObject bookmark(element);
      const JsonValue name = bookmark.at("name");
      Bookmark read{text_of_length(name, kLongestName), parse_view(bookmark.at("view"))};
      bookmark.finish();
      if (has_name(marks.bookmarks, read.name)) throw name.error("is there twice; give each bookmark its own name");
      if (!add_bookmark(marks.bookmarks, std::move(read))) {
        throw bookmarks->error(fmt::format("holds more than {} bookmarks; delete some", kMostBookmarks));
      }
    }
  }
  return marks;
}

void require_schema(JsonObject& object) {
  const JsonValue schema = object.at("schema");
  if (schema.number() == kSchema) return;
  throw schema.error(fmt::format("is {}; this program reads {}: open the file with the Myotact that wrote it",
                                 schema.raw().dump(), kSchema));
}

std::filesystem::path marks_file(const std::string& specimen) {
  const std::filesystem::path own = user_data_folder();
  return own.empty() ? own : own / "marks" / (file_name_of(specimen) + ".json");
}

Marks parse_marks(const std::string& text, const std::string& file) {
  const nlohmann::json json = parse_json(text, file);
  JsonObject object{JsonValue(json, file)};
  require_schema(object);
  object.at("specimen").string();  // for who looks into the file
  Marks marks = parse_marks(object);
  object.finish();
  return marks;
}

Marks read_marks(const std::filesystem::path& file) {
  if (file.empty() || !std::filesystem::exists(file)) return {};
  return parse_marks(read_file(file), file.string());
}

Marks marks_or_none(const std::filesystem::path& file, std::string& message) {
  try {
    return read_marks(file);
  } catch (const Error& failure) {
    const auto aside = set_aside(file);
    message = aside ? ui::tr("session.marks_set_aside", ui::retold(failure.what()), aside->string())
                    : ui::tr("session.marks_unusable", ui::retold(failure.what()), file.string() + ".broken");
    return {};
  }
}

std::string marks_text(const Marks& marks, const std::string& specimen) {
  nlohmann::json json = {{"schema", kSchema}, {"specimen", specimen}};
  put_marks(marks, json);
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_marks(const Marks& marks, const std::string& specimen, const std::filesystem::path& file) {
  if (file.empty()) {
    throw Error(ExitStatus::InputOutput, "there is no folder for your notes: set HOME or XDG_DATA_HOME to one");
  }
  make_writable_folder(file.parent_path());
  write_file(file, marks_text(marks, specimen));
}

}  // namespace myotact::view
