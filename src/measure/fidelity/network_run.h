#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/vector.h"
#include "remote/delayed_session.h"
#include "scene/scene_file.h"

namespace myotact::measure {

/// What the network between a hand and its simulation does.
struct NetworkCase {
  double round_trip_s = 0.0;
  double jitter_s = 0.0;      // each way
  double stalls_per_s = 0.0;  // each way, of 0.1 s
};

/// What a hand went through, tick by tick.
struct NetworkRun {
  std::vector<Vec3> hand_m;                 // where it wanted the stylus
  std::vector<Vec3> force_N;                // sent to the device
  double most_net_J = 0.0;                  // net work on the hand since it last felt nothing, while the gate was open
  double jitter_N = 0.0;                    // of the force above 20 Hz while touched, root mean square
  double largest_rise_after_break_N = 0.0;  // of the force from one tick to the next, within 0.2 s of a break's end
  double largest_age_s = 0.0;               // of the content of the models, as reported, while the gate was open
  std::uint64_t buzzes = 0;
  std::uint64_t faded_ticks = 0;  // the gate was not open
  std::uint64_t touched_ticks = 0;
};

struct NetworkRunRequest {
  NetworkCase link;
  double seconds = 60.0;
  std::uint64_t seed = 1;
  const std::vector<Vec3>* path_m = nullptr;  // of an earlier run; null: found as the hand goes
  std::function<bool()> stopped = [] { return false; };
};

/// A hand that pokes, presses, slides and lets go, with tremor, on the first muscle that the scene's script touches
/// (else the first of all), all muscles relaxed, felt over that network. In a scene of one spring it swings through its
/// anchor instead. Throws Error BadData for a scene without muscle or spring.
NetworkRun run_over_network(const scene::Scene& scene, const NetworkRunRequest& request);

}  // namespace myotact::measure
