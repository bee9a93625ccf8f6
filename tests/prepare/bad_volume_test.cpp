#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "prepare/phantom_files.h"
#include "prepare/volume/dicom.h"
#include "prepare/volume/read_label_volume.h"
#include "prepare/volume/write_label_volume.h"
#include "support/temporary_folder.h"

// What is wrong with a volume is said with file, field, value, what is allowed and a remedy.

namespace myotact::prepare {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// What the reader says of a file.
std::string complaint(const std::string& bytes, const std::string& name) {
  try {
    parse_label_volume(bytes, name);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), StartsWith(name));
    return error.what();
  }
  return "nothing";
}

/// The text with the first `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

std::string nrrd() {
  return testing::nrrd_file({});
}

std::string complaint_of_nrrd(const std::string& from, const std::string& to) {
  return complaint(with(nrrd(), from, to), "p.nrrd");
}

const std::string kDirections = "space directions: (1.9,0,0) (0,1.9,0) (0,0,1.9)";

TEST(BadVolume, NrrdFields) {
  EXPECT_THAT(complaint_of_nrrd("NRRD0004", "NRRD0009"), HasSubstr("must be NRRD0001 .. NRRD0005"));
  EXPECT_THAT(complaint_of_nrrd("type: uint8", "type: block"), HasSubstr("type: \"block\" is no type"));
  EXPECT_THAT(complaint_of_nrrd("type: uint8", "type: float"), AllOf(HasSubstr("type"), HasSubstr("integer labels")));
  EXPECT_THAT(complaint_of_nrrd("dimension: 3", "dimension: 5"), HasSubstr("dimension: is 5; must be 3"));
  EXPECT_THAT(complaint_of_nrrd("sizes: 20", "sizes: 0"), HasSubstr("sizes: holds the size 0"));
  EXPECT_THAT(complaint_of_nrrd("sizes: 20 22 21", "sizes: 20 22"), HasSubstr("holds 2 values"));
  EXPECT_THAT(complaint_of_nrrd("sizes: 20", "sizes: x"), HasSubstr("\"x\" is no whole number"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding: bzip2"), HasSubstr("must be raw or gzip"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encodng: raw"), HasSubstr("the nearest is \"encoding\""));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw\n", ""), HasSubstr("encoding: is missing"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "type: int"), HasSubstr("for the second time"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding raw"), HasSubstr("line 7"));
  EXPECT_THAT(complaint_of_nrrd("left-posterior-superior", "3D-left-handed"), HasSubstr("space: "));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding: raw\nspace units: \"mm\" \"mm\" \"ft\""),
              HasSubstr("\"ft\""));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding: raw\nkinds: RGB-color domain domain"),
              HasSubstr("RGB-color"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding: raw\ndata file: ../p.raw"),
              HasSubstr("names another file"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding: raw\nbyte skip: 99999"), HasSubstr("byte skip: is 99999"));
  EXPECT_THAT(complaint_of_nrrd("encoding: raw", "encoding: raw\nSegment0_LabelValue:=-4"),
              HasSubstr("Segment0_LabelValue: is -4; must be 0 .. 65535"));
  EXPECT_EQ(complaint_of_nrrd("left-posterior-superior", "3D-right-handed"), "nothing");
}

TEST(BadVolume, TooManyPointsAreRefusedBeforeMemoryIsTaken) {
  EXPECT_THAT(complaint_of_nrrd("sizes: 20 22 21", "sizes: 2048 1024 1024"),
              AllOf(HasSubstr("at most 2147483647"), HasSubstr("Crop")));
  EXPECT_THAT(complaint_of_nrrd("sizes: 20 22 21", "sizes: 4000000000 4000000000 4000000000"), HasSubstr("at most"));
  EXPECT_THAT(complaint_of_nrrd("sizes: 20 22 21", "sizes: 2048 1024 1023"),
              HasSubstr("its header asks for 2145386496"));
  EXPECT_THAT(complaint(with(with(nrrd(), "sizes: 20 22 21", "sizes: 2048 1024 1023"), "raw", "gzip"), "p.nrrd"),
              HasSubstr("its header asks for 2145386496"));
}

TEST(BadVolume, Places) {
  const auto of_directions = [](const std::string& to) { return complaint_of_nrrd(kDirections, to); };
  EXPECT_THAT(of_directions("space directions: (0,0,0) (0,1.9,0) (0,0,1.9)"),
              HasSubstr("along axis 0 is (0, 0, 0), 0 mm"));
  EXPECT_THAT(of_directions("space directions: (1e-5,0,0) (0,1.9,0) (0,0,1.9)"), HasSubstr("must be 0.001 .. 100 mm"));
  EXPECT_THAT(of_directions("space directions: (nan,0,0) (0,1.9,0) (0,0,1.9)"), HasSubstr("axis 0"));
  EXPECT_THAT(of_directions("space directions: (1.9,0,0) (0.01,1.9,0) (0,0,1.9)"),
              AllOf(HasSubstr("axes 0 and 1 meet at 89.70 degrees"), HasSubstr("Resample")));
  EXPECT_THAT(of_directions("space directions: none (0,1.9,0) (0,0,1.9)"), HasSubstr("axis 0 has none"));
  EXPECT_THAT(of_directions("space directions: (1.9,0) (0,1.9,0) (0,0,1.9)"), HasSubstr("holds 2 values"));
  EXPECT_THAT(of_directions("spacings: 1 -1 1"), HasSubstr("spacings: \"1 -1 1\" must be above zero"));
  EXPECT_THAT(of_directions("spacings: 1 0 1"), HasSubstr("must be above zero"));
  EXPECT_THAT(complaint_of_nrrd("space origin: (0.13", "space origin: (-9e9"), HasSubstr("origin: is"));
}

TEST(BadVolume, NumbersThatAreNoLabels) {
  const testing::FileNumbers shorts{2, true, false};
  std::string file = testing::nrrd_file({}, "LPS", Vec3::Ones(), shorts);
  file.replace(file.size() - 2, 2, "\xff\xff");
  EXPECT_THAT(complaint(file, "p.nrrd"), HasSubstr("point (19, 21, 20): has the label -1; must be 0 .. 65535"));
  file = testing::nrrd_file({}, "LPS", Vec3::Ones(), {8, false, true});
  file.replace(file.size() - 8, 8, std::string("\x80\0\0\0\0\0\0\0", 8));
  EXPECT_THAT(complaint(file, "p.nrrd"), HasSubstr("has the label 9223372036854775808"));
}

TEST(BadVolume, AnImageInPlaceOfASegmentation) {
  std::string file = testing::nrrd_file({}, "LPS", Vec3::Ones(), {2, false, false});
  for (std::size_t byte = file.size() - 2 * 9240, number = 0; byte < file.size(); byte += 2, ++number) {
    file[byte] = static_cast<char>(number % 256);
    file[byte + 1] = static_cast<char>(number / 256);
  }
  EXPECT_THAT(complaint(file, "p.nrrd"), HasSubstr("holds 9239 labels; must be 1 .. 1000"));
}

TEST(BadVolume, DataThatDoNotFit) {
  const std::string whole = nrrd();
  EXPECT_THAT(complaint(whole.substr(0, whole.size() - 1), "p.nrrd"),
              AllOf(HasSubstr("holds at most 9239 bytes"), HasSubstr("asks for 9240")));
  EXPECT_THAT(complaint(whole + "x", "p.nrrd"), HasSubstr("holds more than the 9240 bytes"));
  std::string empty = whole;
  std::fill(empty.end() - 9240, empty.end(), '\0');
  EXPECT_THAT(complaint(empty, "p.nrrd"), HasSubstr("holds no segment: every point is 0"));
}

TEST(BadVolume, GzipThatIsCutOrDamaged) {
  const std::string head = with(nrrd(), "raw", "gzip").substr(0, nrrd().size() - 9240 + 1);
  const std::string data = testing::gzip(testing::number_bytes({}, {}));
  ASSERT_EQ(complaint(head + data, "p.nrrd"), "nothing");
  for (const std::size_t kept : {std::size_t{30}, data.size() / 2, data.size() - 1}) {
    EXPECT_THAT(complaint(head + data.substr(0, kept), "p.nrrd"), HasSubstr("cut off")) << kept;
  }
  std::string damaged = data;
  damaged[damaged.size() - 6] ^= 1;  // the checksum
  EXPECT_THAT(complaint(head + damaged, "p.nrrd"), HasSubstr("is damaged"));
  EXPECT_THAT(complaint(head + std::string(500, 'x'), "p.nrrd"), HasSubstr("no gzip"));
  EXPECT_THAT(complaint(head + data + "more", "p.nrrd"), HasSubstr("further bytes"));
  EXPECT_THAT(complaint(head + testing::gzip(testing::number_bytes({}, {2, false, false})), "p.nrrd"),
              HasSubstr("holds more"));
  const std::string half = testing::number_bytes({}, {}).substr(0, 4000);
  const std::string rest = testing::number_bytes({}, {}).substr(4000);
  EXPECT_EQ(complaint(head + testing::gzip(half) + testing::gzip(rest), "p.nrrd"), "nothing");  // two members
}

/// A NIfTI-1 header with bytes replaced.
std::string complaint_of_nifti(std::size_t place, const std::string& bytes) {
  std::string file = testing::nifti_file({}, 1, testing::NiftiPlaces::Quaternion);
  return complaint(file.replace(place, bytes.size(), bytes), "p.nii");
}

TEST(BadVolume, NiftiFields) {
  const std::string one_and_half("\0\0\xc0\x3f", 4), minus_one("\0\0\x80\xbf", 4), nan("\0\0\xc0\x7f", 4);
  EXPECT_THAT(complaint("", "p.nii"), HasSubstr("shorter than 4 bytes"));
  EXPECT_THAT(complaint_of_nifti(0, "abcd"), HasSubstr("sizeof_hdr"));
  EXPECT_THAT(complaint(testing::nifti_file({}, 1, testing::NiftiPlaces::Affine).substr(0, 300), "p.nii"),
              HasSubstr("cut off"));
  EXPECT_THAT(complaint_of_nifti(344, "ni1"), HasSubstr(".img file beside it"));
  EXPECT_THAT(complaint_of_nifti(344, std::string(4, '\0')), HasSubstr("magic"));
  EXPECT_THAT(complaint_of_nifti(40, std::string("\2\0", 2)), HasSubstr("dim: states 2 axes"));
  EXPECT_THAT(complaint_of_nifti(40, std::string("\4\0\5\0\5\0\5\0\7\0", 10)), HasSubstr("7 volumes along axis 4"));
  EXPECT_THAT(complaint_of_nifti(42, std::string("\xff\xff", 2)), HasSubstr("dim: holds the size -1"));
  EXPECT_THAT(complaint_of_nifti(70, std::string("\x80\0", 2)), HasSubstr("datatype: is 128"));
  EXPECT_THAT(complaint_of_nifti(70, std::string("\x10\0\x20\0", 4)), HasSubstr("floating-point"));
  EXPECT_THAT(complaint_of_nifti(72, std::string("\x10\0", 2)), HasSubstr("bitpix: is 16; must be 8"));
  EXPECT_THAT(complaint_of_nifti(80, minus_one), HasSubstr("pixdim: holds the spacings -1"));
  EXPECT_THAT(complaint_of_nifti(80, nan), HasSubstr("pixdim"));
  EXPECT_THAT(complaint_of_nifti(108, minus_one), HasSubstr("vox_offset: is -1"));
  EXPECT_THAT(complaint_of_nifti(112, one_and_half), HasSubstr("scl_slope, scl_inter: are 1.5 and 0"));
  EXPECT_THAT(complaint_of_nifti(123, "\7"), HasSubstr("xyzt_units: is 7"));
  EXPECT_THAT(complaint_of_nifti(256, nan), HasSubstr("pixdim"));
  EXPECT_THAT(complaint_of_nifti(254, std::string("\1\0", 2)), HasSubstr("srow: the step along axis 0 is"));
}

TEST(BadVolume, MetaImageFields) {
  const auto of = [](const std::string& from, const std::string& to) {
    return complaint(with(testing::meta_image_file({}), from, to), "p.mha");
  };
  EXPECT_THAT(complaint("no picture", "p.mha"), HasSubstr("line 1"));
  EXPECT_THAT(of("NDims = 3", "NDims = 2"), HasSubstr("NDims: \"2\" must be 3"));
  EXPECT_THAT(of("BinaryData = True", "BinaryData = False"), HasSubstr("BinaryData"));
  EXPECT_THAT(of("MET_UCHAR", "MET_FLOAT"), HasSubstr("floating-point"));
  EXPECT_THAT(of("MET_UCHAR", "MET_STRING"), HasSubstr("ElementType: \"MET_STRING\""));
  EXPECT_THAT(of("ElementSpacing = 1.9", "ElementSpacing = 0"),
              HasSubstr("ElementSpacing: \"0 1.9 1.9\" must be above"));
  EXPECT_THAT(of("TransformMatrix = 1", "TransformMatrix = 2"), HasSubstr("axis 0 is 2 long; must be 1"));
  EXPECT_THAT(of("CompressedData = False", "CompressedData = maybe"), HasSubstr("must be True or False"));
  EXPECT_THAT(of("ElementDataFile = LOCAL", "ElementDataFile = LIST"), HasSubstr("names another file"));
  EXPECT_THAT(of("ElementDataFile = LOCAL", "Comment = x"), HasSubstr("line"));
  EXPECT_THAT(of("DimSize = 20", "DimSize = 21"), HasSubstr("its header asks for 9702"));
}

TEST(BadVolume, DataFilesLieBesideTheHeader) {
  const testing::TemporaryFolder folder;
  const auto says = [&](const std::string& data) {
    write_file(folder / "p.mhd", testing::meta_image_file({}, {}, false, data));
    try {
      read_label_volume(folder / "p.mhd");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  for (const char* elsewhere : {"/etc/passwd", "../p.raw", "..", "a\\b"}) {
    EXPECT_THAT(says(elsewhere), HasSubstr("in the header's own folder")) << elsewhere;
  }
  EXPECT_THAT(says("slice%03d.raw"), HasSubstr("names several files"));
  EXPECT_THAT(says("LIST"), HasSubstr("names several files"));
  EXPECT_THAT(says("lost.raw"), HasSubstr("lost.raw: cannot be opened"));
}

TEST(BadVolume, DicomIsNamedWithWhatConvertsIt) {
  const testing::TemporaryFolder folder;
  const auto says = [](const std::filesystem::path& path) {
    try {
      refuse_dicom(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  EXPECT_EQ(says(folder.path()), "nothing");
  write_file(folder / "IM000001", std::string(128, '\0') + "DICM and so on");
  EXPECT_THAT(says(folder.path()),
              AllOf(HasSubstr("folder of DICOM files"), HasSubstr("3D Slicer"), HasSubstr("dcm2niix")));
  EXPECT_THAT(says(folder / "IM000001"), HasSubstr("is a DICOM file"));
  EXPECT_THAT(says(folder / "not_there.dcm"), HasSubstr("is a DICOM file"));
}

TEST(BadVolume, OtherNamesAndFilesThatAreNotThere) {
  EXPECT_TRUE(is_label_volume("a/Limb.SEG.NRRD"));
  EXPECT_TRUE(is_label_volume("limb.nii.gz"));
  EXPECT_FALSE(is_label_volume("limb.stl"));
  EXPECT_FALSE(is_label_volume("limb.gz"));
  EXPECT_THAT(complaint("x", "p.mgz"), HasSubstr("must end with one of .nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd"));
  EXPECT_THROW(read_label_volume("/not/there.nrrd"), Error);
  const testing::TemporaryFolder folder;
  EXPECT_THROW(write_label_volume(folder.path() / "no" / "folder.nrrd", parse_label_volume(nrrd(), "p.nrrd")), Error);
}

}  // namespace
}  // namespace myotact::prepare
