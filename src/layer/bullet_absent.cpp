#include "core/error.h"
#include "layer/bullet_engine.h"

// In place of bullet_engine.cpp where there is no Bullet to build with.

namespace myotact::layer {

bool has_bullet() {
  return false;
}

std::unique_ptr<Engine> make_bullet_engine(const anatomy::Specimen&, const BulletSettings&) {
  throw Error(ExitStatus::Unavailable,
              "bullet: this program was built without it; install the package libbullet-dev and build again");
}

}  // namespace myotact::layer
