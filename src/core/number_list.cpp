#include "core/number_list.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact {

namespace {

/// Before and after the point together: more than an angle or a level needs, and all numbers of a range, written with
/// the digits of its finest one, stay below 10^14. An integer below 2^53 over such a power of ten is the double nearest
/// to the decimal.
constexpr int kMostDigits = 7;

/// value = units / 10^decimals.
struct Decimal {
  std::int64_t units = 0;
  int decimals = 0;
};

std::int64_t power_of_ten(int exponent) {
  std::int64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

/// Nothing for what is no plain decimal number of at most kMostDigits digits.
std::optional<Decimal> parse_decimal(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  Decimal decimal;
  int digits = 0;
  bool after_point = false;
  for (const char c : text) {
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (c < '0' || c > '9' || ++digits > kMostDigits) return std::nullopt;
    decimal.units = 10 * decimal.units + (c - '0');
    decimal.decimals += after_point ? 1 : 0;
  }
  if (digits == 0) return std::nullopt;
  if (negative) decimal.units = -decimal.units;
  return decimal;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

class ListParser {
 public:
  ListParser(const std::string& option, const std::string& text) : option_(option), text_(text) {}

  std::vector<double> parse() {
    for (const std::string& item : split(text_, ',')) {
      const auto parts = split(item, ':');
      if (parts.size() == 1) {
        add(number(item));
      } else if (parts.size() == 3) {
        add_range(parts, item);
      } else {
        throw wrong("\"" + item + "\" must be a number or a range first:step:last, such as 0:0.1:1");
      }
    }
    return values_;
  }

 private:
  Error wrong(const std::string& problem) const {
    return {ExitStatus::Usage, fmt::format("{} {}: {}", option_, text_, problem)};
  }

  Decimal decimal(const std::string& word) const {
    const auto value = parse_decimal(word);
    if (!value) throw wrong(fmt::format("\"{}\" must be a decimal number of at most {} digits", word, kMostDigits));
    return *value;
  }

  /// Of a single number any notation will do.
  double number(const std::string& word) const {
    const auto value = parse_number(word);
    if (!value || !std::isfinite(*value)) throw wrong("\"" + word + "\" is not a number");
    return *value;
  }

  void add(double value) {
    if (values_.size() >= kLongestNumberList) throw wrong(fmt::format("more than {} values", kLongestNumberList));
    values_.push_back(value);
  }

  void add_range(const std::vector<std::string>& parts, const std::string& item) {
    Decimal first = decimal(parts[0]), step = decimal(parts[1]), last = decimal(parts[2]);
    const int decimals = std::max({first.decimals, step.decimals, last.decimals});
    for (Decimal* part : {&first, &step, &last}) part->units *= power_of_ten(decimals - part->decimals);
    if (step.units <= 0) {
      throw wrong(fmt::format("the step of \"{}\" is {}; must be above 0, since tables rise", item, parts[1]));
    }
    if (last.units < first.units) {
      throw wrong(
          fmt::format("\"{0}\" descends; write {2}:{1}:{3}, since tables rise", item, parts[1], parts[2], parts[0]));
    }
    if ((last.units - first.units) % step.units != 0) {
      throw wrong(fmt::format("the steps of \"{}\" miss its last value; choose a step that divides {} - {}", item,
                              parts[2], parts[0]));
    }
    const auto divisor = static_cast<double>(power_of_ten(decimals));
    for (std::int64_t units = first.units; units <= last.units; units += step.units) {
      add(static_cast<double>(units) / divisor);
    }
  }

  const std::string& option_;
  const std::string& text_;
  std::vector<double> values_;
};

}  // namespace

std::vector<double> parse_number_list(const std::string& option, const std::string& text) {
  return ListParser(option, text).parse();
}

}  // namespace myotact
