#pragma once

#include <string>

namespace myotact::app {

/// The second of eight nearly equal shares: part 2 of 8.
struct Shard {
  int part = 1, parts = 1;
};

/// Of --shard, "2/8"; an empty text is the whole. Throws Error Usage for anything but 1 <= part <= parts <= most_parts.
Shard shard_of(const std::string& text, int most_parts);

}  // namespace myotact::app
