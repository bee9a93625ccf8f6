#pragma once

#include <cstddef>

namespace myotact {

/// An index of ours, which is an int of at least 0, as the standard containers take it.
constexpr std::size_t at(int index) noexcept {
  return static_cast<std::size_t>(index);
}

}  // namespace myotact
