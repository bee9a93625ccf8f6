#pragma once

#include <functional>
#include <vector>

#include "haptics/proxy/proxy.h"
#include "haptics/surfaces.h"
#include "realtime/periodic_loop.h"

namespace myotact::haptics {

/// Plays a moving mesh to a proxy: models at a fixed step, published at the step's end, ticks of 1 ms.
class SurfacePlayer {
 public:
  using Shape = std::function<std::vector<Vec3>(double time_s)>;
  static constexpr std::uint64_t kTick_ns = 1'000'000;

  SurfacePlayer(const geometry::TriangleMesh& mesh, Shape shape, const ContactSettings& settings,
                std::uint64_t step_ns = 10'000'000)
      : proxy(settings), mesh_(mesh), shape_(std::move(shape)), step_ns_(step_ns) {}

  /// One tick of the proxy towards `goal`.
  void tick(const ProxyGoal& goal) {
    now_ns_ += kTick_ns;
    const bool is_new = !started_ || now_ns_ >= model_.published_at_ns + step_ns_;
    if (is_new) publish(started_ ? proxy.position_m() : goal.position_m);
    const std::uint64_t begin_ns = realtime::steady_now_ns();
    surface.begin_tick(model_, now_ns_, is_new);
    proxy.tick(surface, model_, goal, 1e-9 * static_cast<double>(kTick_ns));
    tick_duration_ns = realtime::steady_now_ns() - begin_ns;
  }

  /// The surface that the proxy met in the last tick.
  std::vector<Vec3> surface_now_m() const {
    const double s =
        std::min(1.0, static_cast<double>(now_ns_ - model_.published_at_ns) / static_cast<double>(step_ns_));
    std::vector<Vec3> now_m(current_m_.size());
    for (std::size_t i = 0; i < now_m.size(); ++i) now_m[i] = (1.0 - s) * previous_m_[i] + s * current_m_[i];
    return now_m;
  }
  double time_s() const { return 1e-9 * static_cast<double>(now_ns_); }
  const geometry::TriangleMesh& mesh() const { return mesh_; }
  const messages::LocalModel& model() const { return model_; }

  Proxy proxy;
  MovingSurface surface;
  std::uint64_t tick_duration_ns = 0;  // of the last tick, without the publishing

 private:
  void publish(const Vec3& centre_m) {
    previous_m_ = started_ ? current_m_ : shape_(time_s());
    current_m_ = shape_(time_s() + 1e-9 * static_cast<double>(step_ns_));
    write_patch(mesh_, previous_m_, current_m_, centre_m, model_);
    ++model_.sequence;
    model_.published_at_ns = now_ns_;
    model_.dt_ns = step_ns_;
    started_ = true;
  }

  geometry::TriangleMesh mesh_;
  Shape shape_;
  std::uint64_t step_ns_;
  std::uint64_t now_ns_ = 0;
  bool started_ = false;
  messages::LocalModel model_;
  std::vector<Vec3> previous_m_, current_m_;
};

}  // namespace myotact::haptics
