#pragma once

#include "support/synthetic_specimen.h"

namespace myotact::testing {

/// For readers that need one: made once, outside of what is measured by calling it in LLVMFuzzerInitialize.
inline const anatomy::Specimen& small_limb() {
  static const anatomy::Specimen kLimb = antagonist_hinge();
  return kLimb;
}

}  // namespace myotact::testing
