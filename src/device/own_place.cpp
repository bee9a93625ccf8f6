#include "device/own_place.h"

#include <algorithm>

namespace myotact::device {

std::optional<std::size_t> own_place(const std::vector<std::string>& now, const std::string& own,
                                     const std::vector<std::string>& then) {
  if (now.size() < then.size()) return std::nullopt;
  auto found = std::find(now.begin(), now.end(), own);
  if (found == now.end()) {
    found = std::find_if(now.begin(), now.end(), [&](const std::string& place) {
      return std::find(then.begin(), then.end(), place) == then.end();
    });
  }
  if (found == now.end()) return std::nullopt;
  return static_cast<std::size_t>(found - now.begin());
}

}  // namespace myotact::device
