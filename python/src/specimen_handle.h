#pragma once

#include <memory>

#include "anatomy/specimen.h"

namespace myotact::python {

/// A specimen of its own or a scene's, shared with every array that looks into it.
struct SpecimenHandle {
  std::shared_ptr<const anatomy::Specimen> specimen;
};

}  // namespace myotact::python
