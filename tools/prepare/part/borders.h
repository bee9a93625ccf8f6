#pragma once

#include <memory>
#include <vector>

#include "prepare/field/local_radius.h"
#include "prepare/field/signed_distance.h"
#include "prepare/part/part_surfaces.h"

namespace myotact::prepare {

struct Body {
  SignedDistance distance;
  LocalRadius radius;

  explicit Body(const geometry::TriangleMesh& surface) : distance(surface), radius(distance) {}
};

/// The surfaces to be parted, as distances.
struct BodiesToPart {
  std::vector<std::unique_ptr<Body>> muscles;
  std::vector<std::unique_ptr<SignedDistance>> bones;
  const std::vector<NamedSurface>& muscle_names;
  const std::vector<NamedSurface>& bone_names;
};

/// Who takes room from one muscle, and what it keeps.
struct Borders {
  std::vector<const SignedDistance*> taken;  // keep their shape and take all that they cover: bones, nested muscles
  std::vector<const Body*> shared;           // muscles; the border to them lies half-way
  /// Films (film.h) stay where muscles would be pierced. Those of others take room; where two meet, that of the muscle
  /// that comes first stays.
  const SignedDistance* own_film = nullptr;
  std::vector<const SignedDistance*> earlier_films, later_films;
  /// What lies deeper than this part of the local radius stays, whoever takes it. 0: nothing does.
  double core = 0.0;

  bool none() const { return taken.empty() && shared.empty() && earlier_films.empty() && later_films.empty(); }
};

/// The borders of each muscle without films; enters who gave way to whom into the reports, one a muscle.
std::vector<Borders> set_borders(const BodiesToPart& bodies, const PartSettings& settings,
                                 std::vector<PartReport>& reports);

/// Negative in what is left of a muscle [m], with half a gap between neighbours. A shared border lies equally deep in
/// both, each depth measured against the local radius: a thin tendon keeps its core where it crosses a thick belly.
double left_of_m(const Body& own, const Borders& borders, double half_gap_m, const Vec3& p);
/// How deep a place is in what takes room from the muscle's film, too [m], with half a gap.
double taken_m(const Borders& borders, double half_gap_m, const Vec3& p);

}  // namespace myotact::prepare
