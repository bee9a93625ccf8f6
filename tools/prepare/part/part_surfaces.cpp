#include "prepare/part/part_surfaces.h"

#include <algorithm>
#include <memory>

#include "core/error.h"
#include "prepare/parallel.h"
#include "prepare/part/borders.h"
#include "prepare/part/cut_muscle.h"
#include "prepare/part/overlap_measure.h"

namespace myotact::prepare {

namespace {

BodiesToPart measure_bodies(const std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                            int threads) {
  BodiesToPart bodies{{}, {}, muscles, bones};
  bodies.muscles.resize(muscles.size());
  bodies.bones.resize(bones.size());
  for_each_index(muscles.size() + bones.size(), threads, [&](std::size_t i) {
    if (i < muscles.size())
      bodies.muscles[i] = std::make_unique<Body>(muscles[i].surface);
    else
      bodies.bones[i - muscles.size()] = std::make_unique<SignedDistance>(bones[i - muscles.size()].surface);
  });
  return bodies;
}

using Films = std::vector<std::unique_ptr<SignedDistance>>;

/// Enters new films, one a muscle or none, into the borders of those muscles and of the ones they lie in. Returns whose
/// borders changed.
std::vector<bool> enter_films(const BodiesToPart& bodies, const Films& films, std::vector<Borders>& borders) {
  std::vector<bool> changed(borders.size(), false);
  for (std::size_t i = 0; i < borders.size(); ++i) {
    for (std::size_t j = 0; j < films.size(); ++j) {
      if (!films[j]) continue;
      if (i != j && measure_overlap(bodies.muscles[i]->distance, *films[j]).volume_m3 == 0.0) continue;
      changed[i] = true;
      if (i == j)
        borders[i].own_film = films[i].get();
      else
        (i < j ? borders[i].later_films : borders[i].earlier_films).push_back(films[j].get());
    }
  }
  return changed;
}

/// Cuts a muscle that films came in the way of. One that other muscles' films would cut in two reaches through them,
/// and one that falls apart even so keeps its core, which overlaps more. `patch_surface` becomes its patches'.
Cut cut_around_films(const Body& own, Borders& borders, double clearance_m, geometry::TriangleMesh& patch_surface) {
  Cut cut = cut_muscle(own, borders, clearance_m);
  patch_surface = patch(own, borders, clearance_m, cut);
  if (!falls_apart(own, cut)) return cut;
  borders.earlier_films.clear();
  borders.later_films.clear();
  cut = cut_muscle(own, borders, clearance_m);
  patch_surface = patch(own, borders, clearance_m, cut);
  if (!falls_apart(own, cut)) return cut;
  keep_core(own, borders, clearance_m, cut);
  patch_surface = patch(own, borders, clearance_m, cut);
  return cut;
}

std::unique_ptr<SignedDistance> as_distance(const geometry::TriangleMesh& film) {
  return film.triangles.empty() ? nullptr : std::make_unique<SignedDistance>(film);
}

/// Cuts those muscles once more that others' patches lie in, unless that would pierce them or take them apart.
void give_way_to_patches(const BodiesToPart& bodies, const std::vector<Borders>& borders, const Films& patches,
                         const PartSettings& settings, std::vector<Cut>& cuts) {
  for_each_index(cuts.size(), settings.threads, [&](std::size_t i) {
    const Body& own = *bodies.muscles[i];
    Borders around = borders[i];
    for (std::size_t j = 0; j < patches.size(); ++j) {
      if (i == j || !patches[j] || measure_overlap(own.distance, *patches[j]).volume_m3 == 0.0) continue;
      around.earlier_films.push_back(patches[j].get());
    }
    if (around.earlier_films.size() == borders[i].earlier_films.size()) return;
    Cut cut = cut_muscle(own, around, settings.clearance_m);
    if (!cut.needs_film() && !falls_apart(own, cut)) cuts[i] = std::move(cut);
  });
}

/// Cuts all muscles along their borders, then those again that films came in the way of.
std::vector<Cut> cut_muscles(const BodiesToPart& bodies, std::vector<Borders>& borders, const PartSettings& settings,
                             const std::function<void()>& done) {
  std::vector<Cut> cuts(borders.size());
  Films films(borders.size()), patches(borders.size());
  for_each_index(borders.size(), settings.threads, [&](std::size_t i) {
    if (done) done();
    if (borders[i].none()) return;
    const Body& own = *bodies.muscles[i];
    cuts[i] = cut_muscle(own, borders[i], settings.clearance_m);
    films[i] = as_distance(film_surface(own, borders[i], settings.clearance_m, cuts[i]));
  });
  const std::vector<bool> changed = enter_films(bodies, films, borders);
  for_each_index(borders.size(), settings.threads, [&](std::size_t i) {
    const Body& own = *bodies.muscles[i];
    if (!changed[i] && !falls_apart(own, cuts[i])) return;
    geometry::TriangleMesh surface;
    cuts[i] = cut_around_films(own, borders[i], settings.clearance_m, surface);
    patches[i] = as_distance(surface);
  });
  give_way_to_patches(bodies, borders, patches, settings, cuts);
  return cuts;
}

}  // namespace

std::vector<PartReport> part_surfaces(std::vector<NamedSurface>& muscles, const std::vector<NamedSurface>& bones,
                                      const PartSettings& settings, const std::function<void()>& done) {
  const BodiesToPart bodies = measure_bodies(muscles, bones, settings.threads);
  std::vector<PartReport> reports(muscles.size());
  std::vector<Borders> borders = set_borders(bodies, settings, reports);
  std::vector<Cut> cuts = cut_muscles(bodies, borders, settings, done);
  for (std::size_t i = 0; i < muscles.size(); ++i) {
    PartReport& report = reports[i];
    report.volume_before_m3 = bodies.muscles[i]->distance.volume_m3();
    if (borders[i].none()) continue;
    if (cuts[i].left.triangles.empty()) {
      throw bad_data(muscles[i].key, "part", "lies wholly inside its neighbours; leave one of them out");
    }
    report.volume_lost_m3 = report.volume_before_m3 - geometry::enclosed_volume_m3(cuts[i].left);
    report.dropped_m3 = cuts[i].dropped_m3;
    report.kept_core = borders[i].core > 0.0;
    report.filmed = borders[i].own_film != nullptr;
    report.added_genus = cuts[i].added_genus;
    muscles[i].surface = std::move(cuts[i].left);
  }
  return reports;
}

}  // namespace myotact::prepare
