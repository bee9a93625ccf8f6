#include "view/look/part.h"

#include <fmt/format.h>

namespace myotact::view {

const std::string& key_of(const anatomy::Specimen& specimen, const Part& part) {
  const auto index = static_cast<std::size_t>(part.index);
  return part.kind == PartKind::Bone ? specimen.bones.at(index).key : specimen.muscles.at(index).key;
}

std::string name_of(const anatomy::Specimen& specimen, const Part& part, NameStyle style) {
  if (!part) return "";
  const auto choose = [style](const std::string& english, const std::string& latin) {
    if (latin.empty() || (style == NameStyle::English && !english.empty())) return english;
    if (style == NameStyle::Latin || english.empty() || english == latin) return latin;
    return fmt::format("{} ({})", english, latin);
  };
  const auto i = static_cast<std::size_t>(part.index);
  if (part.kind == PartKind::Bone) return choose(specimen.bones.at(i).name_en, specimen.bones.at(i).name_la);
  return choose(specimen.muscles.at(i).name_en, specimen.muscles.at(i).name_la);
}

std::string name_of(const anatomy::Specimen& specimen, const Part& part, const ViewState& view) {
  return view.names_hidden ? "?" : name_of(specimen, part, view.names);
}

}  // namespace myotact::view
