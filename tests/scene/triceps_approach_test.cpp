// Random approaches to the triceps while the elbow swings: the proxy must never be found inside the muscle.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "geometry/depth_inside.h"
#include "haptics/proxy/proxy.h"
#include "simulation/simulation.h"

namespace myotact::scene {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000, kStep_ns = 10 * kTick_ns;

class Triceps {
 public:
  Triceps() : specimen(anatomy::load_specimen(data_folder() / "meshes" / "canine_elbow")), simulation(specimen, {}) {
    for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
      if (specimen.muscles[static_cast<std::size_t>(m)].key == "triceps_brachii_long") muscle = m;
    }
    const std::vector<double> angles(specimen.joints.size(), 0.0);
    simulation.settle(angles, {});
    find_free_places();
  }

  /// All muscles of the elbow pull by turns, twice a second: the joint swings and the bellies swell.
  void step() {
    const double phase = 4.0 * std::numbers::pi * simulation.time_s();
    for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
      const bool flexor = specimen.muscles[static_cast<std::size_t>(m)].key.starts_with("b");
      simulation.set_excitation(m, 0.15 * (1.0 + (flexor ? -1.0 : 1.0) * std::sin(phase)));
    }
    const std::vector<Vec3> before(skin_m().begin(), skin_m().end());
    simulation.step({});
    for (std::size_t i = 0; i < before.size(); ++i) {
      largest_motion_m = std::max(largest_motion_m, (skin_m()[i] - before[i]).norm());
    }
  }

  std::span<const Vec3> skin_m() const { return simulation.skin_world_m(muscle); }
  const geometry::TriangleMesh& skin() const { return specimen.muscles[static_cast<std::size_t>(muscle)].skin; }
  Vec3 normal_at(int vertex) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& t : skin().triangles) {
      if (std::find(t.begin(), t.end(), vertex) == t.end()) continue;
      const Vec3 a = skin_m()[static_cast<std::size_t>(t[0])];
      sum += (skin_m()[static_cast<std::size_t>(t[1])] - a).cross(skin_m()[static_cast<std::size_t>(t[2])] - a);
    }
    return sum.normalized();
  }

  anatomy::Specimen specimen;
  simulation::Simulation simulation;
  int muscle = -1;
  std::vector<int> free_places;   // vertices of the skin
  double largest_motion_m = 0.0;  // of a vertex in one step

 private:
  /// Free: the 20 mm outward from the vertex meet no other surface within 6 mm.
  void find_free_places() {
    for (int v = 0; v < static_cast<int>(skin_m().size()); ++v) {
      const Vec3 start = skin_m()[static_cast<std::size_t>(v)], out = normal_at(v);
      bool is_free = true;
      for (double d = 2e-3; d <= 20e-3 && is_free; d += 3e-3) is_free = !near_other(start + d * out);
      if (is_free) free_places.push_back(v);
    }
  }
  bool near_other(const Vec3& p) const {
    const auto close = [&p](const Vec3& q) { return (q - p).squaredNorm() < 6e-3 * 6e-3; };
    for (int m = 0; m < static_cast<int>(specimen.muscles.size()); ++m) {
      const auto other = simulation.skin_world_m(m);
      if (m != muscle && std::any_of(other.begin(), other.end(), close)) return true;
    }
    return std::any_of(specimen.bones.begin(), specimen.bones.end(), [&](const anatomy::Bone& bone) {
      return std::any_of(bone.surface.positions_m.begin(), bone.surface.positions_m.end(), close);
    });
  }
};

/// One hand that goes at a place of the skin and 8 mm beyond.
struct Approach {
  explicit Approach(const haptics::ContactSettings& settings) : proxy(settings), radius_m(settings.radius_m) {}

  haptics::Proxy proxy;
  haptics::MovingSurface surface;
  messages::LocalModel model;
  double radius_m;
  int vertex = -1;
  Vec3 out = Vec3::UnitZ(), across = Vec3::UnitX();
  double speed_m_s = 0.1;
};

constexpr int kHands = 200, kRounds = 50, kStepsPerRound = 8;

TEST(TouchTissue, TenThousandApproachesNeverFallThroughTheMovingTriceps) {
  Triceps triceps;
  ASSERT_GT(triceps.free_places.size(), 20u);
  std::mt19937_64 random(20261121);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<std::size_t> place(0, triceps.free_places.size() - 1);
  int inside = 0, touched = 0, approaches = 0;
  std::uint64_t now_ns = kTick_ns, rescues = 0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::unique_ptr<Approach>> hands;
    for (int h = 0; h < kHands; ++h) {
      haptics::ContactSettings settings;
      settings.radius_m = 1e-3 + 3e-3 * unit(random);
      settings.static_friction = settings.dynamic_friction = 0.6 * unit(random);
      hands.push_back(std::make_unique<Approach>(settings));
      Approach& hand = *hands.back();
      hand.vertex = triceps.free_places[place(random)];
      hand.out = triceps.normal_at(hand.vertex);
      hand.across = hand.out.cross(Vec3(unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5)).normalized();
      hand.speed_m_s = 0.15 * std::pow(8.0, unit(random));
    }
    std::vector<char> has_touched(hands.size(), 0), fell(hands.size(), 0);
    const std::vector<Vec3> start_m(triceps.skin_m().begin(), triceps.skin_m().end());
    int tick = 0;
    for (int step = 0; step < kStepsPerRound; ++step) {
      triceps.step();
      for (auto& hand : hands) {
        messages::ToolState tool;
        const Vec3 first = start_m[static_cast<std::size_t>(hand->vertex)] + 12e-3 * hand->out;
        tool.proxy_position_world_m = to_array(step == 0 ? first : hand->proxy.position_m());
        tool.tool_position_world_m = tool.proxy_position_world_m;
        triceps.simulation.write_local_model(tool, hand->model);
        hand->model.published_at_ns = now_ns;
        hand->model.dt_ns = kStep_ns;
      }
      for (int k = 1; k <= 10; ++k, ++tick) {
        for (std::size_t h = 0; h < hands.size(); ++h) {
          Approach& hand = *hands[h];
          const double way_m = std::min(1e-3 * hand.speed_m_s * tick, 20e-3);
          haptics::ProxyGoal goal;
          goal.position_m = start_m[static_cast<std::size_t>(hand.vertex)] + (12e-3 - way_m) * hand.out +
                            0.4 * 1e-3 * hand.speed_m_s * tick * hand.across;
          goal.velocity_m_s = -hand.speed_m_s * hand.out;
          hand.surface.begin_tick(hand.model, now_ns + static_cast<std::uint64_t>(k) * kTick_ns, k == 1);
          hand.proxy.tick(hand.surface, hand.model, goal, 1e-3);
          if (hand.proxy.contact().active && hand.proxy.contact().surface == triceps.muscle) has_touched[h] = 1;
        }
      }
      now_ns += kStep_ns;
      for (std::size_t h = 0; h < hands.size(); ++h) {
        if (geometry::winding_number(triceps.skin(), triceps.skin_m(), hands[h]->proxy.position_m()) > 0.5) fell[h] = 1;
      }
    }
    for (std::size_t h = 0; h < hands.size(); ++h) {
      ++approaches;
      touched += has_touched[h];
      inside += fell[h];
      rescues += hands[h]->proxy.counters().rescues;
    }
  }
  std::printf("%d approaches, %d touched the triceps, %d inside, %lu rescues; skin moves up to %.2f mm a step\n",
              approaches, touched, inside, rescues, 1e3 * triceps.largest_motion_m);
  EXPECT_EQ(inside, 0);
  EXPECT_GT(touched, approaches * 8 / 10);
  EXPECT_GT(triceps.largest_motion_m, 0.5e-3);
}

}  // namespace
}  // namespace myotact::scene
