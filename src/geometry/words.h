#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace myotact::geometry {

/// Words of a text file, one after the other, with the line they stand in. Refers to `text`, which must outlive it.
/// What does not fit throws Error BadData naming file, line and value.
class Words {
 public:
  /// From a word that begins with `comment`, if given, the rest of a line is read over. Within a word it is a part of
  /// it: "1.#INF", as some programs write infinity, must not pass for 1.
  Words(std::string file, std::string_view text, char comment = '\0')
      : file_(std::move(file)), text_(text), comment_(comment) {}

  std::string_view next();
  bool at_end();
  /// What is left of the present line; the next word comes from the line after it. Lines that are too long to be taken
  /// apart are refused.
  std::string_view rest_of_line();
  /// The words of the next line that has any.
  std::vector<std::string_view> next_line();
  /// The next bytes as they are. From here on errors name the byte: lines mean nothing in binary data.
  std::string_view bytes(std::size_t count);
  /// Bytes that are not taken yet.
  std::size_t left() const { return text_.size() - position_; }

  void expect(std::string_view word);
  double number() { return number_in(next()); }
  int integer(int lowest, int highest) { return integer_in(next(), lowest, highest); }
  /// The same of a word that was already taken.
  double number_in(std::string_view word) const;
  int integer_in(std::string_view word, int lowest, int highest) const;
  /// `value`, taken last, when it is a whole number of the range.
  int whole(double value, int lowest, int highest) const;

  /// Names the line, or in binary data the byte, of what was taken last.
  Error error(const std::string& problem) const;

 private:
  void skip_blanks();

  std::string file_;
  std::string_view text_;
  char comment_;
  std::size_t position_ = 0;
  int line_ = 1;       // at position_
  int word_line_ = 1;  // of the word taken last
  std::size_t word_start_ = 0;
  bool binary_ = false;  // some bytes were taken
};

/// As much of a word as a message shows, whatever the file holds.
std::string shown(std::string_view word);

/// Room for the largest polygon several times over; bounds the memory for a line's words.
inline constexpr std::size_t kLongestLine_bytes = std::size_t{1} << 20;

/// Readers refuse meshes with more nodes or tets: ten times the largest scan seen; bounds their memory.
inline constexpr int kMostMeshElements = 20'000'000;

}  // namespace myotact::geometry
