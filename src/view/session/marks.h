#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/json_reader.h"
#include "view/session/saved_view.h"

namespace myotact::view {

/// A view that a person gave a name.
struct Bookmark {
  std::string name;  // 1 to kLongestName characters
  SavedView view;

  bool operator==(const Bookmark&) const = default;
};

/// What a person put down about a specimen. It is kept in a file of the person's own, and goes along in a saved work.
struct Marks {
  std::vector<Bookmark> bookmarks;           // in the order of being made
  std::map<std::string, std::string> notes;  // on muscles and bones, by their keys; 1 to kLongestNote characters

  bool operator==(const Marks&) const = default;
};

inline constexpr std::size_t kLongestNote = 500;  // characters: what a card can show without much scrolling
inline constexpr std::size_t kLongestName = 60;   // characters: the width of a list
inline constexpr std::size_t kMostBookmarks = 200;

/// Adds it, under another name where one has its name: "front (2)". Beyond kMostBookmarks nothing is added: false.
bool add_bookmark(std::vector<Bookmark>& bookmarks, Bookmark bookmark);

struct JoinedMarks {
  Marks marks;
  int differing_notes = 0;  // of others on parts of which the person has an own note
};
/// Nothing of the person's own is lost: where both have a note, the own one stays; bookmarks are added whose view is
/// new.
JoinedMarks joined(const Marks& own, const Marks& others);

/// As members "bookmarks" and "notes" of a file's object.
void put_marks(const Marks& marks, nlohmann::json& object);
/// Throws Error BadData.
Marks parse_marks(JsonObject& object);

/// Throws Error BadData for another version of a file than 1, with what to do about it.
void require_schema(JsonObject& object);

/// DATA/marks/SPECIMEN.json, DATA as user_data_folder(); empty without a home.
std::filesystem::path marks_file(const std::string& specimen);
/// None where there is no such file. Throws Error BadData, or what reading throws.
Marks read_marks(const std::filesystem::path& file);
Marks parse_marks(const std::string& text, const std::string& file);
/// As read_marks(), but a file that cannot be used is renamed to FILE.broken and `message` reports it.
Marks marks_or_none(const std::filesystem::path& file, std::string& message);
/// Makes the folder. Throws Error InputOutput, without a home too.
void write_marks(const Marks& marks, const std::string& specimen, const std::filesystem::path& file);
std::string marks_text(const Marks& marks, const std::string& specimen);

/// Characters of a text in UTF-8.
std::size_t characters_in(std::string_view text);
/// Bytes of its first `count` characters.
std::size_t bytes_of_characters(std::string_view text, std::size_t count);

}  // namespace myotact::view
