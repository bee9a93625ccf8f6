#include "app/shard.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::app {

Shard shard_of(const std::string& text, int most_parts) {
  if (text.empty()) return {};
  const std::size_t slash = text.find('/');
  const auto part = parse_number(text.substr(0, slash));
  const auto parts = slash == std::string::npos ? std::nullopt : parse_number(text.substr(slash + 1));
  const bool usable = part && parts && *part >= 1.0 && *part <= *parts && *parts <= most_parts &&
                      std::floor(*part) == *part && std::floor(*parts) == *parts;
  if (!usable) {
    throw Error(
        ExitStatus::Usage,
        fmt::format("--shard {}: must be part/parts with 1 <= part <= parts <= {}, such as 2/8", text, most_parts));
  }
  return {static_cast<int>(*part), static_cast<int>(*parts)};
}

}  // namespace myotact::app
