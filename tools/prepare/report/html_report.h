#pragma once

#include <string>
#include <vector>

#include "anatomy/specimen.h"
#include "prepare/limb_work.h"

namespace myotact::prepare {

/// The report of a prepared limb as one HTML file that needs no other: what a person should decide, a table of the
/// stages, tables and pictures of all parts with defects marked, histograms of the tets. `specimen` came out of `limb`;
/// `violations` are those of find_violations(). Where nothing can be drawn, it states so in the pictures' place. Times
/// are not in it: the same input gives the same bytes.
std::string html_report(const LimbWork& limb, const anatomy::Specimen& specimen,
                        const std::vector<std::string>& violations);

}  // namespace myotact::prepare
