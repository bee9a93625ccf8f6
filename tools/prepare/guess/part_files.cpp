#include "prepare/guess/part_files.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "geometry/mesh_files.h"
#include "prepare/recipe/surface_files.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

struct Unit {
  const char* name;
  double metres;
};
/// In the order in which they are tried: what lies within a limb's sizes in metres is in metres.
constexpr std::array<Unit, 4> kUnits = {{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"in", 0.0254}}};
/// Diagonal of a part or a limb, from a muscle of a small dog to a whole large one [m].
constexpr double kSmallest_m = 0.02, kLargest_m = 3.0;
/// The same where somebody named the unit.
constexpr double kSmallestNamed_m = 5e-3;

constexpr const char* kMarkups = ".mrk.json";

bool is_markups(const fs::path& file) {
  return lower(file.filename().string()).ends_with(kMarkups);
}

std::string holder_of(const fs::path& file) {
  return file.parent_path().filename().string();
}

bool lies_sorted(const fs::path& file) {
  return holder_of(file) == "bones" || holder_of(file) == "muscles";
}

void add_markups_in(const fs::path& folder, std::vector<fs::path>& files) {
  std::vector<fs::path> found;
  for (const fs::path& place : {folder, folder / "markups"}) {
    if (!fs::is_directory(place)) continue;
    for (const auto& entry : fs::directory_iterator(place)) {
      if (is_markups(entry.path())) found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  files.insert(files.end(), found.begin(), found.end());
}

void check_names(const std::vector<std::string>& bones, const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.stem().string());
  for (const std::string& bone : bones) {
    const bool there = std::any_of(names.begin(), names.end(),
                                   [&](const std::string& name) { return part_key(name) == part_key(bone); });
    if (there) continue;
    throw Error(ExitStatus::Usage, fmt::format("--bones: names \"{}\", which no file is called; the nearest is \"{}\"",
                                               bone, nearest_word(bone, names)));
  }
}

void set_kind(PartFile& part, const std::vector<std::string>& bones, const NamedPart* known) {
  if (!bones.empty()) {
    part.bone = std::any_of(bones.begin(), bones.end(),
                            [&](const std::string& bone) { return part_key(bone) == part_key(part.name); });
    part.sure = true;
    return;
  }
  const LikelyKind kind = kind_by_name(part.name);
  part.sure = true;
  if (lies_sorted(part.path))
    part.bone = holder_of(part.path) == "bones";
  else if (known)
    part.bone = known->bone;
  else
    part.bone = kind == LikelyKind::Bone, part.sure = kind != LikelyKind::Unknown;
}

/// Keys become names of files: a second one of a kind gets a number.
void make_keys_differ(std::vector<PartFile>& parts) {
  std::map<std::string, int> times;
  for (const PartFile& part : parts) ++times[part.key];
  std::set<std::string> taken;
  for (PartFile& part : parts) {
    if (times[part.key] > 1) part.key = part_key(part.name);  // two femora: each keeps what its file is called
    const std::string first = part.key;
    for (int number = 2; !taken.insert(part.key).second; ++number) part.key = fmt::format("{}_{}", first, number);
  }
}

double diagonal(const std::vector<NamedSurface>& bones, const std::vector<NamedSurface>& muscles) {
  Eigen::AlignedBox3d box;
  for (const auto* parts : {&bones, &muscles}) {
    for (const NamedSurface& part : *parts) {
      for (const Vec3& p : part.surface.positions_m) {
        if (p.allFinite()) box.extend(p);
      }
    }
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

double metres_of(std::string& units, double size) {
  const bool named = !units.empty();
  for (const Unit& unit : kUnits) {
    if (named && units != unit.name) continue;
    const double size_m = size * unit.metres;
    if (size_m < (named ? kSmallestNamed_m : kSmallest_m) || size_m > kLargest_m) continue;
    units = unit.name;
    return unit.metres;
  }
  throw bad_data("units", "",
                 fmt::format("all parts together are {} {} across, which is no limb; must be {} .. {} m. Name the unit "
                             "with --units, one of m, cm, mm, in",
                             to_text(size), named ? units : "units", to_text(named ? kSmallestNamed_m : kSmallest_m),
                             to_text(kLargest_m)));
}

}  // namespace

StrangerInputs find_inputs(const std::vector<fs::path>& inputs) {
  StrangerInputs found;
  for (const fs::path& input : inputs) {
    if (!fs::exists(input)) throw Error(ExitStatus::NoInput, input.string() + ": is not there");
    if (is_markups(input)) {
      found.markups.push_back(input);
    } else if (!fs::is_directory(input)) {
      found.surfaces.push_back(input);
    } else {
      for (const fs::path& file : surface_files_in(input)) found.surfaces.push_back(file);
      add_markups_in(input, found.markups);
    }
  }
  return found;
}

std::vector<PartFile> sort_parts(const std::vector<fs::path>& files, const std::vector<std::string>& bones,
                                 const KnownParts& known) {
  check_names(bones, files);
  std::vector<PartFile> parts;
  for (const fs::path& file : files) {
    PartFile part{file, file.stem().string(), part_key(file.stem().string())};
    const auto index = find_known(part.name, known);
    set_kind(part, bones, index ? &known[*index] : nullptr);
    if (index && known[*index].bone == part.bone) part.key = known[*index].key;
    parts.push_back(std::move(part));
  }
  make_keys_differ(parts);
  return parts;
}

std::vector<Decision> decisions_on(const std::vector<PartFile>& parts) {
  std::vector<Decision> decisions;
  for (const PartFile& part : parts) {
    if (part.sure) continue;
    decisions.push_back({"parts",
                         part.key,
                         fmt::format("neither folder nor name of {} says what it is: taken for a muscle. If it is a "
                                     "bone, list all bones: --bones {},...",
                                     part.path.filename().string(), part.name),
                         {"bone", "muscle"}});
  }
  return decisions;
}

Strangers read_strangers(const std::vector<PartFile>& parts, std::string& units, std::vector<std::string>& notes) {
  Strangers strangers;
  for (const PartFile& part : parts) {
    geometry::SurfaceFile file = geometry::read_surface(part.path);
    for (const std::string& note : file.notes) notes.push_back(part.name + ": " + note);
    (part.bone ? strangers.bones : strangers.muscles).push_back({part.key, std::move(file.mesh)});
  }
  const double metres = metres_of(units, diagonal(strangers.bones, strangers.muscles));
  if (metres == 1.0) return strangers;
  for (auto* surfaces : {&strangers.bones, &strangers.muscles}) {
    for (NamedSurface& part : *surfaces) {
      for (Vec3& p : part.surface.positions_m) p *= metres;
    }
  }
  return strangers;
}

void name_files(const std::vector<PartFile>& parts, const std::string& units, AnatomyData& anatomy) {
  anatomy.units = units;
  const auto file_of = [&](const std::string& key) {
    const auto part = std::find_if(parts.begin(), parts.end(), [&](const PartFile& p) { return p.key == key; });
    if (part == parts.end()) return std::string();
    const std::string file = part->path.filename().string();
    return lies_sorted(part->path) ? holder_of(part->path) + "/" + file : file;
  };
  for (BoneData& bone : anatomy.bones) bone.file = file_of(bone.key);
  for (MuscleData& muscle : anatomy.muscles) muscle.file = file_of(muscle.mechanics.key);
}

}  // namespace myotact::prepare
