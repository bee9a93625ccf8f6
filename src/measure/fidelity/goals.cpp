#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/error.h"
#include "measure/fidelity/coupling_goals.h"
#include "measure/fidelity/drag_goals.h"
#include "measure/fidelity/friction_goals.h"
#include "measure/fidelity/goal.h"
#include "measure/fidelity/joint_goals.h"
#include "measure/fidelity/loop_goals.h"
#include "measure/fidelity/network_goals.h"
#include "measure/fidelity/proxy_cost_goals.h"
#include "measure/fidelity/proxy_force_goals.h"
#include "measure/fidelity/proxy_goals.h"
#include "measure/fidelity/replay_goals.h"
#include "measure/fidelity/safety_goals.h"
#include "measure/fidelity/stability_goals.h"
#include "measure/fidelity/texture_goals.h"
#include "measure/fidelity/two_hand_goals.h"

namespace myotact::measure {

namespace {

constexpr std::array kGoals = {
    Goal{1, "no fall-through on deforming meshes", measure_deforming_contact},
    Goal{2, "no fall-through on sheets, in grooves, over edges", measure_hard_shapes},
    Goal{3, "tick cost in contact with friction", measure_tick_cost},
    Goal{4, "following a deformed surface", measure_surface_update},
    Goal{5, "loop period and missed ticks", measure_loop_period},
    Goal{6, "friction coefficient and breakaway", measure_friction_coefficient},
    Goal{7, "creep while sticking to moving tissue", measure_sticking},
    Goal{8, "felt stiffness against the tissue's own", measure_felt_stiffness},
    Goal{9, "joint stiffness felt at the paw", measure_joint_at_paw},
    Goal{10, "stiffest calm wall over the bound of the device", measure_stable_stiffness},
    Goal{11, "stiffest calm coupling, simulation one step late", measure_multirate_stability},
    Goal{12, "force jitter of a press of 1 N", measure_press_jitter},
    Goal{13, "steps of the force across edges, frames, triangles", measure_force_steps},
    Goal{14, "penetration, and depth against force", measure_penetration},
    Goal{15, "energy that the rendering gives to a hand", measure_energy_given},
    Goal{16, "spectrum and strength of texture", measure_texture_spectrum},
    Goal{17, "force of a line in hand against a strand", measure_line_drag},
    Goal{18, "impulse of the hand against that of the tissue", measure_impulse_balance},
    Goal{19, "stability and force over a slow network", measure_network},
    Goal{20, "force within its limit, and gone at once, whatever goes wrong", measure_safety},
    Goal{21, "a recorded session comes out again", measure_replay},
    Goal{22, "two hands on one mesh feel what each feels alone", measure_two_hands},
};

}  // namespace

std::span<const Goal> fidelity_goals() {
  return kGoals;
}

std::vector<Goal> select_goals(std::span<const int> numbers) {
  std::vector<Goal> selected;
  for (const int number : numbers) {
    const bool known =
        std::any_of(kGoals.begin(), kGoals.end(), [number](const Goal& goal) { return goal.number == number; });
    if (known) continue;
    std::string all;
    for (const Goal& goal : kGoals) all += fmt::format("{}{}", all.empty() ? "" : ", ", goal.number);
    throw Error(ExitStatus::Usage, fmt::format("there is no goal {}; known: {}", number, all));
  }
  for (const Goal& goal : kGoals) {
    if (numbers.empty() || std::find(numbers.begin(), numbers.end(), goal.number) != numbers.end())
      selected.push_back(goal);
  }
  return selected;
}

}  // namespace myotact::measure
