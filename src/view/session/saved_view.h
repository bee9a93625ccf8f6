#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "anatomy/specimen.h"
#include "core/json_reader.h"
#include "view/look/view_state.h"

namespace myotact::view {

/// How a limb is looked at, for a file: parts are identified by their keys, so that it outlives a specimen's lists.
struct SavedView {
  ViewState look;                                   // of no part: its lists are empty, nothing is selected
  std::vector<std::string> hidden, faded, plotted;  // keys of bones and muscles
  std::string selected;                             // key; empty: none

  bool operator==(const SavedView&) const = default;
};

SavedView saved_view(const ViewState& view, const anatomy::Specimen& specimen);

/// Shows it. Names that are hidden now stay so: a lesson asks for one. Returns the keys of parts that the specimen does
/// not have; the rest is shown.
std::vector<std::string> show(const SavedView& saved, const anatomy::Specimen& specimen, ViewState& view);

nlohmann::json json_of(const SavedView& saved);
/// Throws Error BadData.
SavedView parse_view(const JsonValue& json);

}  // namespace myotact::view
