#include "prepare/partition/part_volume_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "prepare/partition/border_points.h"
#include "prepare/volume/read_label_volume.h"
#include "prepare/volume/write_label_volume.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

/// Files count from here: 0 would be no label in them.
constexpr int kNone = 1;
constexpr const char* kLabelsEnding = ".seg.nrrd";

}  // namespace

fs::path margins_beside(const fs::path& labels) {
  std::string name = labels.filename().string();
  if (name.ends_with(kLabelsEnding)) name.resize(name.size() - std::string(kLabelsEnding).size());
  return labels.parent_path() / (name + ".margins.nrrd");
}

void write_part_volume(const fs::path& labels, const PartVolume& volume) {
  LabelVolume segmentation{volume.lattice, {volume.labels}, {}, {}};
  for (std::size_t i = 0; i < volume.keys.size(); ++i) {
    segmentation.segments.push_back({volume.keys[i], static_cast<int>(i + 1), 0, {}});
  }
  std::vector<std::uint8_t> margins;
  for (const std::size_t point : border_points(volume.lattice, volume.labels)) {
    margins.push_back(static_cast<std::uint8_t>(volume.margins[point] + kNone));
  }
  Lattice line = volume.lattice;
  line.counts = {static_cast<int>(margins.size()), 1, 1};
  write_label_volume(labels, segmentation);
  write_scalars(margins_beside(labels), line, margins);
}

std::optional<std::vector<std::uint8_t>> read_margins(const fs::path& labels, const Lattice& lattice,
                                                      const Labels& volume) {
  const fs::path file = margins_beside(labels);
  if (!fs::exists(file)) return {};
  const LabelVolume line = read_label_volume(file);
  if (!has_free_rim(lattice, volume)) {
    throw bad_data(labels.string(), "labels", "reach the rim of the lattice, which margins do not allow; pad them");
  }
  const std::vector<std::size_t> border = border_points(lattice, volume);
  if (line.lattice.size() != border.size() || line.layers.size() != 1) {
    throw bad_data(file.string(), "sizes",
                   fmt::format("{} margins, but {} has {} border points; measure both anew, or remove the margins",
                               line.lattice.size(), labels.filename().string(), border.size()));
  }
  std::vector<std::uint8_t> margins(volume.size(), static_cast<std::uint8_t>(kLargestMargin * kMarginsPerStep));
  for (std::size_t i = 0; i < border.size(); ++i) {
    const int margin = std::max(0, line.layers[0][i] - kNone);
    margins[border[i]] = static_cast<std::uint8_t>(std::min<int>(margin, margins[border[i]]));
  }
  return margins;
}

}  // namespace myotact::prepare
