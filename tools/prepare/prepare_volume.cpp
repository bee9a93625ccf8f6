#include "prepare/prepare_volume.h"

#include <algorithm>
#include <iostream>
#include <optional>

#include <Eigen/LU>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "anatomy/part_facts.h"
#include "core/at.h"
#include "core/data_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "prepare/finish_limb.h"
#include "prepare/guess/markups.h"
#include "prepare/guess/part_files.h"
#include "prepare/loft/loft.h"
#include "prepare/measure/measure_limb.h"
#include "prepare/parallel.h"
#include "prepare/partition/cut_parts.h"
#include "prepare/partition/lay_tendons.h"
#include "prepare/partition/part_volume_file.h"
#include "prepare/partition/smooth_labels.h"
#include "prepare/prepare_unknown.h"
#include "prepare/progress_bar.h"
#include "prepare/recipe/make_limb.h"
#include "prepare/recipe/read_recipe.h"
#include "prepare/recipe/read_scan.h"
#include "prepare/recipe/recipe_text.h"
#include "prepare/recipe/units_and_frame.h"
#include "prepare/remesh/fine_surface.h"
#include "prepare/stages/close_holes.h"
#include "prepare/stages/stages.h"
#include "prepare/volume/map_segments.h"
#include "prepare/volume/read_label_volume.h"
#include "prepare/volume/specimen_frame.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

/// Finer lattices than this many points show nothing more of a limb, and take minutes and gigabytes: 50 cm x 20 cm x
/// 40 cm at a millimetre.
constexpr double kMostPoints = 4e7;
/// Steps count as equal when they differ by less than this part.
constexpr double kEqual = 1e-6;

/// Shows the part of the work that comes before the stages.
void show(ProgressBar& bar, const char* what, double whole) {
  stop_when_interrupted();
  bar.show({what, 0, 1, whole});
}

anatomy::FactsByKey part_facts() {
  return anatomy::load_part_facts(data_folder() / "assets" / "canine" / "names.json");
}

/// What a recipe makes of the segments, and how much of them it knows.
struct Mapping {
  fs::path recipe;
  AnatomyData anatomy;
  SegmentMap map;
  int bones = 0, muscles = 0;  // known by name, not by the table alone
};

Mapping map_with(const fs::path& recipe, const LabelVolume& volume, const MapRules& rules) {
  Mapping mapping;
  mapping.recipe = recipe;
  mapping.anatomy = read_recipe(recipe);
  MapRules own = rules;
  own.side = mapping.anatomy.side;
  mapping.map = map_segments(volume.segments, known_parts(mapping.anatomy, part_facts()), own);
  for (const SegmentChoice& choice : mapping.map.choices) {
    if (choice.known && choice.kind != PartKind::Ignore)
      ++(choice.kind == PartKind::Bone ? mapping.bones : mapping.muscles);
  }
  return mapping;
}

/// The recipe named, or the built-in one that knows more; nothing when neither knows a bone and a muscle.
std::optional<Mapping> map_by_recipe(const Options& options, const LabelVolume& volume, const MapRules& rules) {
  if (!options.recipe.empty()) return map_with(options.recipe, volume, rules);
  if (options.guess || options.output.empty()) return {};  // a recipe that is only written is a guess
  const fs::path folder = data_folder() / "assets" / "canine";
  std::optional<Mapping> best;
  for (const char* limb : {"forelimb.json", "hindlimb.json"}) {
    std::optional<Mapping> mapping;
    try {
      mapping = map_with(folder / limb, volume, rules);
    } catch (const Error&) {
      continue;  // the table speaks of the other limb's parts
    }
    if (!best || mapping->bones + mapping->muscles > best->bones + best->muscles) best = std::move(mapping);
  }
  if (!best || best->bones == 0 || best->muscles == 0) return {};
  return best;
}

bool has_equal_steps(const Lattice& lattice) {
  const double length_m = step_m(lattice);
  return std::abs(lattice.steps_m.col(1).norm() - length_m) < kEqual * length_m &&
         std::abs(lattice.steps_m.col(2).norm() - length_m) < kEqual * length_m;
}

/// A volume as `measure` writes it: one layer, equal steps, margins beside it.
std::optional<PartVolume> with_margins(const fs::path& file, LabelVolume& volume,
                                       const std::vector<SegmentChoice>& choices) {
  if (volume.layers.size() != 1 || !has_equal_steps(volume.lattice)) return {};
  auto margins = read_margins(file, volume.lattice, volume.layers[0]);
  if (!margins) return {};
  int most = 0;
  for (const SegmentChoice& choice : choices) most = std::max(most, choice.segment.label);
  PartVolume parts{volume.lattice, std::vector<std::string>(at(most)), std::move(volume.layers[0]),
                   std::move(*margins)};
  for (const SegmentChoice& choice : choices) parts.keys[at(choice.segment.label - 1)] = choice.key;
  return parts;
}

void tell_of_smoothing(const std::vector<ChosenSegment>& chosen, const std::vector<SmoothedPart>& parts,
                       const Lattice& lattice, std::vector<std::string>& notes) {
  notes.push_back(fmt::format("borders smoothed on a lattice of {:.2f} mm", 1e3 * step_m(lattice)));
  for (std::size_t s = 0; s < chosen.size(); ++s) {
    if (parts[s].kept_m3 <= 0.0) {
      throw bad_data(chosen[s].key, "voxels",
                     fmt::format("are too few or too thin to make a surface ({:.4f} cm3); thicken it, or leave it out "
                                 "with kind ignore in a table for --segments",
                                 1e6 * parts[s].voxels_m3));
    }
    if (parts[s].pieces > 1) {
      notes.push_back(fmt::format("{}: {} pieces; the largest stays, {:.3f} cm3 of others went to neighbours",
                                  chosen[s].key, parts[s].pieces, 1e6 * parts[s].dropped_m3));
    }
  }
}

std::string describe(const LaidTendon& tendon) {
  return fmt::format("{}: ended {:.1f} mm from {}; a tendon of {:.1f} mm, {:.1f} mm thick, leads there", tendon.muscle,
                     1e3 * tendon.gap_m, tendon.bone, 1e3 * tendon.length_m, 2e3 * tendon.radius_m);
}

PartVolume smoothed(const LabelVolume& volume, const std::vector<SegmentChoice>& choices, int threads,
                    std::vector<std::string>& notes) {
  std::vector<ChosenSegment> chosen;
  for (const SegmentChoice& choice : choices) {
    if (choice.kind != PartKind::Ignore) chosen.push_back({choice.key, choice.segment.label, choice.segment.layer});
  }
  if (chosen.empty()) throw bad_data("segments", "", "are all ignored; give at least one a part in the table");
  std::vector<SmoothedPart> parts;
  PartVolume result = smooth_labels(volume, chosen, kMostPoints, threads, parts);
  tell_of_smoothing(chosen, parts, result.lattice, notes);
  return result;
}

/// The volume's parts as surfaces, those with a skin from the volume's interfaces, too.
struct Surfaces {
  Scan scan;
  std::vector<NamedSurface> skins;
};

Surfaces cut(const PartVolume& volume, const std::vector<SegmentChoice>& choices, int threads) {
  CutParts parts = cut_parts(volume, threads);
  Surfaces surfaces;
  for (const SegmentChoice& choice : choices) {
    if (choice.kind == PartKind::Ignore) continue;
    const auto place = std::find(volume.keys.begin(), volume.keys.end(), choice.key);
    const auto p = static_cast<std::size_t>(place - volume.keys.begin());
    auto& list = choice.kind == PartKind::Bone ? surfaces.scan.bones : surfaces.scan.muscles;
    list.push_back({choice.key, std::move(parts.fine[p])});
    surfaces.skins.push_back({choice.key, std::move(parts.skins[p])});
  }
  return surfaces;
}

/// Skins as they were cut, those of thin muscles without the holes that the lattice tore; what the volume has not
/// (built bands) gets one of its own.
void take_skins(std::vector<NamedSurface>& skins, LimbWork& limb, double step_m) {
  limb.shares_borders = true;
  const auto take = [&](const std::string& key, auto& part) {
    const auto found = std::find_if(skins.begin(), skins.end(), [&](const auto& skin) { return skin.key == key; });
    part.skin = found != skins.end() ? std::move(found->surface) : skin_surface(fine_surface(part.surface));
    part.report.key = key;
    part.report.input_triangles = static_cast<int>(part.surface.triangles.size());
    part.report.skin_triangles = static_cast<int>(part.skin.triangles.size());
    part.report.volume_m3 = geometry::enclosed_volume_m3(part.surface);
  };
  for (BoneWork& bone : limb.bones) take(bone.data.key, bone);
  for (MuscleWork& muscle : limb.muscles) {
    take(muscle.data.mechanics.key, muscle);
    muscle.report.muscle = true;
  }
  for_each_index(limb.muscles.size(), limb.settings.threads, [&](std::size_t m) {
    MuscleWork& muscle = limb.muscles[m];
    muscle.skin = close_holes(muscle.skin, step_m);
    muscle.report.skin_triangles = static_cast<int>(muscle.skin.triangles.size());
  });
}

/// Where a recipe has measured sections beside it, muscle lines go through their middle, as in lofted limbs.
void take_middles(const fs::path& recipe, std::vector<NamedSurface>& muscles) {
  const fs::path sections = recipe.parent_path() / (recipe.stem().string() + "_muscle_sections.json");
  if (!fs::exists(sections)) return;
  for (NamedSurface& lofted : loft_muscles(recipe)) {
    for (NamedSurface& muscle : muscles) {
      if (muscle.key == lofted.key) muscle.middle_m = std::move(lofted.middle_m);
    }
  }
}

LimbWork known_limb(const Mapping& mapping, Surfaces& surfaces, const Options& options) {
  set_units_and_frame(surfaces.scan, mapping.anatomy, "m");
  take_middles(mapping.recipe, surfaces.scan.muscles);
  return make_limb(mapping.anatomy, surfaces.scan.bones, surfaces.scan.muscles, options.settings);
}

/// What a person marked on the volume.
std::vector<Markup> read_marks(const std::vector<fs::path>& files, std::vector<std::string>& notes) {
  std::vector<Markup> marks;
  for (const fs::path& file : files) {
    for (Markup& mark : read_markups(file, notes)) marks.push_back(std::move(mark));
  }
  place(marks, specimen_from_lps());
  return marks;
}

LimbWork guessed_limb(const fs::path& file, Surfaces& surfaces, std::vector<Markup> marks, const Options& options,
                      anatomy::CompanionFiles& companions) {
  const Strangers strangers{fs::absolute(file).lexically_normal().stem().stem().string(), "not stated",
                            surfaces.scan.bones, surfaces.scan.muscles, std::move(marks)};
  const GuessedRecipe guess = guess_recipe(strangers, built_in_parts());
  print_decisions(guess.decisions, options.json);
  companions.push_back({"recipe.json", recipe_text(guess.anatomy)});
  if (!options.write_recipe.empty()) write_file(options.write_recipe, companions.back().second);
  return make_limb(guess.anatomy, strangers.bones, strangers.muscles, options.settings);
}

void prepare(const Options& options, const std::vector<fs::path>& marks) {
  const fs::path& file = options.inputs.front();
  std::optional<ProgressBar> bar(std::in_place);
  show(*bar, "read", 0.0);
  LabelVolume volume = read_label_volume(file);
  MapRules rules{{}, options.bones, ""};
  if (!options.segments.empty()) rules.table = read_segment_table(options.segments);
  const std::optional<Mapping> mapping = map_by_recipe(options, volume, rules);
  const SegmentMap map = mapping ? mapping->map : map_segments(volume.segments, {}, rules);
  std::vector<std::string> notes = volume.notes;
  notes.insert(notes.end(), map.notes.begin(), map.notes.end());
  if (!options.write_segments.empty()) write_segment_table(options.write_segments, table_of(map));
  if (mapping) require_all_known(map, file.string());
  if (mapping && !marks.empty()) {
    throw Error(ExitStatus::Usage,
                marks.front().string() +
                    ": the recipe says where this limb's joints and attachments are; edit the recipe, "
                    "or take all as marked with --guess");
  }
  show(*bar, "smooth", 0.05);
  std::optional<PartVolume> parts = with_margins(file, volume, map.choices);
  if (!parts) {
    parts = smoothed(volume, map.choices, options.settings.threads, notes);
    if (mapping) {
      for (const LaidTendon& tendon : lay_tendons(*parts, mapping->anatomy.muscles)) notes.push_back(describe(tendon));
    }
  }
  volume.layers.clear();
  show(*bar, "cut", 0.15);
  Surfaces surfaces = cut(*parts, map.choices, options.settings.threads);
  const double length_m = step_m(parts->lattice);
  parts.reset();
  bar.reset();
  std::vector<Markup> markups = read_marks(marks, notes);
  for (const std::string& note : notes) spdlog::info("{}", note);
  anatomy::CompanionFiles companions = companions_of(options);
  LimbWork limb = mapping ? known_limb(*mapping, surfaces, options)
                          : guessed_limb(file, surfaces, std::move(markups), options, companions);
  if (options.output.empty()) return;  // the recipe alone was wanted
  take_skins(surfaces.skins, limb, length_m);
  limb.notes = std::move(notes);
  finish_limb(limb, options, options.output, std::move(companions));
}

void print_measures(const MeasuredLimb& limb) {
  std::cout << fmt::format("{:<36} {:>10} {:>8} {:>8} {:>7} {:>8}\n", "part", "points", "in bone", "kept", "added",
                           "dropped");
  for (const MeasuredPart& part : limb.parts) {
    const auto claimed = static_cast<double>(part.share.claimed), in_bone = static_cast<double>(part.share.in_bone);
    std::cout << fmt::format("{:<36} {:>10} {:>8.2f} {:>8.2f} {:>7} {:>8}\n", part.key, part.share.kept,
                             in_bone / claimed, static_cast<double>(part.share.kept) / (claimed - in_bone), part.added,
                             part.dropped);
  }
  for (const LaidTendon& tendon : limb.tendons) std::cout << describe(tendon) << "\n";
  std::cout << std::flush;
}

}  // namespace

void prepare_volume(const Options& options) {
  const StrangerInputs others = find_inputs({options.inputs.begin() + 1, options.inputs.end()});
  if (!others.surfaces.empty()) {
    throw Error(ExitStatus::Usage,
                others.surfaces.front().string() +
                    ": one volume holds the whole limb; name nothing but Markups (.mrk.json) beside it");
  }
  prepare(options, others.markups);
}

int measure_volume(const Options& options) {
  if (!options.output.string().ends_with(".seg.nrrd")) {
    throw Error(ExitStatus::Usage, "--output: must end in .seg.nrrd; the margins go beside it");
  }
  check_output(options.output, "volume");
  return unless_interrupted([&] {
    const AnatomyData recipe = read_recipe(options.recipe);
    Scan scan = read_scan(options.inputs, recipe);
    set_units_and_frame(scan, recipe, options.units);
    for (const std::string& note : scan.notes) spdlog::info("{}", note);
    LimbWork limb = make_limb(recipe, scan.bones, scan.muscles, options.settings);
    repair_surfaces(limb, [] { stop_when_interrupted(); });
    const MeasuredLimb measured = measure_limb(limb, 1e-3 * options.step_mm, [] { stop_when_interrupted(); });
    write_part_volume(options.output, measured.volume);
    print_measures(measured);
  });
}

}  // namespace myotact::prepare
