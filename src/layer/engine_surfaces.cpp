#include "layer/engine_surfaces.h"

#include <algorithm>
#include <limits>

#include "anatomy/touch_surfaces.h"
#include "core/at.h"
#include "geometry/closest_point.h"

namespace myotact::layer {

void name_touched_triangle(const messages::LocalModel& around, messages::ToolState& tool) {
  const Vec3 touched_m = to_vec3(tool.touched_world_m);
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < at(around.triangle_count); ++t) {
    const messages::LocalModel::Triangle& triangle = around.triangles[t];
    if (triangle.surface != tool.contact.surface) continue;
    const auto corner = [&](std::size_t k) { return to_vec3(around.current_world_m[at(triangle.vertices[k])]); };
    const geometry::TrianglePoint foot =
        geometry::closest_point_on_triangle(touched_m, corner(0), corner(1), corner(2));
    const double away_m = (touched_m - foot.position_m).norm();
    if (!(away_m < nearest_m)) continue;
    nearest_m = away_m;
    tool.contact.triangle = triangle.triangle;
    tool.contact.barycentric = foot.barycentric;
  }
  if (tool.contact.triangle < 0) tool.contact = {};
}

EngineSurfaces::EngineSurfaces(const anatomy::Specimen& specimen)
    : specimen_(specimen), patch_(anatomy::touch_surfaces(specimen)) {
  for (const geometry::TriangleMesh* surface : anatomy::touch_surfaces(specimen)) {
    frames_.push_back({surface->positions_m, surface->positions_m});
  }
  for (int s = 0; s < count(); ++s) {
    if (body_of(s) >= 0) {
      patch_.set_tissue(s,
                        std::vector<messages::TriangleTissue>(mesh(s).triangles.size(), {messages::Tissue::Bone, {}}));
    }
    patch_.update_surface(s, frames_[at(s)].previous_m, frames_[at(s)].current_m);
  }
}

int EngineSurfaces::body_of(int surface) const {
  return surface < muscle_count() ? -1 : specimen_.bones[at(surface - muscle_count())].body;
}

const geometry::TriangleMesh& EngineSurfaces::mesh(int surface) const {
  return surface < muscle_count() ? specimen_.muscles[at(surface)].skin
                                  : specimen_.bones[at(surface - muscle_count())].surface;
}

EngineSurfaces::Frame& EngineSurfaces::next_frame(int surface) {
  Frame& frame = frames_[at(surface)];
  frame.previous_m.swap(frame.current_m);
  return frame;
}

void EngineSurfaces::follow(int surface, const Pose& X_WL) {
  Frame& frame = next_frame(surface);
  std::transform(mesh(surface).positions_m.begin(), mesh(surface).positions_m.end(), frame.current_m.begin(),
                 [&](const Vec3& rest_m) { return X_WL * rest_m; });
  patch_.update_surface(surface, frame.previous_m, frame.current_m);
}

void EngineSurfaces::follow(int surface, std::span<const Vec3> positions_m) {
  Frame& frame = next_frame(surface);
  std::copy(positions_m.begin(), positions_m.end(), frame.current_m.begin());
  patch_.update_surface(surface, frame.previous_m, frame.current_m);
}

}  // namespace myotact::layer
