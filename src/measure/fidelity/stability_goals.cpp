#include "measure/fidelity/stability_goals.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "device/profile_file.h"
#include "measure/fidelity/calm_stiffness.h"
#include "measure/fidelity/virtual_touch.h"
#include "scene/texture_file.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = 1e-3;

// ---- 15: energy

/// A hand that goes to random places in and above the tissue at random speeds and takes hold of line and bone.
class Poking {
 public:
  explicit Poking(std::uint64_t seed) : random_(seed) {}

  device::HandTarget next() {
    if (left_ == 0) {
      left_ = 50 + static_cast<int>(400.0 * unit());
      const double high = unit();
      from_m_ = to_m_;
      to_m_ = Vec3(0.08 * (unit() - 0.5), 0.08 * (unit() - 0.5), high < 0.7 ? 0.02 * unit() - 0.012 : 0.08 * unit());
      const double grab = unit();
      buttons_ = grab < 0.1 ? messages::kGrabButton : grab < 0.2 ? messages::kGrabBoneButton : 0u;
      whole_ = left_;
    }
    --left_;
    const double share = 1.0 - static_cast<double>(left_) / whole_;
    return {to_array(Vec3(from_m_ + share * (to_m_ - from_m_))), {}, buttons_};
  }

 private:
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

  std::mt19937_64 random_;
  int left_ = 0, whole_ = 1;
  Vec3 from_m_{0.0, 0.0, 0.02}, to_m_{0.0, 0.0, 0.02};
  std::uint32_t buttons_ = 0;
};

struct EnergyGiven {
  double most_J = 0.0;  // net, since the start
  /// Net, since the hand last touched nothing: what friction took before pays for nothing. Less what a closing hand
  /// found stored in line and bone.
  double most_in_touch_J = 0.0;
  double end_J = 0.0;
  double largest_N = 0.0;
  double touched_s = 0.0;
};

EnergyGiven poke(double seconds) {
  haptics::HapticSettings settings;
  settings.texture = scene::own_textures();
  VirtualTouch touch({true, true, true}, Vec3(0.0, 0.0, 0.02), {}, {}, settings);
  Poking poking(15);
  EnergyGiven given;
  double since_start_J = 0.0, in_touch_J = 0.0, found_J = 0.0;
  bool aside = false;
  for (double t_s = 0.0; t_s < seconds; t_s += kTick_s) {
    touch.device.set_hand_target(poking.next());
    touch.tick();
    since_start_J += touch.work_J();
    in_touch_J += touch.work_J() - (touch.loop.ports().found_J() - found_J);
    found_J = touch.loop.ports().found_J();
    given.most_J = std::max(given.most_J, since_start_J);
    const double force_N = touch.force_N().norm();
    given.largest_N = std::max(given.largest_N, force_N);
    if (force_N > 0.0) given.touched_s += kTick_s;
    const messages::ToolState& tool = touch.loop.tool_state();
    // Springs into which the hand moved while the gate was shut come back with what they hold as it opens: put aside.
    aside = aside || touch.loop.gate_state() != haptics::GateState::On;
    if (!aside) given.most_in_touch_J = std::max(given.most_in_touch_J, in_touch_J);
    const bool touches = tool.contact.surface >= 0 || tool.grabbed_line >= 0 || tool.grabbed_body >= 0;
    if (!touches && force_N == 0.0) {
      in_touch_J = 0.0;
      aside = false;
    }
  }
  given.end_J = since_start_J;
  return given;
}

}  // namespace

GoalFigures measure_stable_stiffness(Effort effort) {
  GoalFigures result;
  for (const std::string& name : device::built_in_profiles()) {
    if (effort == Effort::Short && name != "ideal" && name != "stylus") continue;
    device::DeviceProfile profile = device::load_profile(name).profile;
    for (const auto& [hand, held] : {std::pair{kHoldingHand, "in a hand"}, std::pair{kNoHand, "no hand"}}) {
      double worst = 1e9;
      std::string stiffest;
      for (profile.delay_ticks = 0; profile.delay_ticks <= 2; ++profile.delay_ticks) {
        const double calm_N_m = stiffest_calm_N_m(profile, hand);
        worst = std::min(worst, calm_N_m / stiffness_bound_N_m(profile, hand));
        stiffest += fmt::format("{}{:.0f}", stiffest.empty() ? "" : "/", calm_N_m);
      }
      result.figures.push_back(
          {fmt::format("{}, {}: {} N/m over the bound", name, held, stiffest), worst, "", 0.9, true});
    }
  }
  result.note =
      "devices of assets/devices, 1.5 N onto a wall, delay 0/1/2 ticks in place of their own, calm within max(4 "
      "counts, "
      "20 um); worst of the three beside the goal";
  return result;
}

GoalFigures measure_energy_given(Effort effort) {
  const double seconds = effort == Effort::Full ? 3600.0 : 60.0;
  const EnergyGiven given = poke(seconds);
  GoalFigures result;
  result.figures = {{"net energy given to the hand, most at any time", 1e3 * given.most_J, "mJ", 1.0},
                    {"the same since the hand last touched nothing", 1e3 * given.most_in_touch_J, "mJ", 1.0},
                    {"net energy given to the hand at the end", given.end_J, "J", 0.0},
                    {"largest force that was felt", given.largest_N, "N", 1.0, true},
                    {"share of the time in touch", given.touched_s / seconds, "", 0.2, true}};
  result.note = fmt::format(
      "{} s of simulated poking: contact with friction and texture on waves, line and bone in hand; the second figure "
      "leaves out touches while the gate opens after a cut-off",
      seconds);
  return result;
}

}  // namespace myotact::measure
