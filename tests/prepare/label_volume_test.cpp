#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "prepare/phantom_files.h"
#include "prepare/phantom_volume.h"
#include "prepare/volume/read_label_volume.h"
#include "prepare/volume/write_label_volume.h"
#include "support/temporary_folder.h"

namespace myotact::prepare {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::PhantomGrid;

std::string difference_in(const std::string& bytes, const std::string& name) {
  return testing::phantom_difference(parse_label_volume(bytes, name));
}

constexpr const char* kLps = "left-posterior-superior";

TEST(LabelVolume, IsTheSameInSpaceForEveryFormatAndEveryOrderOfAxes) {
  for (const PhantomGrid& grid : testing::all_orientations({})) {
    for (const auto& [space, signs] :
         {std::pair{kLps, Vec3(1, 1, 1)}, {"right-anterior-superior", Vec3(-1, -1, 1)}, {"LAS", Vec3(1, -1, 1)}}) {
      EXPECT_EQ(difference_in(testing::nrrd_file(grid, space, signs), "p.nrrd"), "") << space;
    }
    for (const int version : {1, 2}) {
      for (const auto places : {testing::NiftiPlaces::Affine, testing::NiftiPlaces::Quaternion}) {
        EXPECT_EQ(difference_in(testing::nifti_file(grid, version, places), "p.nii"), "") << version;
      }
    }
    EXPECT_EQ(difference_in(testing::meta_image_file(grid), "p.mha"), "");
  }
}

TEST(LabelVolume, IsTheSameForEveryTypeOfIntegersAndOrderOfBytes) {
  for (const int bytes : {1, 2, 4, 8}) {
    for (const bool is_signed : {false, true}) {
      for (const bool big_endian : {false, true}) {
        const testing::FileNumbers numbers{bytes, is_signed, big_endian};
        const std::string nifti = testing::nifti_file({}, 1, testing::NiftiPlaces::Affine, numbers);
        EXPECT_EQ(difference_in(testing::nrrd_file({}, kLps, Vec3::Ones(), numbers), "p.nrrd"), "") << bytes;
        EXPECT_EQ(difference_in(nifti, "p.nii"), "") << bytes;
        EXPECT_EQ(difference_in(testing::gzip(nifti), "p.nii.gz"), "") << bytes;
        EXPECT_EQ(difference_in(testing::nifti_file({}, 2, testing::NiftiPlaces::Affine, numbers), "p.nii"), "");
        EXPECT_EQ(difference_in(testing::meta_image_file({}, numbers), "p.mha"), "") << bytes;
        EXPECT_EQ(difference_in(testing::meta_image_file({}, numbers, true), "p.mha"), "") << bytes;
      }
    }
  }
}

TEST(LabelVolume, MayBeObliqueAndUneven) {
  const PhantomGrid grid = testing::oblique_grid();
  EXPECT_EQ(difference_in(testing::nifti_file(grid, 1, testing::NiftiPlaces::Quaternion), "p.nii"), "");
  EXPECT_EQ(difference_in(testing::meta_image_file(grid), "p.mha"), "");
  const LabelVolume volume = parse_label_volume(testing::nrrd_file(grid), "p.nrrd");
  EXPECT_EQ(testing::phantom_difference(volume), "");
  EXPECT_NEAR(volume.lattice.steps_m.col(2).norm(), 3.1e-3, 1e-12);
  EXPECT_THAT(volume.notes, ElementsAre(HasSubstr("coarser along one axis")));
}

TEST(LabelVolume, MayHaveItsPointsInAFileBeside) {
  const testing::TemporaryFolder folder;
  const PhantomGrid grid;
  const std::string points = testing::number_bytes(grid, {});
  write_file(folder / "p.raw", points);
  write_file(folder / "p.zraw", testing::zlib(points));
  write_file(folder / "p.mhd", testing::meta_image_file(grid, {}, false, "p.raw"));
  write_file(folder / "packed.mhd", testing::meta_image_file(grid, {}, true, "p.zraw"));
  std::string header =
      testing::nrrd_file(grid, kLps, Vec3::Ones(), {}, "data file: ./lead.raw\nline skip: 2\nbyte skip: 3\n");
  header.resize(header.find("\n\n") + 1);
  write_file(folder / "p.nhdr", header);
  write_file(folder / "lead.raw", "one\ntwo lines\nabc" + points);
  for (const char* name : {"p.mhd", "packed.mhd", "p.nhdr"}) {
    EXPECT_EQ(testing::phantom_difference(read_label_volume(folder / name)), "") << name;
  }
}

TEST(LabelVolume, MayHaveItsPointsAtTheEnd) {
  std::string file = testing::nrrd_file({}, kLps, Vec3::Ones(), {}, "byte skip: -1\n");
  file.insert(file.find("\n\n") + 2, "something else before them");
  EXPECT_EQ(difference_in(file, "p.nrrd"), "");
}

/// Segments as 3D Slicer before 4.11 wrote them: a layer each, as the first axis, and no label values.
TEST(LabelVolume, ReadsSlicersLayers) {
  std::string file =
      "NRRD0004\ntype: unsigned char\ndimension: 4\nspace: left-posterior-superior\nsizes: 2 3 1 1\n"
      "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\n"
      "space origin: (0,0,0)\nSegment0_Name:=femur\nSegment1_Name:=vastus\nSegment1_Tags:=Segmentation.Status:done|"
      "TerminologyEntry:List~SCT^91723000^Anatomical "
      "structure~SCT^10013000^Muscle~SCT^7771000^Left~Regions~SCT^68367000^"
      "Thigh~^^|\n\n";
  const LabelVolume volume = parse_label_volume(file + std::string("\1\0\1\1\0\1", 6), "p.seg.nrrd");
  ASSERT_EQ(volume.layers.size(), 2U);
  EXPECT_THAT(volume.layers[0], ElementsAre(1, 1, 0));
  EXPECT_THAT(volume.layers[1], ElementsAre(0, 1, 1));
  ASSERT_EQ(volume.segments.size(), 2U);
  EXPECT_EQ(volume.segments[1].name, "vastus");
  EXPECT_EQ(volume.segments[1].layer, 1);
  EXPECT_THAT(volume.segments[1].hints, ElementsAre("Thigh", "Muscle", "Left"));
}

TEST(LabelVolume, TellsPiecesEmptySegmentsAndMirrors) {
  const std::string names =
      "Segment0_Name:=both\nSegment0_LabelValue:=2\nSegment1_Name:=lost\nSegment1_LabelValue:=9\n";
  std::string file =
      "NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: 3 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,-1)\n"
      "encoding: raw\n" +
      names + "\n";
  // Across these edges, no tetrahedron of the surface's lattice joins two points.
  const LabelVolume volume = parse_label_volume(file + std::string("\0\2\2\2\0\0\2\0\0\0\0\0", 12), "p.nrrd");
  EXPECT_THAT(volume.notes, ElementsAre(HasSubstr("3 x 2 x 2 points"), HasSubstr("left-handed"),
                                        HasSubstr("no point of their own, left out: \"lost\""),
                                        HasSubstr("segment \"both\" is in 3 pieces of 2, 1, 1 points")));
  // Here one does, though no two share a face but the pair in the middle.
  const LabelVolume whole = parse_label_volume(file + std::string("\2\0\0\0\2\2\0\0\0\2\0\0", 12), "p.nrrd");
  EXPECT_THAT(whole.notes, Not(Contains(HasSubstr("pieces"))));
}

TEST(LabelVolume, NamesASegmentByItsLabelWhereTheFileDoesNot) {
  const LabelVolume volume = parse_label_volume(testing::nrrd_file({}), "p.nrrd");
  ASSERT_EQ(volume.segments.size(), 5U);
  EXPECT_EQ(volume.segments[2].name, "label 3");
  EXPECT_EQ(volume.segments[2].label, 3);
}

/// The phantom in the specimen frame, in two layers: the second holds the sheet and a label beyond 255.
LabelVolume two_layers() {
  LabelVolume volume = parse_label_volume(testing::nrrd_file(testing::oblique_grid()), "p.nrrd");
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
  const Lattice lattice = parse_label_volume(testing::nrrd_file(grid), "p.nrrd").lattice;
  std::vector<std::uint8_t> bytes;
  for (const int label : testing::phantom_labels(grid)) bytes.push_back(static_cast<std::uint8_t>(label * 50));
  write_scalars(folder / "s.nrrd", lattice, bytes);
  EXPECT_EQ(testing::phantom_difference(read_label_volume(folder / "s.nrrd"), 0, 50), "");
}

}  // namespace
}  // namespace myotact::prepare
