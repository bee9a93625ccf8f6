#pragma once

#include <cstddef>
#include <functional>

namespace myotact::prepare {

/// Calls task(0) .. task(count - 1) from `threads` threads, in any order, and returns when all are done. Tasks write to
/// places of their own, so the result does not depend on the number of threads. When one throws, no
/// further task begins, and the error of the lowest index is thrown on: tasks begin in their order, so it is always the
/// same one.
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace myotact::prepare
