#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <pybind11/pybind11.h>
#include <sys/types.h>

namespace myotact::python {

namespace py = pybind11;

/// A call that cannot be served where it comes from: out of a step of the same scene, after a fork, or while Python
/// ends.
class Misuse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Releases the interpreter's lock for its lifetime. The interpreter does not end before the last of these has: a
/// thread that came back to it afterwards would be torn down in the middle of C++. Throws Misuse once Python is ending.
class WithoutGil {
 public:
  WithoutGil();
  ~WithoutGil();
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  PyThreadState* state_;
};

/// True once Python is ending: long work gives up.
bool is_ending() noexcept;

/// Makes is_ending() true and waits for all WithoutGil; for Python's atexit. With the lock held.
void end_work();

/// Throws what a signal's handler raised (KeyboardInterrupt). With the lock held.
void check_signals();

/// The turn of one thread with a scene. All others wait, without the interpreter's lock: whoever holds a turn may want
/// it. With the lock held. Throws Misuse where the wait would have no end.
class Turns {
 public:
  void take();
  void give() noexcept;
  /// False in a child that was forked off: the scene's threads were left behind.
  bool in_own_process() const noexcept;

 private:
  std::mutex mutex_;
  std::atomic<std::thread::id> owner_{};
  pid_t process_ = current_process();

  static pid_t current_process() noexcept;
};

class Turn {
 public:
  explicit Turn(Turns& turns) : turns_(turns) { turns_.take(); }
  ~Turn() { turns_.give(); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  Turns& turns_;
};

/// Does long work in a thread of its own while this one waits without the lock and looks for signals now and then. The
/// work is to end soon once its argument returns true; what it then returns or throws is dropped for the signal's
/// exception.
template <class Work>
auto watched(Work work) {
  constexpr auto kLook = std::chrono::milliseconds(50);
  std::atomic<bool> stopped{false};
  const std::function<bool()> stop = [&] { return stopped.load() || is_ending(); };
  auto result = [&] {
    const WithoutGil free;  // a thread may take the while of a fork to start
    return std::async(std::launch::async, [&] { return work(stop); });
  }();
  while (true) {
    {
      const WithoutGil free;
      if (result.wait_for(kLook) == std::future_status::ready) break;
    }
    try {
      check_signals();
    } catch (...) {
      stopped = true;
      const WithoutGil free;
      result.wait();
      throw;
    }
  }
  return result.get();
}

}  // namespace myotact::python
