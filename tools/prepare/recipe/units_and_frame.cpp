#include "prepare/recipe/units_and_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

struct Unit {
  const char* name;
  double metres;
};
constexpr std::array<Unit, 4> kUnits = {{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}}};

/// A scan's muscles are the recipe's when their diagonals are, in the median, between these multiples of the spread of
/// their attachments: sheets are wider than that, and the model may end short.
constexpr double kSmallest = 0.4, kLargest = 4.0;
/// Attachments that lie nearer to each other say little of a muscle's size [m].
constexpr double kLeastSpread_m = 5e-3;
/// Smallest and largest diagonal of a dog's limb [m], and the smallest of a muscle alone, whose unit somebody named.
constexpr double kSmallestLimb_m = 0.05, kLargestLimb_m = 3.0, kSmallestPart_m = 5e-3;
/// Attachments of a muscle lie on it, but for what the model lacks [m].
constexpr double kNearMuscle_m = 0.03;

Eigen::AlignedBox3d box_of(const Scan& scan) {
  Eigen::AlignedBox3d box;
  for (const auto* parts : {&scan.bones, &scan.muscles}) {
    for (const NamedSurface& part : *parts) {
      for (const Vec3& p : part.surface.positions_m) {
        if (p.allFinite()) box.extend(p);
      }
    }
  }
  return box;
}

/// Of the attachments and joints of the parts that the scan has.
Eigen::AlignedBox3d box_of(const AnatomyData& recipe, const Scan& scan) {
  Eigen::AlignedBox3d box;
  for (const NamedSurface& part : scan.muscles) {
    for (const MuscleData& muscle : recipe.muscles) {
      if (muscle.mechanics.key != part.key) continue;
      for (const auto* sites : {&muscle.origins, &muscle.insertions}) {
        for (const AttachmentSite& site : *sites) box.extend(site.point_m);
      }
    }
  }
  return box;
}

/// Median distance from the attachments to the nearest vertex of their muscles [m], with y as it is or mirrored.
double attachment_distance_m(const Scan& scan, const AnatomyData& recipe, double y_sign) {
  std::vector<double> distances_m;
  for (const NamedSurface& part : scan.muscles) {
    for (const MuscleData& muscle : recipe.muscles) {
      if (muscle.mechanics.key != part.key) continue;
      for (const auto* sites : {&muscle.origins, &muscle.insertions}) {
        for (const AttachmentSite& site : *sites) {
          const Vec3 point_m = site.point_m.cwiseProduct(Vec3(1.0, y_sign, 1.0));
          double nearest_m2 = std::numeric_limits<double>::infinity();
          for (const Vec3& p : part.surface.positions_m) {
            nearest_m2 = std::min(nearest_m2, (p - point_m).squaredNorm());
          }
          distances_m.push_back(std::sqrt(nearest_m2));
        }
      }
    }
  }
  if (distances_m.empty()) return 0.0;  // bones alone
  std::sort(distances_m.begin(), distances_m.end());
  return distances_m[distances_m.size() / 2];
}

/// Median over the muscles of a muscle's diagonal, in the scan's unit, over the spread of its attachments [1/m].
std::optional<double> size_ratio(const Scan& scan, const AnatomyData& recipe) {
  std::vector<double> ratios;
  for (const NamedSurface& part : scan.muscles) {
    const Scan alone{{}, {part}, {}};
    const double spread_m = box_of(recipe, alone).diagonal().norm();
    if (spread_m >= kLeastSpread_m) ratios.push_back(box_of(alone).diagonal().norm() / spread_m);
  }
  if (ratios.empty()) return {};
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

Unit unit_of(const Scan& scan, const AnatomyData& recipe, const std::string& units) {
  for (const Unit& unit : kUnits) {
    if (units == unit.name) return unit;
  }
  const auto ratio = size_ratio(scan, recipe);
  if (!ratio) {
    throw bad_data("units", "", "the recipe's attachments say nothing of the size; name the unit with --units");
  }
  const auto misfit = [&](const Unit& unit) { return std::abs(std::log(*ratio * unit.metres)); };
  const Unit best = *std::min_element(kUnits.begin(), kUnits.end(),
                                      [&](const Unit& a, const Unit& b) { return misfit(a) < misfit(b); });
  if (*ratio * best.metres >= kSmallest && *ratio * best.metres <= kLargest) return best;
  throw bad_data("units", "",
                 fmt::format("the muscles are {:.3g} times as large as the recipe's if the unit is {}, the nearest of "
                             "m, cm, mm, in; must be {} .. {} times. Name it with --units, or another recipe",
                             *ratio * best.metres, best.name, kSmallest, kLargest));
}

void scale(Scan& scan, double factor) {
  if (factor == 1.0) return;
  for (auto* parts : {&scan.bones, &scan.muscles}) {
    for (NamedSurface& part : *parts) {
      for (Vec3& p : part.surface.positions_m) p *= factor;
    }
  }
}

}  // namespace

void set_units_and_frame(Scan& scan, const AnatomyData& recipe, const std::string& named_units) {
  const std::string& units = named_units.empty() ? recipe.units : named_units;
  const Unit unit = unit_of(scan, recipe, units);
  scale(scan, unit.metres);
  const Eigen::AlignedBox3d box = box_of(scan);
  const double diagonal_m = box.diagonal().norm();
  if (units.empty()) {
    scan.notes.push_back(fmt::format("units: taken as {}: the limb is then {:.3f} m across", unit.name, diagonal_m));
  }
  const double smallest_m = units.empty() ? kSmallestLimb_m : kSmallestPart_m;
  if (diagonal_m < smallest_m || diagonal_m > kLargestLimb_m) {
    throw bad_data("units", "",
                   fmt::format("in {} the limb is {} m across; must be {} .. {} m. Name the unit with --units",
                               unit.name, to_text(diagonal_m), to_text(smallest_m), to_text(kLargestLimb_m)));
  }
  const double away_m = attachment_distance_m(scan, recipe, 1.0);
  if (away_m <= kNearMuscle_m) return;
  if (attachment_distance_m(scan, recipe, -1.0) <= kNearMuscle_m) {
    throw bad_data("frame", "",
                   fmt::format("the scan is the mirror image of the recipe's {} limb (y is left): mirror its files, or "
                               "name a recipe of the other side",
                               recipe.side));
  }
  const Vec3 there = box.center(), wanted = box_of(recipe, scan).center();
  throw bad_data(
      "frame", "",
      fmt::format("the recipe's attachments lie {:.3f} m from their muscles (half of them farther): the scan "
                  "is about ({:.3f}, {:.3f}, {:.3f}) m, the recipe about ({:.3f}, {:.3f}, {:.3f}) m. Export "
                  "the scan in the recipe's frame and pose, or take it as it is with --guess",
                  away_m, there.x(), there.y(), there.z(), wanted.x(), wanted.y(), wanted.z()));
}

}  // namespace myotact::prepare
