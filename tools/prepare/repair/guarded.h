#pragma once

#include <exception>

#include <CGAL/assertions_behaviour.h>

// Calls of CGAL that may throw. Its own handler would print what it throws.

namespace myotact::prepare {

class QuietCgal {
 public:
  QuietCgal() : error_(CGAL::set_error_handler(silent)), warning_(CGAL::set_warning_handler(silent)) {}
  ~QuietCgal() {
    CGAL::set_error_handler(error_);
    CGAL::set_warning_handler(warning_);
  }
  QuietCgal(const QuietCgal&) = delete;
  QuietCgal& operator=(const QuietCgal&) = delete;

 private:
  static void silent(const char*, const char*, const char*, int, const char*) {}

  CGAL::Failure_function error_, warning_;
};

/// What `work` returns, or nothing when it throws: the callers say what could not be done, and where.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
  const QuietCgal quiet;
  try {
    return work();
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace myotact::prepare
