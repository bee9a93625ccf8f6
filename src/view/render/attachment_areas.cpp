#include "view/render/attachment_areas.h"

#include <algorithm>

namespace myotact::view {

namespace {

std::size_t nearest_node(const std::vector<Vec3>& nodes_m, const Vec3& p) {
  const auto nearer = [&](const Vec3& a, const Vec3& b) { return (a - p).squaredNorm() < (b - p).squaredNorm(); };
  return static_cast<std::size_t>(std::min_element(nodes_m.begin(), nodes_m.end(), nearer) - nodes_m.begin());
}

}  // namespace

std::vector<AttachmentEnd> attachment_areas(const anatomy::Muscle& muscle, const anatomy::MuscleLine* line) {
  std::vector<AttachmentEnd> areas(muscle.skin.positions_m.size(), AttachmentEnd::None);
  if (muscle.tets.nodes_m.empty() || muscle.attachments.size() < muscle.tets.nodes_m.size()) return areas;
  const int first_body = line != nullptr && !line->points.empty() ? line->points.front().body : -1;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const int body = muscle.attachments[nearest_node(muscle.tets.nodes_m, muscle.skin.positions_m[i])];
    if (body >= 0) areas[i] = body == first_body ? AttachmentEnd::Origin : AttachmentEnd::Insertion;
  }
  return areas;
}

const anatomy::MuscleLine* line_of(const anatomy::Specimen& specimen, int muscle) {
  const auto found = std::find_if(specimen.lines.begin(), specimen.lines.end(),
                                  [muscle](const anatomy::MuscleLine& line) { return line.muscle == muscle; });
  return found == specimen.lines.end() ? nullptr : &*found;
}

}  // namespace myotact::view
