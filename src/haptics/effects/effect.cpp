#include "haptics/effects/effect.h"

#include <algorithm>

namespace myotact::haptics {

double spring_energy_J(double force_N, double stiffness_N_m, double stretch_m) noexcept {
  if (!(stiffness_N_m > 0.0)) return 0.0;
  const double linear_m = force_N / stiffness_N_m;
  return force_N * (std::max(stretch_m, linear_m) - 0.5 * linear_m);
}

}  // namespace myotact::haptics
