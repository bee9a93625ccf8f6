#include "device/drivers/force_dimension/models.h"

#include <algorithm>
#include <cmath>

namespace myotact::device::force_dimension {

Model model_of(int system_type) {
  switch (system_type) {
    case 63:
      return {"delta.3", 20.0, 5000.0, 0.15};
    case 33:
      return {"omega.3", 12.0, 5000.0, 0.075};
    case 34:
    case 36:
      return {"omega.6", 12.0, 5000.0, 0.075};
    case 35:
    case 37:
      return {"omega.7", 12.0, 5000.0, 0.075};
    case 206:
      return {"sigma.3", 12.0, 4000.0, 0.075};
    case 104:
    case 105:
      return {"sigma.7", 12.0, 4000.0, 0.075};
    case 203:
      return {"lambda.3", 12.0, 8000.0, 0.1125};
    case 108:
    case 109:
      return {"lambda.7", 12.0, 8000.0, 0.1125};
    case 60:
      return {"Falcon", 8.0, 3000.0, 0.04};
    default:
      return {"device of another type", 8.0, 3000.0, 0.04};
  }
}

/// Inertia, friction and resolution as assets/devices/omega.json, whose sources hold here, too.
DeviceProfile profile_of(const Model& model, double told_max_force_N) {
  DeviceProfile profile;
  profile.peak_force_N = model.peak_force_N;
  if (std::isfinite(told_max_force_N) && told_max_force_N > 0.0) {
    profile.peak_force_N = std::min(profile.peak_force_N, told_max_force_N);
  }
  profile.continuous_force_N = 0.5 * profile.peak_force_N;
  profile.max_stiffness_N_m = model.max_stiffness_N_m;
  profile.inertia_kg = 0.25;
  profile.viscous_Ns_m = 0.3;
  profile.resolution_m = 1e-5;
  profile.delay_ticks = 1;  // the force goes out with the next exchange
  profile.workspace_m.fill(2.0 * model.reach_radius_m);
  return profile;
}

}  // namespace myotact::device::force_dimension
