#include "core/at.h"
#include "fuzz/check.h"
#include "prepare/volume/read_label_volume.h"

namespace {

using namespace myotact;

/// What a volume promises to those that cut it into parts.
void check_volume(const prepare::LabelVolume& volume) {
  const prepare::Lattice& lattice = volume.lattice;
  testing::require(!volume.layers.empty() && !volume.segments.empty());
  testing::require(lattice.origin_m.allFinite() && lattice.steps_m.allFinite());
  testing::require(lattice.steps_m.colwise().norm().minCoeff() > 0.0);
  for (const prepare::Labels& layer : volume.layers) testing::require(layer.size() == lattice.size());
  for (const prepare::Segment& segment : volume.segments) {
    const prepare::Labels& layer = volume.layers.at(at(segment.layer));
    testing::require(segment.label > 0 && !segment.name.empty());
    testing::require(std::find(layer.begin(), layer.end(), segment.label) != layer.end());
  }
}

}  // namespace

/// The format is told by the first bytes, as its writers put them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = testing::as_text(data, size);
  const char* name = bytes.starts_with("NRRD") ? "f.nrrd" : bytes.starts_with("ObjectType") ? "f.mha" : "f.nii.gz";
  testing::check_reader(name, [&] { check_volume(prepare::parse_label_volume(bytes, name)); });
  return 0;
}
