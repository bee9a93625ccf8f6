#include <algorithm>

#include "anatomy/specimen.h"
#include "anatomy/touch_surfaces.h"

namespace myotact::anatomy {

namespace {

template <class Part>
int index_of(const std::vector<Part>& parts, const std::string& key) {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.key == key; });
  return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
}

}  // namespace

int find_muscle(const Specimen& specimen, const std::string& key) {
  return index_of(specimen.muscles, key);
}
int find_joint(const Specimen& specimen, const std::string& key) {
  return index_of(specimen.joints, key);
}
int find_body(const Specimen& specimen, const std::string& key) {
  return index_of(specimen.bodies, key);
}

std::vector<const geometry::TriangleMesh*> touch_surfaces(const Specimen& specimen) {
  std::vector<const geometry::TriangleMesh*> surfaces;
  for (const Muscle& muscle : specimen.muscles) surfaces.push_back(&muscle.skin);
  for (const Bone& bone : specimen.bones) surfaces.push_back(&bone.surface);
  return surfaces;
}

const LineWrap* wrap_after(const MuscleLine& line, std::size_t after) {
  for (const LineWrap& wrap : line.wraps) {
    if (wrap.after == static_cast<int>(after)) return &wrap;
  }
  return nullptr;
}

}  // namespace myotact::anatomy
