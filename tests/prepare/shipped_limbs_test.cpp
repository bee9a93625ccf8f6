#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "prepare/field/signed_distance.h"
#include "prepare/parallel.h"
#include "prepare/part/film.h"
#include "prepare/partition/part_volume.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/surface/surface_pieces.h"
#include "prepare/volume/read_label_volume.h"

// The whole limbs that are shipped against the volumes that they were cut from, part by part.

namespace myotact::prepare {
namespace {

/// A limb's volume, and a skin of it as the specimen has it.
struct PartFigures {
  std::string key;
  bool muscle = false;
  std::size_t points = 0;    // of its label
  double dice = 0.0;         // of its label and the lattice points inside its skin
  double distance_mm = 0.0;  // 95 % of its border points lie nearer to the skin
  std::size_t pieces = 0;
  int handles = 0;
  int bad_edges = 0;
  double volume = 0.0;   // of the skin over that of the label
  double ends_mm = 0.0;  // of the attachments' bones the one that its skin is farthest from
};

class LabelledLimb {
 public:
  explicit LabelledLimb(const std::string& limb)
      : volume_(read_label_volume(data_folder() / "assets" / "canine" / (limb + ".seg.nrrd"))),
        specimen_(anatomy::load_specimen(data_folder() / "meshes" / ("canine_whole_" + limb))),
        recipe_(read_recipe(data_folder() / "assets" / "canine" / (limb + ".json"))) {
    for (const anatomy::Bone& bone : specimen_.bones) bones_.emplace(bone.key, bone.surface);
  }

  std::vector<PartFigures> measure() const {
    std::vector<PartFigures> figures(specimen_.bones.size() + specimen_.muscles.size());
    for_each_index(figures.size(), 2, [&](std::size_t i) {
      const std::size_t m = i - specimen_.bones.size();
      figures[i] = i < specimen_.bones.size() ? figures_of(specimen_.bones[i].key, false, specimen_.bones[i].surface)
                                              : figures_of(specimen_.muscles[m].key, true, specimen_.muscles[m].skin);
    });
    return figures;
  }

 private:
  PartFigures figures_of(const std::string& key, bool muscle, const geometry::TriangleMesh& skin) const {
    PartFigures figures{key, muscle};
    const auto segment =
        std::find_if(volume_.segments.begin(), volume_.segments.end(), [&](const Segment& s) { return s.name == key; });
    if (segment == volume_.segments.end()) return figures;
    const SignedDistance distance(skin);
    std::size_t inside = 0, both = 0;
    std::vector<double> off_m;
    for_each_near(distance.box(), [&](std::size_t point) {
      const bool labelled = volume_.layers[0][point] == segment->label;
      const double away_m = distance(place_m(volume_.lattice, point));
      inside += away_m < 0.0 ? 1 : 0;
      both += away_m < 0.0 && labelled ? 1 : 0;
      figures.points += labelled ? 1 : 0;
      if (labelled && on_border(point)) off_m.push_back(std::abs(away_m));
    });
    std::sort(off_m.begin(), off_m.end());
    figures.dice = 2.0 * static_cast<double>(both) / static_cast<double>(inside + figures.points);
    if (!off_m.empty()) figures.distance_mm = 1e3 * off_m[off_m.size() * 95 / 100];
    figures.pieces = pieces_of(skin).size();
    figures.handles = genus(skin);
    figures.bad_edges = geometry::bad_edge_count(skin);
    figures.volume = geometry::enclosed_volume_m3(skin) /
                     (static_cast<double>(figures.points) * std::pow(step_m(volume_.lattice), 3));
    if (muscle) figures.ends_mm = 1e3 * farthest_end_m(key, skin);
    return figures;
  }

  /// The trunk's bones are in no limb: what is fixed there has no end to look at.
  double farthest_end_m(const std::string& key, const geometry::TriangleMesh& skin) const {
    const auto muscle = std::find_if(recipe_.muscles.begin(), recipe_.muscles.end(),
                                     [&](const MuscleData& data) { return data.mechanics.key == key; });
    double farthest_m = 0.0;
    for (const auto* sites : {&muscle->origins, &muscle->insertions}) {
      for (const AttachmentSite& site : *sites) {
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const std::string& bone : site.bones) {
          const auto surface = bones_.find(bone);
          if (surface == bones_.end()) continue;
          for (const Vec3& p : skin.positions_m) nearest_m = std::min(nearest_m, surface->second(p));
        }
        if (std::isfinite(nearest_m)) farthest_m = std::max(farthest_m, nearest_m);
      }
    }
    return farthest_m;
  }

  template <class Visit>
  void for_each_near(const Eigen::AlignedBox3d& box, Visit&& visit) const {
    constexpr int kAround = 3;
    std::array<int, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto index = [&](const Vec3& p) {
        const auto i = static_cast<Eigen::Index>(k);
        return static_cast<int>((p[i] - volume_.lattice.origin_m[i]) / step_m(volume_.lattice));
      };
      low[k] = std::max(1, index(box.min()) - kAround);
      high[k] = std::min(volume_.lattice.counts[k] - 2, index(box.max()) + kAround);
    }
    for (int z = low[2]; z <= high[2]; ++z) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int x = low[0]; x <= high[0]; ++x) visit(point_at(volume_.lattice.counts, x, y, z));
      }
    }
  }

  bool on_border(std::size_t point) const {
    const auto row = static_cast<std::size_t>(volume_.lattice.counts[0]);
    const std::size_t layer = row * static_cast<std::size_t>(volume_.lattice.counts[1]);
    const Labels& labels = volume_.layers[0];
    const std::array<std::size_t, 3> steps = {1, row, layer};
    return std::any_of(steps.begin(), steps.end(), [&](std::size_t step) {
      return labels[point + step] != labels[point] || labels[point - step] != labels[point];
    });
  }

  LabelVolume volume_;
  anatomy::Specimen specimen_;
  AnatomyData recipe_;
  std::map<std::string, SignedDistance> bones_;
};

class ShippedLimb : public ::testing::TestWithParam<const char*> {};

/// Bellies of 30 and more voxels across hold well over this many.
constexpr std::size_t kLarge = 10000;
/// paw bones of 0.2 cm3 are a few voxels wide.
constexpr std::size_t kSmall = 200;

TEST_P(ShippedLimb, IsWhatItsVolumeSays) {
  fmt::print("{:<36} {:>7} {:>6} {:>8} {:>6} {:>7} {:>7} {:>8}\n", "part", "points", "dice", "d95 mm", "pieces",
             "handles", "volume", "ends mm");
  std::size_t muscles = 0;
  for (const PartFigures& part : LabelledLimb(GetParam()).measure()) {
    fmt::print("{:<36} {:>7} {:>6.3f} {:>8.2f} {:>6} {:>7} {:>7.3f} {:>8.2f}\n", part.key, part.points, part.dice,
               part.distance_mm, part.pieces, part.handles, part.volume, part.ends_mm);
    EXPECT_EQ(part.bad_edges, 0) << part.key;
    EXPECT_EQ(part.pieces, 1U) << part.key;
    EXPECT_LE(part.distance_mm, part.points >= kLarge ? 1.0 : 1.1) << part.key;
    if (part.points >= kSmall) {
      EXPECT_GE(part.dice, part.points >= kLarge ? 0.95 : 0.9) << part.key;
      EXPECT_NEAR(part.volume, 1.0, part.points >= kLarge ? 0.05 : 0.12) << part.key;
    }
    EXPECT_LE(part.ends_mm, 2.0) << part.key;
    // The model's muscles have none: zero is wanted. Biceps femoris has five, round the trochanter and neighbours.
    if (part.muscle) {
      EXPECT_LE(part.handles, 5) << part.key;
    }
    muscles += part.muscle ? 1 : 0;
  }
  EXPECT_EQ(muscles, std::string(GetParam()) == "forelimb" ? 33U : 35U);
}

INSTANTIATE_TEST_SUITE_P(Limbs, ShippedLimb, ::testing::Values("forelimb", "hindlimb"));

}  // namespace
}  // namespace myotact::prepare
