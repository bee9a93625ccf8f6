#include <fmt/format.h>

#include "prepare/repair/stages.h"

namespace myotact::prepare {

geometry::TriangleMesh resample(const RepairJob& job, const geometry::TriangleMesh& piece, std::size_t crossings,
                                const Vec3& place) {
  throw refusal(job,
                fmt::format("crosses itself: {} of {} triangles cross others near {{}} and could not be taken apart "
                            "there; must be 0. Repair the surface there and export it again",
                            crossings, piece.triangles.size()),
                place);
}

}  // namespace myotact::prepare
