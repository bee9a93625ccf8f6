#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "prepare/phantom_volume.h"
#include "prepare/volume/read_label_volume.h"
#include "prepare/volume/write_label_volume.h"
#include "support/temporary_folder.h"

namespace myotact::prepare {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::PhantomGrid;

std::string vector_text(const Vec3& v) {
  return fmt::format("({},{},{})", v.x(), v.y(), v.z());
}

/// The phantom as raw NRRD, in a space whose axes are these multiples of LPS.
std::string raw_nrrd(const PhantomGrid& grid, const std::string& space, const Vec3& signs) {
  std::string bytes = fmt::format("NRRD0004\ntype: unsigned char\ndimension: 3\nspace: {}\nsizes: {} {} {}\n", space,
                                  grid.counts[0], grid.counts[1], grid.counts[2]);
  bytes += "space directions:";
  for (int axis = 0; axis < 3; ++axis) bytes += " " + vector_text(signs.cwiseProduct(grid.steps_mm.col(axis)));
  bytes += "\nencoding: raw\nspace origin: " + vector_text(signs.cwiseProduct(grid.origin_mm)) + "\n\n";
  for (const int label : testing::phantom_labels(grid)) bytes += static_cast<char>(label);
  return bytes;
}

TEST(LabelVolume, IsTheSameInSpaceForEveryOrderOfAxesAndEverySpace) {
  for (const PhantomGrid& grid : testing::all_orientations({})) {
    for (const auto& [space, signs] : {std::pair{"left-posterior-superior", Vec3(1, 1, 1)},
                                       {"right-anterior-superior", Vec3(-1, -1, 1)},
                                       {"LAS", Vec3(1, -1, 1)}}) {
      const LabelVolume volume = parse_label_volume(raw_nrrd(grid, space, signs), "p.nrrd");
      EXPECT_EQ(testing::phantom_difference(volume), "") << space;
    }
  }
}

TEST(LabelVolume, MayBeObliqueAndUneven) {
  const LabelVolume volume =
      parse_label_volume(raw_nrrd(testing::oblique_grid(), "left-posterior-superior", Vec3::Ones()), "p.nrrd");
  EXPECT_EQ(testing::phantom_difference(volume), "");
  EXPECT_NEAR(volume.lattice.steps_m.col(2).norm(), 3.1e-3, 1e-12);
  EXPECT_THAT(volume.notes, ElementsAre(HasSubstr("coarser along one axis")));
}

TEST(LabelVolume, NamesASegmentByItsLabelWhereTheFileDoesNot) {
  const LabelVolume volume = parse_label_volume(raw_nrrd({}, "LPS", Vec3::Ones()), "p.nrrd");
  ASSERT_EQ(volume.segments.size(), 5U);
  EXPECT_EQ(volume.segments[2].name, "label 3");
  EXPECT_EQ(volume.segments[2].label, 3);
}

/// The phantom in the specimen frame, in two layers: the second holds the sheet and a label beyond 255.
LabelVolume two_layers() {
  LabelVolume volume = parse_label_volume(raw_nrrd(testing::oblique_grid(), "LPS", Vec3::Ones()), "p.nrrd");
  volume.layers.push_back(volume.layers[0]);
  for (std::uint16_t& label : volume.layers[1])
    label = label == testing::kSheet ? 1 : label == testing::kBone ? 700 : 0;
  for (Segment& segment : volume.segments)
    segment.name = testing::kPhantomNames[static_cast<std::size_t>(segment.label)];
  volume.segments.push_back({"a name: with\\signs\nand lines", 1, 1, {}});
  volume.segments.push_back({"far label", 700, 1, {}});
  return volume;
}

TEST(LabelVolume, ComesBackAsItWasWritten) {
  const testing::TemporaryFolder folder;
  const LabelVolume written = two_layers();
  write_label_volume(folder / "v.seg.nrrd", written);
  const LabelVolume read = read_label_volume(folder / "v.seg.nrrd");
  EXPECT_EQ(read.layers, written.layers);
  EXPECT_EQ(read.lattice.counts, written.lattice.counts);
  EXPECT_LT((read.lattice.steps_m - written.lattice.steps_m).norm(), 1e-17);
  EXPECT_LT((read.lattice.origin_m - written.lattice.origin_m).norm(), 1e-16);
  ASSERT_EQ(read.segments.size(), written.segments.size());
  for (std::size_t i = 0; i < read.segments.size(); ++i) {
    EXPECT_EQ(read.segments[i].name, written.segments[i].name);
    EXPECT_EQ(read.segments[i].label, written.segments[i].label);
    EXPECT_EQ(read.segments[i].layer, written.segments[i].layer);
  }
  write_label_volume(folder / "again.seg.nrrd", written);
  EXPECT_EQ(read_file(folder / "again.seg.nrrd"), read_file(folder / "v.seg.nrrd"));
}

TEST(LabelVolume, ScalarsComeBackAsLabels) {
  const testing::TemporaryFolder folder;
  const PhantomGrid grid;
  const Lattice lattice = parse_label_volume(raw_nrrd(grid, "LPS", Vec3::Ones()), "p.nrrd").lattice;
  std::vector<std::uint8_t> bytes;
  for (const int label : testing::phantom_labels(grid)) bytes.push_back(static_cast<std::uint8_t>(label * 50));
  write_scalars(folder / "s.nrrd", lattice, bytes);
  EXPECT_EQ(testing::phantom_difference(read_label_volume(folder / "s.nrrd"), 0, 50), "");
}

}  // namespace
}  // namespace myotact::prepare
