#pragma once

#include <cstdint>

namespace myotact::support {

/// Counts what this thread allocates by operator new from the guard's construction on.
class AllocationGuard {
 public:
  AllocationGuard();
  std::uint64_t allocations() const;

 private:
  std::uint64_t at_start_;
};

}  // namespace myotact::support
