#pragma once

#include <memory>
#include <vector>

#include "simulation/limb/limb.h"
#include "simulation/touch/local_patch.h"

namespace myotact::simulation {

/// Positions of all skins and bone surfaces at the last two frames, and the trees over them.
/// Numbering of the scene: muscles first, then bones.
class Surfaces {
 public:
  /// Embeds the skins in the limb's meshes; everything stands at the specimen's pose. `specimen` must outlive this.
  Surfaces(const anatomy::Specimen& specimen, const Limb& limb);

  const std::vector<SkinEmbedding>& skins() const { return skins_; }  // one a muscle
  /// Vertices now, in the world; valid until the surface is followed again.
  std::span<const Vec3> current_m(int surface) const { return frames_[static_cast<std::size_t>(surface)].current_m; }
  /// The trees over both frames.
  const LocalPatch& patch() const { return *patch_; }

  int count() const { return static_cast<int>(frames_.size()); }  // muscles and bones
  /// The current frame of one surface becomes its previous one, and the present state of the limb the current one. With
  /// `restart` both frames become the present state: after a jump there is no motion to play. Different surfaces may be
  /// followed by different threads at once. The limb is only read.
  void follow(const Limb& limb, int surface, bool restart);

 private:
  /// Vertices of one surface, in the world.
  struct Frame {
    std::vector<Vec3> previous_m, current_m;
    Eigen::VectorXd nodes_m;  // of a muscle: its mesh where the current frame was made
    Pose pose;                // of a bone, likewise
    double radius_m = 0.0;    // of a bone: farthest vertex from its body's origin
    bool at_rest = false;     // both frames are the same
  };
  /// Too little has happened since the current frame to be seen or felt.
  bool is_still(const Limb& limb, int surface) const;
  void update(const Limb& limb, int surface);
  std::vector<messages::TriangleTissue> tissue_of(int surface) const;

  const anatomy::Specimen& specimen_;
  std::vector<SkinEmbedding> skins_;
  std::vector<Frame> frames_;
  std::unique_ptr<LocalPatch> patch_;
};

}  // namespace myotact::simulation
