// What each hand that presses costs a step of a scene: hands_bench [SCENE...], else elbow and forelimb.

#include <cstdio>
#include <string>
#include <vector>

#include "remote/capacity.h"
#include "remote/served_scene.h"

namespace {
constexpr double kForever_s = 1e9;  // all numbers of hands, however slow
}

int main(int argc, char** argv) {
  using namespace myotact;
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"elbow", "forelimb"};
  for (const std::string& name : names) {
    const scene::Scene scene = scene::load_scene(name);
    const std::vector<remote::LoadedStep> load = remote::measure_load(scene, kForever_s, remote::kMostHands);
    std::printf("%s, a step lasts %.1f ms\n  hands pressing   median step [ms]\n", name.c_str(),
                1e3 * scene.settings.dt_s);
    for (const remote::LoadedStep& step : load) std::printf("  %14zu   %10.2f\n", step.hands, 1e3 * step.step_s);
  }
}
