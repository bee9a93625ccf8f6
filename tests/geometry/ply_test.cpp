#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "geometry/mesh_examples.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::geometry {
namespace {

using myotact::testing::complaint;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Ply : public ::testing::Test {
 protected:
  std::string problem(const std::string& bytes) const {
    write_file(folder_ / "f.ply", bytes);
    return complaint(ExitStatus::BadData, [&] { read_ply(folder_ / "f.ply"); });
  }

  std::string example() const {
    write_ply(corner_surface(), folder_ / "e.ply");
    return read_file(folder_ / "e.ply");
  }

  myotact::testing::TemporaryFolder folder_;
};

std::string header(const std::string& body) {
  return "ply\nformat binary_little_endian 1.0\n" + body + "end_header\n";
}

const std::string kThreeFloats = "property float x\nproperty float y\nproperty float z\n";

TEST_F(Ply, AMeshComesBackBitForBit) {
  TriangleMesh mesh = corner_surface();
  mesh.positions_m[1].x() = 1.0 / 3.0;
  write_ply(mesh, folder_ / "m.ply");
  const TriangleMesh back = read_ply(folder_ / "m.ply");
  EXPECT_EQ(back.positions_m, mesh.positions_m);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST_F(Ply, FloatsAreReadAndUnknownPropertiesSkipped) {
  std::string bytes = header("comment from a scanner\nelement vertex 3\n" + kThreeFloats +
                             "property uchar red\nelement face 1\nproperty list uchar int vertex_index\n"
                             "property list uchar float texcoord\nelement edge 1\nproperty short v\n");
  for (const float x : {0.0F, 0.5F, -2.0F}) {
    for (const float shift : {0.0F, 1.0F, 2.0F}) append_bytes(bytes, x + shift);
    append_bytes(bytes, std::uint8_t{200});
  }
  append_bytes(bytes, std::uint8_t{3});
  for (const int vertex : {2, 0, 1}) append_bytes(bytes, vertex);
  append_bytes(bytes, std::uint8_t{1});
  append_bytes(bytes, 0.25F);
  append_bytes(bytes, std::int16_t{0});
  write_file(folder_ / "f.ply", bytes);
  const TriangleMesh mesh = read_ply(folder_ / "f.ply");
  ASSERT_EQ(mesh.positions_m.size(), 3u);
  EXPECT_EQ(mesh.positions_m[1], Vec3(0.5, 1.5, 2.5));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{2, 0, 1}}));
}

TEST_F(Ply, WhatIsNoPlyIsRefused) {
  EXPECT_THAT(problem(""), HasSubstr("is no PLY file"));
  EXPECT_THAT(problem("solid x\n"), HasSubstr("is no PLY file"));
  EXPECT_THAT(problem("ply\nformat binary 1.0\nend_header\n"),
              AllOf(HasSubstr("f.ply: 2:1"), HasSubstr("\"binary\""), HasSubstr("binary_big_endian")));
  EXPECT_THAT(problem("ply\nformat ascii 1.0\nend_header\n"), HasSubstr("no triangles"));
  EXPECT_THAT(problem("ply\nend_header\n"), HasSubstr("is missing"));
  EXPECT_THAT(problem(header("element vertex 0\n")), HasSubstr("no triangles"));
}

TEST_F(Ply, HeaderErrorsNameTheLine) {
  EXPECT_THAT(problem(header("element vertex -1\n")), HasSubstr("3:1"));
  EXPECT_THAT(problem(header("element vertex 99999999999\n")), HasSubstr("0 to 20000000"));
  EXPECT_THAT(problem(header("element vertex 1\nproperty quad x\n")), AllOf(HasSubstr("4:1"), HasSubstr("\"quad\"")));
  EXPECT_THAT(problem(header("property float x\n")), HasSubstr("3:1"));
  EXPECT_THAT(problem(header("element vertex 5\n")), HasSubstr("has no property"));
}

TEST_F(Ply, TruncationAndHugeCountsNameTheByte) {
  const std::string whole = example();
  for (std::size_t size = 10; size < whole.size(); size += 7) problem(whole.substr(0, size));
  EXPECT_THAT(problem(whole.substr(0, whole.size() - 1)), AllOf(HasSubstr("byte "), HasSubstr("ends early")));
  EXPECT_THAT(problem(header("element vertex 20000000\n" + kThreeFloats)), HasSubstr("ends early"));
  std::string list = header("element face 1\nproperty list uint int other\n");
  append_bytes(list, std::uint32_t{4'000'000'000U});
  EXPECT_THAT(problem(list), HasSubstr("longer than the file"));
}

TEST_F(Ply, BadValuesNameTheElement) {
  TriangleMesh mesh = corner_surface();
  mesh.triangles[2][1] = 4;
  write_ply(mesh, folder_ / "i.ply");
  EXPECT_THAT(problem(read_file(folder_ / "i.ply")), HasSubstr("face 2 names vertex 4; there are 4"));
  mesh.triangles[2][1] = -1;
  write_ply(mesh, folder_ / "i.ply");
  EXPECT_THAT(problem(read_file(folder_ / "i.ply")), HasSubstr("face 2 names vertex -1"));
  mesh = corner_surface();
  mesh.positions_m[3].y() = std::nan("");
  write_ply(mesh, folder_ / "n.ply");
  EXPECT_THAT(problem(read_file(folder_ / "n.ply")), HasSubstr("vertex 3 is not finite"));
  std::string two = example();
  two[two.find("end_header\n") + 11 + 4 * 24] = 2;
  EXPECT_THAT(problem(two), HasSubstr("a face has 2 corners; must have 3 to 10000"));
}

/// The unit square with lists, texts of colours and an element that nobody asked for.
const std::string kAsciiHeader =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty uchar red\nproperty double x\nproperty list "
    "uchar float weights\nproperty int y\nproperty float z\nelement marker 2\nproperty list int short ids\nelement "
    "face "
    "1\nproperty list uchar float texcoord\nproperty list uchar int vertex_indices\nproperty float "
    "quality\nend_header\n";
const std::string kAsciiBody =
    "9 0.1 2 .5 nan 0 1e-9\n9 1.0000000000000002 0 0 0\n9 1 1 1 1 0\n9 -100000.00000000001 0 1 0\n"
    "3 1 2 3\n0\n2 0 1 4 0 1 2 3 nan\n";

TEST_F(Ply, AsciiIsReadInDoublePrecisionAndListsAreReadOver) {
  write_file(folder_ / "a.ply", kAsciiHeader + kAsciiBody);
  const TriangleMesh mesh = read_ply(folder_ / "a.ply");
  EXPECT_EQ(mesh.positions_m, (std::vector<Vec3>{Vec3(0.1, 0, 1e-9), Vec3(1.0000000000000002, 0, 0), Vec3(1, 1, 0),
                                                 Vec3(-100000.00000000001, 1, 0)}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}}));
}

TEST_F(Ply, AsciiDefectsNameTheLine) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kAsciiHeader + kAsciiBody;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_THAT(problem(with("9 1 1 1", "9 nan 1 1")), AllOf(HasSubstr("f.ply: line 19"), HasSubstr("vertex 2")));
  EXPECT_THAT(problem(with("4 0 1 2 3", "4 0 1 2 4")), AllOf(HasSubstr("line 23"), HasSubstr("names vertex 4")));
  EXPECT_THAT(problem(with("4 0 1 2 3", "4 0 1 2.5 3")), HasSubstr("names vertex 2.5"));
  EXPECT_THAT(problem(with("9 1 1 1", "9 one 1 1")), HasSubstr("\"one\" is not a number"));
  EXPECT_THAT(problem(with(" nan\n", " nan\n7 7\n")), AllOf(HasSubstr("line 24"), HasSubstr("goes on after")));
  EXPECT_THAT(problem(with("element face 1", "element face 2")), HasSubstr("ends early"));
  EXPECT_THAT(problem(with("4 0 1 2 3", "-4 0 1 2 3")), HasSubstr("a list has -4 entries"));
  EXPECT_THAT(problem(with("marker", "vertex")), HasSubstr("stands twice"));
}

template <class T>
void append_big_endian(std::string& bytes, T value) {
  append_bytes(bytes, value);
  std::reverse(bytes.end() - static_cast<std::ptrdiff_t>(sizeof value), bytes.end());
}

TEST_F(Ply, BigEndianOfAnyScalarType) {
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty double x\nproperty short y\nproperty list uchar "
      "double extra\nproperty uint z\nelement face 1\nproperty list ushort uchar vertex_index\nend_header\n";
  for (int i = 0; i < 3; ++i) {
    append_big_endian(bytes, 1e5 + 1e-9 * i);
    append_big_endian(bytes, static_cast<std::int16_t>(-i));
    append_big_endian(bytes, static_cast<std::uint8_t>(i));
    for (int k = 0; k < i; ++k) append_big_endian(bytes, 0.5);
    append_big_endian(bytes, 4'000'000'000U);
  }
  append_big_endian(bytes, std::uint16_t{3});
  bytes += std::string("\0\1\2", 3);
  write_file(folder_ / "b.ply", bytes);
  const TriangleMesh mesh = read_ply(folder_ / "b.ply");
  EXPECT_EQ(mesh.positions_m[2], Vec3(1e5 + 2e-9, -2, 4e9));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}}));
  EXPECT_THAT(problem(bytes + "x"), AllOf(HasSubstr("byte "), HasSubstr("goes on after")));
  write_file(folder_ / "b.ply", bytes + "\n");
  EXPECT_EQ(read_ply(folder_ / "b.ply").triangles.size(), 1u);
}

}  // namespace
}  // namespace myotact::geometry
