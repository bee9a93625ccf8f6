#pragma once

#include "scene/scene_file.h"
#include "support/synthetic_specimen.h"

namespace myotact::testing {

/// Two coarse mirror-image bars across a hinge, co-contracting; what tests of sweeps compare does not depend on the
/// mesh.
inline scene::Scene hinge_scene(int workers = 1) {
  scene::Scene scene;
  scene.name = "hinge";
  scene.title = "two bars across a hinge";
  scene.specimen = antagonist_hinge();
  BarShape flexor, extensor;
  flexor.cells = extensor.cells = {4, 1, 1};
  extensor.origin_m.z() = -flexor.origin_m.z();
  scene.specimen.muscles = {bar_muscle("flexor", flexor), bar_muscle("extensor", extensor)};
  scene.settings.workers = workers;
  scene.joints.resize(scene.specimen.joints.size());
  scene.activations.assign(scene.specimen.muscles.size(), 0.0);
  scene::CoContraction set;
  set.joint = 0;
  set.flexors = {0};
  set.extensors = {1};
  scene.co_contraction = set;
  return scene;
}

}  // namespace myotact::testing
