#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace myotact::remote {

/// What a window shows of the class that it leads.
struct ClassNews {
  std::string join_link;  // that students open; empty: there is no page, or this is not for an instructor
  std::size_t students = 0, hands_up = 0;
};

/// Of what a server said to its class (src/net/README.md). Empty where this is nothing of the kind.
std::optional<ClassNews> class_news(const std::string& announcement);

}  // namespace myotact::remote
