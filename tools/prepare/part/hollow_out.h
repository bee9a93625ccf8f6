#pragma once

#include <array>
#include <vector>

namespace myotact::prepare {

/// What is left of a full block of nodes (`counts` of them along x, y and z, x fastest) when all but `kept` that can go
/// without opening a handle are gone, dear ones first: the outermost layer at once, then from outside inward (Aktouf,
/// Bertrand and Perroton 2002). It hangs together and has neither handle nor cavity; what it has besides `kept` closes
/// their holes and joins their pieces. Nodes of the outermost layer must not be kept.
std::vector<bool> hollow_out(const std::array<int, 3>& counts, const std::vector<bool>& kept,
                             const std::vector<float>& cost);

}  // namespace myotact::prepare
