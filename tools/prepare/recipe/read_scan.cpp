#include "prepare/recipe/read_scan.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "geometry/mesh_files.h"
#include "geometry/triangle_tree.h"
#include "prepare/recipe/surface_files.h"
#include "prepare/surface/surface_pieces.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

/// A part of the recipe and the name its file should have, without extension: "muscles/brachialis".
struct Wanted {
  std::string name;
  std::string key;
  bool muscle = false;
  std::optional<Vec3> piece_m = {};  // see BoneData
};

std::string without_extension(const std::string& file) {
  return (fs::path(file).parent_path() / fs::path(file).stem()).string();
}

std::vector<Wanted> wanted_by(const AnatomyData& recipe) {
  std::vector<Wanted> wanted;
  for (const BoneData& bone : recipe.bones) {
    wanted.push_back(
        {bone.file.empty() ? "bones/" + bone.key : without_extension(bone.file), bone.key, false, bone.piece_m});
  }
  for (const MuscleData& muscle : recipe.muscles) {
    const std::string& key = muscle.mechanics.key;
    wanted.push_back({muscle.file.empty() ? "muscles/" + key : without_extension(muscle.file), key, true});
  }
  return wanted;
}

/// Whether a file's path ends like the wanted name ("muscles/brachialis"), or is named after the key.
bool fits(const fs::path& file, const Wanted& part) {
  const fs::path name = part.name;
  if (file.stem() != name.filename()) return file.stem() == part.key;
  const std::string holder = file.parent_path().filename().string();
  const bool other_kind = (holder == "bones" || holder == "muscles") && holder != name.parent_path().filename();
  return !other_kind;
}

class Collector {
 public:
  explicit Collector(const AnatomyData& recipe) : wanted_(wanted_by(recipe)), found_(wanted_.size()) {
    for (const LeftOut& left : recipe.leave_out) left_out_.emplace(without_extension(left.file), left.why);
  }

  void add(const fs::path& file) {
    const std::string name = (file.parent_path().filename() / file.stem()).string();
    if (const auto left = left_out_.find(name); left != left_out_.end()) {
      scan_.notes.push_back(name + ": left out: " + left->second);
      return;
    }
    const auto part = std::find_if(wanted_.begin(), wanted_.end(), [&](const Wanted& w) { return fits(file, w); });
    if (part == wanted_.end()) {
      strangers_.push_back(name);
      return;
    }
    auto& place = found_[static_cast<std::size_t>(part - wanted_.begin())];
    if (place) {
      throw bad_data(file.string(), "",
                     fmt::format("is the second surface of {}; the first is {}. Remove or rename one", part->key,
                                 place->string()));
    }
    place = file;
  }

  Scan read() {
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      if (!found_[i]) continue;
      geometry::SurfaceFile file = geometry::read_surface(*found_[i]);
      for (const std::string& note : file.notes) scan_.notes.push_back(wanted_[i].name + ": " + note);
      if (wanted_[i].piece_m) {
        add_pieces(file.mesh, wanted_[i].name);
        continue;
      }
      (wanted_[i].muscle ? scan_.muscles : scan_.bones).push_back({wanted_[i].key, std::move(file.mesh)});
    }
    if (!strangers_.empty())
      scan_.notes.push_back("not in the recipe, left alone (--guess takes all parts as they are): " + join(strangers_));
    return std::move(scan_);
  }

  std::string names(bool muscles) const {
    std::vector<std::string> names;
    for (const Wanted& part : wanted_) {
      if (part.muscle == muscles) names.push_back(part.name);
    }
    return join(names);
  }

 private:
  /// One file, several bones: every piece goes to the bone that names the nearest place.
  void add_pieces(const geometry::TriangleMesh& surface, const std::string& name) {
    std::map<std::size_t, geometry::TriangleMesh> bones;  // by place in wanted_
    for (const geometry::TriangleMesh& piece : pieces_of(surface)) {
      const geometry::TriangleTree tree(piece);
      std::size_t nearest = wanted_.size();
      double least_m = 0.0;
      for (std::size_t i = 0; i < wanted_.size(); ++i) {
        if (wanted_[i].name != name || !wanted_[i].piece_m) continue;
        const double away_m = tree.nearest(*wanted_[i].piece_m, piece.positions_m).distance_m;
        if (nearest < wanted_.size() && away_m >= least_m) continue;
        nearest = i;
        least_m = away_m;
      }
      append(bones[nearest], piece);
    }
    for (auto& [i, bone] : bones) scan_.bones.push_back({wanted_[i].key, std::move(bone)});
  }

  std::vector<Wanted> wanted_;
  std::vector<std::optional<fs::path>> found_;
  std::map<std::string, std::string> left_out_;  // name -> why
  std::vector<std::string> strangers_;
  Scan scan_;
};

}  // namespace

Scan read_scan(const std::vector<fs::path>& inputs, const AnatomyData& recipe) {
  Collector collector(recipe);
  for (const fs::path& input : inputs) {
    if (!fs::exists(input)) throw Error(ExitStatus::NoInput, input.string() + ": is not there");
    if (!fs::is_directory(input)) {
      collector.add(input);
      continue;
    }
    for (const fs::path& file : surface_files_in(input)) collector.add(file);
  }
  Scan scan = collector.read();
  for (const bool muscles : {false, true}) {
    const bool wanted = muscles ? !recipe.muscles.empty() : !recipe.bones.empty();
    if (!wanted || !(muscles ? scan.muscles : scan.bones).empty()) continue;
    throw Error(ExitStatus::NoInput,
                fmt::format("{}: holds none of the recipe's {}; rename the files, or name another recipe. It knows {}",
                            inputs.front().string(), muscles ? "muscles" : "bones", collector.names(muscles)));
  }
  return scan;
}

}  // namespace myotact::prepare
