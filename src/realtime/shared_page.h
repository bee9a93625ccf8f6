#pragma once

#include <cerrno>
#include <new>
#include <system_error>
#include <type_traits>
#include <utility>

#include <sys/mman.h>

namespace myotact::realtime {

/// One T in memory that processes share which this one forks later. T holds atomics only: there is no lock, because a
/// process may die in any place. The memory lives as long as any of them.
template <class T>
class SharedPage {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  /// Throws std::system_error when there is no memory.
  SharedPage() {
    void* memory = ::mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "shared memory");
    value_ = new (memory) T();
  }
  ~SharedPage() { ::munmap(value_, sizeof(T)); }
  SharedPage(const SharedPage&) = delete;
  SharedPage& operator=(const SharedPage&) = delete;

  T* operator->() const noexcept { return value_; }

 private:
  T* value_;
};

}  // namespace myotact::realtime
