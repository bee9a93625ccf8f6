#include <filesystem>

#include <gtest/gtest.h>

#include "prepare/phantom_volume.h"
#include "prepare/volume/read_label_volume.h"
#include "support/source_folder.h"

// Files that nibabel, teem and ITK wrote (fixtures_volume/README.md) hold the phantom, wherever its axes run.

namespace myotact::prepare {
namespace {

TEST(ForeignVolumes, HoldThePhantom) {
  const auto folder = std::filesystem::path(source_folder()) / "tests" / "prepare" / "fixtures_volume";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (!is_label_volume(entry.path())) continue;
    ++files;
    const LabelVolume volume = read_label_volume(entry.path());
    EXPECT_EQ(testing::phantom_difference(volume), "") << entry.path();
    EXPECT_EQ(volume.segments.size(), 5U) << entry.path();
  }
  EXPECT_EQ(files, 10);
}

}  // namespace
}  // namespace myotact::prepare
