#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace myotact::device {

/// Which of the devices plugged in `now`, each by a text that stays while it is plugged in, is the one that was `own`
/// when there were those of `then`: the same text, else the first that was not there then, since a device may come back
/// in another socket. Nothing: it is not there, or fewer are than then, so that the one that is left may be the other.
std::optional<std::size_t> own_place(const std::vector<std::string>& now, const std::string& own,
                                     const std::vector<std::string>& then);

}  // namespace myotact::device
