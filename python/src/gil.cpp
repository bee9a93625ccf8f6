#include "gil.h"

#include <mutex>

#include <pthread.h>
#include <unistd.h>

namespace myotact::python {

namespace {

std::atomic<int> working{0};  // WithoutGil that live
std::atomic<bool> ending{false};

/// The threads that were without the lock are not in the child.
void forget_threads() {
  working = 0;
}

}  // namespace

WithoutGil::WithoutGil() {
  static std::once_flag registered;
  std::call_once(registered, [] { ::pthread_atfork(nullptr, nullptr, forget_threads); });
  if (ending) throw Misuse("Python is ending: nothing more is computed; join your threads before the program ends");
  ++working;
  state_ = PyEval_SaveThread();
}

WithoutGil::~WithoutGil() {
  PyEval_RestoreThread(state_);
  --working;
}

bool is_ending() noexcept {
  return ending;
}

void end_work() {
  ending = true;
  const py::gil_scoped_release released;
  while (working > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void check_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

pid_t Turns::current_process() noexcept {
  return ::getpid();
}

bool Turns::in_own_process() const noexcept {
  return process_ == current_process();
}

void Turns::take() {
  if (!in_own_process()) {
    throw Misuse(
        "this scene was made before the process forked, and its threads stayed behind; make the scene in the child, or "
        "start workers by multiprocessing's \"spawn\"");
  }
  if (owner_.load() == std::this_thread::get_id()) {
    throw Misuse("the scene is in the middle of a step that this very thread makes; call it after the step");
  }
  if (!mutex_.try_lock()) {
    const WithoutGil free;
    mutex_.lock();
  }
  owner_ = std::this_thread::get_id();
}

void Turns::give() noexcept {
  owner_ = std::thread::id{};
  mutex_.unlock();
}

}  // namespace myotact::python
