#include "layer/layer_threads.h"

#include <chrono>
#include <cmath>

#include <spdlog/spdlog.h>

#include "realtime/periodic_loop.h"

namespace myotact::layer {

namespace {

/// Steps by which simulated time may lag and still be caught up: single long steps do not slow it, steady overload
/// does. Three at 60 Hz are 50 ms.
constexpr std::uint64_t kStepsToCatchUp = 3;
constexpr std::chrono::milliseconds kLook(50);  // a quarter of the silence that is reported

}  // namespace

LayerThreads::LayerThreads(ForceLayer& layer, realtime::Watchdog* watchdog)
    : layer_(layer), devices_(layer.loops(), watchdog) {}

LayerThreads::~LayerThreads() {
  join();
}

void LayerThreads::start() {
  layer_.prepare(realtime::steady_now_ns());
  running_ = true;
  devices_.start();
  engine_thread_ = std::thread([this] {
    try {
      run_engine();
    } catch (...) {
      failure_ = std::current_exception();  // the models grow stale: forces fade
    }
  });
  watch_thread_ = std::thread([this] { watch_engine(); });
}

void LayerThreads::join() noexcept {
  devices_.stop();
  {
    const std::scoped_lock lock(watch_mutex_);
    running_ = false;
  }
  wake_watch_.notify_all();
  if (engine_thread_.joinable()) engine_thread_.join();
  if (watch_thread_.joinable()) watch_thread_.join();
}

void LayerThreads::stop() {
  join();
  if (failure_) std::rethrow_exception(failure_);
}

void LayerThreads::run_engine() {
  const auto step_ns = static_cast<std::uint64_t>(std::llround(layer_.engine().step_s() * 1e9));
  realtime::PeriodicLoop beat(step_ns, kStepsToCatchUp);
  beat.start();
  while (running_.load(std::memory_order_relaxed)) {
    const std::uint64_t begin_ns = beat.wait().now_ns;
    layer_.advance();
    layer_.publish(realtime::steady_now_ns());
    durations_.add(realtime::steady_now_ns() - begin_ns);
  }
}

void LayerThreads::watch_engine() {
  std::unique_lock lock(watch_mutex_);
  bool reported = false;
  while (running_.load(std::memory_order_relaxed)) {
    wake_watch_.wait_for(lock, kLook);
    const std::uint64_t now_ns = realtime::steady_now_ns();
    const auto since_ns = layer_.silent_since_ns(now_ns);
    if (since_ns && !reported) {
      spdlog::warn("{} has reported nothing for {:.2f} s: forces have faded until it does", layer_.engine().name(),
                   1e-9 * static_cast<double>(now_ns - *since_ns));
    }
    reported = since_ns.has_value();
  }
}

}  // namespace myotact::layer
