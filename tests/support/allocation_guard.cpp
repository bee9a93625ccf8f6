#include "support/allocation_guard.h"

#include <cstdlib>
#include <new>

namespace {

thread_local std::uint64_t allocations_of_this_thread = 0;

void* allocate(std::size_t size, std::size_t alignment) {
  ++allocations_of_this_thread;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;  // aligned_alloc asks for a multiple
  void* memory = std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

// The other forms of new and delete end in these.
void* operator new(std::size_t size) {
  return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace myotact::support {

AllocationGuard::AllocationGuard() : at_start_(allocations_of_this_thread) {}

std::uint64_t AllocationGuard::allocations() const {
  return allocations_of_this_thread - at_start_;
}

}  // namespace myotact::support
