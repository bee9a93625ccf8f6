#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "net/wire.h"

namespace myotact::remote {

/// Payloads of the Mesh frames of a specimen: all skins, then all bones. One that is too large for a frame is left out
/// and reported in the log.
std::vector<net::Bytes> mesh_frames(const anatomy::Specimen& specimen);

}  // namespace myotact::remote
