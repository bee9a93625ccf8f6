#include "simulation/simd/batch.h"

#include <algorithm>
#include <atomic>

namespace myotact::simulation {
namespace {

VectorUnit widest_unit() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("fma") && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return VectorUnit::Avx512;
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return VectorUnit::Avx2;
#endif
  return VectorUnit::Sse2;
}

std::atomic<VectorUnit>& unit_in_use() {
  static std::atomic<VectorUnit> unit = widest_unit();
  return unit;
}

}  // namespace

VectorUnit vector_unit() {
  return unit_in_use().load(std::memory_order_relaxed);
}

void allow_vector_unit(VectorUnit widest) {
  unit_in_use().store(std::min(widest, widest_unit()), std::memory_order_relaxed);
}

}  // namespace myotact::simulation
