#include <gtest/gtest.h>

#include "simulation/random_scripts.h"

namespace myotact::simulation {

TEST(Robustness, TwentyShortScripts) {
  run_random_scripts(20, 50);
}

}  // namespace myotact::simulation
