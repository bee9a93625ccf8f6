#include "simulation/worker_pool.h"

#include <utility>

namespace myotact::simulation {

WorkerPool::WorkerPool(int workers) {
  for (int i = 1; i < workers; ++i) threads_.emplace_back([this] { serve(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    quitting_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkerPool::run_job(const Job& job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = job;
    next_.store(0, std::memory_order_relaxed);
    busy_ = static_cast<int>(threads_.size());
    ++generation_;
  }
  wake_.notify_all();
  take_tasks();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  failed_index_ = -1;
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void WorkerPool::take_tasks() {
  for (;;) {
    const int index = next_.fetch_add(1, std::memory_order_relaxed);
    if (index >= job_.count) return;
    try {
      job_.call(job_.callable, index);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (failed_index_ < 0 || index < failed_index_) {
        failed_index_ = index;
        failure_ = std::current_exception();
      }
    }
  }
}

void WorkerPool::serve() {
  std::uint64_t served = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [&] { return quitting_ || generation_ != served; });
    if (quitting_) return;
    served = generation_;
    lock.unlock();
    take_tasks();
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace myotact::simulation
