#pragma once

#include "device/device.h"

namespace myotact::device::force_dimension {

struct Model {
  const char* title;
  double peak_force_N;
  double max_stiffness_N_m;
  double reach_radius_m;  // of the ball that its grip reaches
};

/// By the number that dhdGetSystemType reports; one that is not known: the weakest limits of all. (Source: types of
/// the SDK's header, limits as CHAI3D lists them)
Model model_of(int system_type);

/// What such a device supports; never more than the library's own limits, where it has one of the force.
DeviceProfile profile_of(const Model& model, double told_max_force_N);

}  // namespace myotact::device::force_dimension
