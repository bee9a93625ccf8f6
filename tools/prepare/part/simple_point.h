#pragma once

#include <cstdint>

namespace myotact::prepare {

/// A lattice node and its 26 neighbours, one bit each: bit 13 + x + 3 y + 9 z for the offset (x, y, z), each -1, 0
/// or 1.
using Neighbourhood = std::uint32_t;

/// The 14 neighbours that the middle node has an edge to in the tetrahedra that extract_level_set() cuts cubes into:
/// those whose offset is nowhere negative or nowhere positive.
extern const Neighbourhood kLink;

/// Whether taking the middle node away from a body leaves the number of its pieces, handles and cavities as it is; the
/// bits set are the body. The link is a triangulated sphere, so this is when the body's part of it and the rest of it
/// each hang together.
bool is_simple(Neighbourhood body);

}  // namespace myotact::prepare
