#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace myotact::simulation {

/// A fixed set of threads that share the tasks of one stage of a step. Between stages they sleep on a condition
/// variable and never spin, because the haptic thread lives on the same cores. Which thread takes which task is left to
/// chance, so a task may write only what its index owns; then the result does not depend on the number of threads.
class WorkerPool {
 public:
  /// `workers` >= 1 counts the calling thread; 1 makes no thread and runs tasks in a plain loop. Throws
  /// std::system_error when a thread cannot be made. The destructor waits for the threads; no run() may be under way.
  explicit WorkerPool(int workers);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int workers() const { return static_cast<int>(threads_.size()) + 1; }  // the calling thread included

  /// Calls task(index) once for each index in 0 .. count-1 and returns when all are done. All run even when one throws;
  /// then the exception of the lowest index is thrown here. One caller at a time; a task must not call run().
  /// Allocates nothing.
  template <class Task>
  void run(int count, Task&& task) {
    using Callable = std::remove_reference_t<Task>;
    run_job({count, const_cast<void*>(static_cast<const void*>(std::addressof(task))),
             [](void* callable, int index) { (*static_cast<Callable*>(callable))(index); }});
  }

 private:
  /// The tasks of one run(), type erased.
  struct Job {
    int count = 0;
    void* callable = nullptr;
    void (*call)(void* callable, int index) = nullptr;
  };

  /// Hands the job to all threads, takes part in it and waits for the others.
  void run_job(const Job& job);
  void take_tasks();  // until none is left
  void serve();       // what each thread runs

  std::mutex mutex_;  // guards all below but next_
  std::condition_variable wake_;
  std::condition_variable done_;
  Job job_;
  std::uint64_t generation_ = 0;  // one a run
  int busy_ = 0;                  // threads that have not finished this generation
  bool quitting_ = false;
  int failed_index_ = -1;
  std::exception_ptr failure_;
  std::atomic<int> next_{0};
  std::vector<std::thread> threads_;
};

}  // namespace myotact::simulation
