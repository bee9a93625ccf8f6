#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/vector.h"
#include "messages/local_model.h"

namespace myotact::haptics {

struct BoneDragSettings {
  double stiffness_N_m = 800.0;  // of the grip as the hand feels it, that is after the force scale
  double damping_Ns_m = 1.0;     // of the grip, likewise (own choice)
  double force_scale = 1.0;      // felt over simulated force
};

/// A point of a bone in hand: a spring that is slack where the hand closed, between the hand and the point.
///
///   hand o--/\/\--o point        f = gain (k (hand - offset - point) + b (v_hand - v_point)), -scale f on the hand
///
/// Between two models the point moves here, once a tick and implicitly, by what the newest one says of its mobility,
/// stiffness and damping: with the point held for 10 ms, or played 10 ms late, a limb that swings freely would feel as
/// if in oil (k times the lag: 8 N s/m and more). Each model then corrects the point: the simulation's place is
/// compared with where the point was here when the simulation looked at the hand, so that the age of the model does not
/// matter.
///
///   ticks      t1  t2 ... t10 | ...        error = simulated - here, both at the tick whose ToolState was used;
///   ToolState              '--> step --> LocalModel: position += half of it, velocity += a tenth; the hand feels
///                                                    it spread over a step
///
/// Half and a tenth were found by trying: point masses of 5 g to 1.5 kg on 0 to 1000 N/m, grips of 300 to 1000 N/m and
/// models 0 or 1 step late all stay calm in a hand; whole corrections do not, because limb and model overshoot
/// alternately. Force rises over 100 ms after the grab and dies out over 100 ms after the release, in the simulation
/// too. Real-time safe; one thread.
class BoneDrag {
 public:
  explicit BoneDrag(const BoneDragSettings& settings);

  struct Tool {
    Vec3 position_m = Vec3::Zero();
    Vec3 velocity_m_s = Vec3::Zero();
    bool holds = false;          // the bone button is down
    double peak_N = 0.0;         // no more is felt, and no more pulls at the bone than that much over the force scale
    std::uint64_t sequence = 0;  // of the ToolState that this tick will write
  };

  /// Force on the hand [N], scaled. `model`: the newest, null: none; `is_new`: not that of the last tick. `dt_s` > 0.
  Vec3 tick(const messages::LocalModel* model, bool is_new, const Tool& tool, double dt_s) noexcept;

  std::int32_t body() const noexcept { return body_; }  // in hand or just let go, or -1
  const std::array<double, 3>& point_rest_m() const noexcept { return grip_.point_rest_m; }
  double gain() const noexcept { return gain_; }  // 0 .. 1, how far the hand has closed
  /// Of the grab spring in the simulation, unscaled; 0 with nothing in hand.
  double stiffness_N_m() const noexcept;
  /// Where that spring pulls the point so that it gets the opposite of the hand's force.
  const Vec3& target_m() const noexcept { return target_m_; }

 private:
  struct Motion {
    Vec3 position_m = Vec3::Zero();
    Vec3 velocity_m_s = Vec3::Zero();
  };
  static constexpr std::size_t kTicksKept = 64;  // models older than 64 ms correct nothing; the gate fades them out

  void grab(const messages::LocalGrip& grip, const Tool& tool) noexcept;
  void correct(const messages::LocalModel& model, const Tool& tool, double dt_s) noexcept;
  Vec3 advance(const Tool& tool, double dt_s) noexcept;
  Motion& kept(std::uint64_t sequence) noexcept { return kept_[sequence % kTicksKept]; }

  BoneDragSettings settings_;
  double to_simulated_;  // by which a felt stiffness, damping or force becomes one of the simulation
  std::int32_t body_ = -1;
  messages::LocalGrip grip_;  // newest of the point in hand
  double gain_ = 0.0;
  bool held_before_ = false;
  Vec3 offset_m_ = Vec3::Zero();  // from point to hand when it closed
  Motion point_;
  std::array<Motion, kTicksKept> kept_{};  // the point at the last ticks, by sequence
  std::uint64_t first_kept_ = 0;           // sequence of the tick that closed the hand
  Vec3 unplayed_m_ = Vec3::Zero();         // part of the corrections that the hand does not feel yet
  Vec3 played_a_tick_m_ = Vec3::Zero();
  Vec3 target_m_ = Vec3::Zero();
};

}  // namespace myotact::haptics
