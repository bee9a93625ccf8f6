#include "prepare/guess/wizard.h"

#include <algorithm>
#include <istream>
#include <limits>
#include <optional>
#include <ostream>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/at.h"
#include "core/text.h"
#include "prepare/guess/muscle_contacts.h"

namespace myotact::prepare {

namespace {

/// A marked hinge's range, which the guess takes, too [rad].
constexpr double kRange_rad = 0.52;

std::optional<Vec3> direction_of(const std::string& text) {
  const auto words = words_of(text);
  if (words.size() != 3) return {};
  Vec3 direction;
  for (int i = 0; i < 3; ++i) {
    const auto number = parse_number(words[at(i)]);
    if (!number) return {};
    direction[i] = *number;
  }
  if (!(direction.norm() > 1e-9 && direction.norm() < 1e9)) return {};
  return direction.normalized().normalized();
}

const NamedSurface* surface_of(const std::vector<NamedSurface>& surfaces, const std::string& key) {
  const auto found = std::find_if(surfaces.begin(), surfaces.end(), [&](const auto& s) { return s.key == key; });
  return found == surfaces.end() ? nullptr : &*found;
}

/// The muscle's place that is nearest to the bone.
AttachmentSite site_on(const NamedSurface& muscle, const NamedSurface& bone) {
  const BoneDistance distance(bone.surface);
  AttachmentSite site;
  site.bones = {bone.key};
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Vec3& p : muscle.surface.positions_m) {
    Vec3 place_m;
    const double here_m = distance.nearest_m(p, place_m);
    if (here_m < nearest_m) nearest_m = here_m, site.point_m = p;
  }
  return site;
}

}  // namespace

std::string Wizard::ask(const std::string& question, const std::string& taken,
                        const std::vector<std::string>& allowed) {
  while (true) {
    out_ << question << " [" << taken << "] " << std::flush;
    std::string line;
    if (!std::getline(in_, line)) return taken;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty()) return taken;
    if (allowed.empty() || std::find(allowed.begin(), allowed.end(), line) != allowed.end()) return line;
    out_ << "must be one of " << join(allowed) << "; the nearest is " << nearest_word(line, allowed) << "\n";
  }
}

void Wizard::ask_parts(std::vector<PartFile>& parts) {
  for (PartFile& part : parts) {
    if (part.sure) continue;
    part.bone = ask(part.path.filename().string() + ": bone or muscle?", "muscle", {"bone", "muscle"}) == "bone";
    part.sure = true;
  }
}

void Wizard::ask_units(const Strangers& strangers, std::string& units) {
  Eigen::AlignedBox3d box;
  for (const auto* parts : {&strangers.bones, &strangers.muscles}) {
    for (const NamedSurface& part : *parts) {
      for (const Vec3& p : part.surface.positions_m) box.extend(p);
    }
  }
  const double size_m = box.isEmpty() ? 0.0 : box.diagonal().norm();
  units = ask(fmt::format("In {} all parts together are {:.3f} m across. Unit of the files?", units, size_m), units,
              {"m", "cm", "mm", "in"});
}

void Wizard::ask_recipe(const Strangers& strangers, const KnownParts& known, GuessedRecipe& guess) {
  AnatomyData& anatomy = guess.anatomy;
  anatomy.name = ask("Name of the specimen?", anatomy.name);
  anatomy.species = ask("Species?", anatomy.species);
  anatomy.side = ask("Side?", anatomy.side, {"left", "right"});
  anatomy.source = ask("Where is it from?", anatomy.source);
  anatomy.licence = ask("Licence?", anatomy.licence);
  ask_ends(strangers, guess);
  ask_joints(anatomy);
  ask_names(anatomy, known);
}

void Wizard::ask_names(AnatomyData& anatomy, const KnownParts& known) {
  const auto ask_name = [&](const std::string& key, std::string& la, std::string& en) {
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const auto& part) { return part.key == key; });
    if (is_known) return;
    const std::vector<std::string> similar = similar_parts(key, known);
    const std::string hint = similar.empty() ? "" : " (" + join(similar, " or ") + "?)";
    en = ask(fmt::format("English name of {}{}?", key, hint), en);
    const auto meant = find_known(en, known);
    if (meant) en = known[*meant].name_en;
    la = ask(fmt::format("Latin name of {}?", key), meant ? known[*meant].name_la : la);
  };
  for (BoneData& bone : anatomy.bones) ask_name(bone.key, bone.name_la, bone.name_en);
  for (MuscleData& muscle : anatomy.muscles) {
    ask_name(muscle.mechanics.key, muscle.mechanics.name_la, muscle.mechanics.name_en);
  }
}

void Wizard::ask_ends(const Strangers& strangers, GuessedRecipe& guess) {
  std::vector<std::string> bones;
  for (const NamedSurface& bone : strangers.bones) bones.push_back(bone.key);
  for (const Decision& decision : guess.decisions) {
    if (decision.about != "attachments" || decision.sure || decision.suggestions.empty()) continue;
    const auto muscle = std::find_if(guess.anatomy.muscles.begin(), guess.anatomy.muscles.end(),
                                     [&](const MuscleData& m) { return m.mechanics.key == decision.part; });
    const NamedSurface* surface = surface_of(strangers.muscles, decision.part);
    if (muscle == guess.anatomy.muscles.end() || !surface) continue;
    const bool origin = decision.pointer.ends_with("/origin");
    out_ << decision.part << ": " << decision.text << "\n";
    const std::string bone =
        ask(origin ? "Bone of its origin?" : "Bone of its insertion?", decision.suggestions.front(), bones);
    if (bone == decision.suggestions.front()) continue;
    const NamedSurface* named = surface_of(strangers.bones, bone);
    if (!named) continue;
    std::vector<AttachmentSite>& sites = origin ? muscle->origins : muscle->insertions;
    sites.assign(1, site_on(*surface, *named));
  }
}

void Wizard::ask_joints(AnatomyData& anatomy) {
  for (anatomy::Joint& joint : anatomy.joints) {
    if (joint.type != anatomy::JointType::Weld) continue;
    const std::string question =
        fmt::format("Does {} turn on {}? Its axis as three numbers (a right-hand rotation about it flexes), or",
                    anatomy.bodies[at(joint.child)].key, anatomy.bodies[at(joint.parent)].key);
    const auto direction = direction_of(ask(question, "fixed"));
    if (!direction) continue;
    joint.type = anatomy::JointType::Hinge;
    joint.axes = {*direction};
    joint.range_rad = {{-kRange_rad, kRange_rad}};
  }
}

}  // namespace myotact::prepare
