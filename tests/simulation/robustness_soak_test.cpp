#include <gtest/gtest.h>

#include "simulation/random_scripts.h"

namespace myotact::simulation {

TEST(Robustness, TwoHundredLongScripts) {
  run_random_scripts(200, 200);
}

}  // namespace myotact::simulation
