#pragma once

#include <string>
#include <vector>

#include "prepare/volume/byte_source.h"
#include "prepare/volume/volume_header.h"

namespace myotact::prepare {

/// Bytes of all points and layers.
std::uint64_t size_of_points(const VolumeHeader& header);

/// The labels of every layer, from the next bytes to the end of the source; memory is taken only for as many as the
/// source can hold. Throws Error BadData that names `file`: fewer or more bytes than the header says, labels outside 0
/// .. 65535 (with their place), numbers that are no integers.
std::vector<Labels> read_points(const VolumeHeader& header, ByteSource& source, const std::string& file);

}  // namespace myotact::prepare
