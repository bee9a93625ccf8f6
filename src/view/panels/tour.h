#pragma once

#include <cstddef>

namespace myotact::view {

/// What a person should know at first, in a few steps, each beside the control that it is about. Can be skipped.
class Tour {
 public:
  /// Draws the present step; true when the person came to the end or skipped the rest.
  bool draw();

 private:
  std::size_t step_ = 0;
};

}  // namespace myotact::view
