#pragma once

#include <span>
#include <vector>

#include "anatomy/specimen.h"
#include "core/pose.h"
#include "messages/tool_state.h"
#include "simulation/touch/local_patch.h"

namespace myotact::layer {

/// Names the triangle of a contact that is known by its place alone (ToolState::touched_world_m): the nearest one of
/// its surface in `around`, a model about that place. Without one the contact is dropped.
void name_touched_triangle(const messages::LocalModel& around, messages::ToolState& tool);

/// Surfaces of a specimen for an engine that knows no more of them than where bodies and skins are after a step: the
/// positions at the last two steps, and the trees over them. Numbered as in LocalModel: muscles first, then bones.
class EngineSurfaces {
 public:
  /// Everything stands at the specimen's pose. `specimen` must outlive this.
  explicit EngineSurfaces(const anatomy::Specimen& specimen);

  int count() const { return static_cast<int>(frames_.size()); }
  int muscle_count() const { return static_cast<int>(specimen_.muscles.size()); }
  /// Body whose bone the surface is; -1: a muscle's skin.
  int body_of(int surface) const;
  const geometry::TriangleMesh& mesh(int surface) const;
  const simulation::LocalPatch& patch() const { return patch_; }

  /// The current positions become the previous ones; those of a bone's surface are its rest positions moved by `X_WL`.
  void follow(int surface, const Pose& X_WL);
  /// The same with positions in the world, one a vertex.
  void follow(int surface, std::span<const Vec3> positions_m);

 private:
  struct Frame {
    std::vector<Vec3> previous_m, current_m;
  };
  Frame& next_frame(int surface);

  const anatomy::Specimen& specimen_;
  std::vector<Frame> frames_;
  simulation::LocalPatch patch_;
};

}  // namespace myotact::layer
