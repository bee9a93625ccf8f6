#include "simulation/worker_pool.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace myotact::simulation {
namespace {

TEST(WorkerPool, RunsEveryIndexOnceWhateverTheWorkers) {
  for (const int workers : {1, 2, 4}) {
    WorkerPool pool(workers);
    EXPECT_EQ(pool.workers(), workers);
    std::vector<int> calls(97, 0);
    for (int round = 0; round < 200; ++round) {
      pool.run(static_cast<int>(calls.size()), [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
    }
    for (const int count : calls) EXPECT_EQ(count, 200);
    pool.run(0, [](int) { FAIL(); });
  }
}

TEST(WorkerPool, TasksRunAtTheSameTime) {
  WorkerPool pool(2);
  std::atomic<int> arrived{0};
  bool met[2] = {false, false};
  // Each task waits for the other: with one thread alone this would run into the deadline.
  pool.run(2, [&](int i) {
    ++arrived;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (arrived.load() < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    met[i] = arrived.load() == 2;
  });
  EXPECT_TRUE(met[0] && met[1]);
}

TEST(WorkerPool, HandsOnTheExceptionOfTheLowestIndexAfterAllRan) {
  for (const int workers : {1, 3}) {
    WorkerPool pool(workers);
    std::atomic<int> calls{0};
    const auto task = [&](int i) {
      ++calls;
      if (i == 3 || i == 7) throw std::runtime_error("task " + std::to_string(i));
    };
    for (int round = 1; round <= 20; ++round) {
      try {
        pool.run(10, task);
        FAIL() << "no exception";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "task 3");
      }
      EXPECT_EQ(calls.load(), 10 * round);
    }
    pool.run(2, [](int) {});  // usable afterwards
  }
}

}  // namespace
}  // namespace myotact::simulation
