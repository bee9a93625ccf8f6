#include "support/allocation_guard.h"

#include <cstdlib>
#include <new>

// clang's thread sanitizer brings operators of its own and lets nobody replace them: there, nothing is counted.
#if defined(__clang__)
#if __has_feature(thread_sanitizer)
#define MYOTACT_COUNTS_NOTHING
#endif
#endif

namespace {

thread_local std::uint64_t allocations_of_this_thread = 0;

#ifndef MYOTACT_COUNTS_NOTHING
/// Null where there is no memory.
void* allocate(std::size_t size, std::size_t alignment) noexcept {
  ++allocations_of_this_thread;
  const std::size_t whole = (size + alignment - 1) / alignment * alignment;  // aligned_alloc asks for a multiple
  return std::aligned_alloc(alignment, whole == 0 ? alignment : whole);
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* memory = allocate(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
#endif

}  // namespace

#ifndef MYOTACT_COUNTS_NOTHING
// The forms for arrays end in these. The nothrow forms would too, were it not for the address sanitizer, which brings
// its own, and then finds that memory given back by std::free.
void* operator new(std::size_t size) {
  return allocate_or_throw(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
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
#endif

namespace myotact::support {

AllocationGuard::AllocationGuard() : at_start_(allocations_of_this_thread) {}

std::uint64_t AllocationGuard::allocations() const {
  return allocations_of_this_thread - at_start_;
}

}  // namespace myotact::support
