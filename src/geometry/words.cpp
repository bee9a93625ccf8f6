#include "geometry/words.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::geometry {

namespace {

constexpr const char* kCutShort = "the file ends early; it was cut short: write or copy it again";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string_view without_comment(std::string_view line, char comment) {
  for (std::size_t at = line.find(comment); at != std::string_view::npos; at = line.find(comment, at + 1)) {
    if (at == 0 || is_blank(line[at - 1])) return line.substr(0, at);
  }
  return line;
}

}  // namespace

std::string shown(std::string_view word) {
  constexpr std::size_t kLongestShown = 40;  // characters
  return std::string(word.substr(0, kLongestShown));
}

std::string_view Words::next() {
  skip_blanks();
  const std::size_t start = position_;
  word_line_ = line_;
  word_start_ = start;
  while (position_ < text_.size() && !is_blank(text_[position_])) ++position_;
  if (start == position_) throw error(kCutShort);
  return text_.substr(start, position_ - start);
}

bool Words::at_end() {
  skip_blanks();
  return position_ == text_.size();
}

std::string_view Words::rest_of_line() {
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  const std::string_view line = text_.substr(position_, end - position_);
  word_line_ = line_;
  word_start_ = position_;
  position_ = std::min(end + 1, text_.size());
  if (end < text_.size()) ++line_;
  if (line.size() > kLongestLine_bytes) {
    throw error(fmt::format("the line has {} bytes; at most {} are read", line.size(), kLongestLine_bytes));
  }
  return comment_ == '\0' ? line : without_comment(line, comment_);
}

std::vector<std::string_view> Words::next_line() {
  if (at_end()) throw error(kCutShort);
  return words_of(rest_of_line());
}

std::string_view Words::bytes(std::size_t count) {
  binary_ = true;
  word_start_ = position_;
  if (count > left()) throw error(kCutShort);
  position_ += count;
  return text_.substr(word_start_, count);
}

void Words::expect(std::string_view word) {
  const std::string_view found = next();
  if (found != word) throw error(fmt::format("is \"{}\"; must be \"{}\"", shown(found), word));
}

double Words::number_in(std::string_view word) const {
  const auto value = parse_number(word);
  if (!value || !std::isfinite(*value)) throw error(fmt::format("\"{}\" is no finite number", shown(word)));
  return *value;
}

int Words::integer_in(std::string_view word, int lowest, int highest) const {
  return whole(number_in(word), lowest, highest);
}

int Words::whole(double value, int lowest, int highest) const {
  if (!(value >= lowest && value <= highest) || value != std::floor(value)) {
    throw error(fmt::format("{} must be a whole number from {} to {}", to_text(value), lowest, highest));
  }
  return static_cast<int>(value);
}

Error Words::error(const std::string& problem) const {
  return bad_data(file_, binary_ ? fmt::format("byte {}", word_start_) : fmt::format("line {}", word_line_), problem);
}

void Words::skip_blanks() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (comment_ != '\0' && c == comment_) {
      position_ = std::min(text_.find('\n', position_), text_.size());
      continue;
    }
    if (!is_blank(c)) return;
    line_ += c == '\n' ? 1 : 0;
    ++position_;
  }
}

}  // namespace myotact::geometry
