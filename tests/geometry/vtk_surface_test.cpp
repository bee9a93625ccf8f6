#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/mesh_examples.h"
#include "geometry/parse_mesh.h"
#include "support/complaint.h"

namespace myotact::geometry {
namespace {

using myotact::testing::complaint;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Triangles = std::vector<std::array<int, 3>>;

TriangleMesh read(const std::string& bytes) {
  return parse_vtk_surface(bytes, "f.vtk").mesh;
}

std::string problem(const std::string& bytes) {
  return complaint(ExitStatus::BadData, [&] { read(bytes); });
}

std::string head(const std::string& encoding, const std::string& version = "3.0") {
  return "# vtk DataFile Version " + version + "\na title\n" + encoding + "\nDATASET POLYDATA\n";
}

const std::string kPoints = "POINTS 5 double\n0 0 0 1 0 0 1 1 0 0 1e-9 0\n100000.00000000001 0 1\n";

template <class T>
std::string big_endian(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) {
    append_bytes(bytes, value);
    std::reverse(bytes.end() - static_cast<std::ptrdiff_t>(sizeof value), bytes.end());
  }
  return bytes;
}

TEST(VtkSurface, PolygonsAndStripsOfATextFile) {
  const TriangleMesh mesh = read(head("ASCII") + kPoints +
                                 "VERTICES 1 2\n1 0\nPOLYGONS 2 9\n3 0 1 2\n4 0 1 2 3\nTRIANGLE_STRIPS 1 6\n5 0 1 2 3 "
                                 "4\nCELL_DATA 3\nSCALARS a int\nLOOKUP_TABLE default\n1 2 3\n");
  EXPECT_EQ(mesh.positions_m[3], Vec3(0, 1e-9, 0));
  EXPECT_EQ(mesh.positions_m[4], Vec3(100000.00000000001, 0, 1));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(VtkSurface, BinaryFilesAreBigEndian) {
  const std::string bytes = head("BINARY") + "POINTS 4 double\n" +
                            big_endian({0.0, 0.0, 0.0, 1e-9, 0.0, 0.0, 0.0, 100000.00000000001, 0.0, 0.0, 0.0, 1.0}) +
                            "\nPOLYGONS 1 4\n" + big_endian({3, 0, 1, 2}) + "\nTRIANGLE_STRIPS 1 5\n" +
                            big_endian({4, 0, 1, 2, 3}) + "\nPOINT_DATA 4\n";
  const TriangleMesh mesh = read(bytes);
  EXPECT_EQ(mesh.positions_m,
            (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1e-9, 0, 0), Vec3(0, 100000.00000000001, 0), Vec3(0, 0, 1)}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 1, 2}, {1, 3, 2}}));
  const std::size_t end = bytes.find("\nPOINT_DATA");
  for (std::size_t size = bytes.find("POINTS") + 16; size < end; size += 5) {
    if (size >= bytes.find("\nTRIANGLE") && size <= bytes.find("\nTRIANGLE") + 1) continue;
    EXPECT_THAT(problem(bytes.substr(0, size)), HasSubstr("f.vtk: byte ")) << size;
  }
  std::string spoilt = bytes;
  spoilt[bytes.find("POLYGONS 1 4\n") + 13 + 15] = 4;
  EXPECT_THAT(problem(spoilt), AllOf(HasSubstr("f.vtk: byte "), HasSubstr("4 must be a whole number from 0 to 3")));
}

TEST(VtkSurface, FloatsAndFieldsOfABinaryFile) {
  const TriangleMesh mesh = read(head("BINARY") + "FIELD FieldData 1\nTimeValue 1 2 double\n" + big_endian({0.5, 1.5}) +
                                 "\nPOINTS 3 float\n" + big_endian({0.F, 0.F, 0.F, .5F, 0.F, 0.F, 0.F, -2.F, 0.F}) +
                                 "\nMETADATA\nINFORMATION 0\n\nPOLYGONS 1 4\n" + big_endian({3, 2, 1, 0}));
  EXPECT_EQ(mesh.positions_m[2], Vec3(0, -2, 0));
  EXPECT_EQ(mesh.triangles, (Triangles{{2, 1, 0}}));
}

TEST(VtkSurface, OffsetsOfVersionFive) {
  const Triangles expected = {{0, 1, 2}, {0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(read(head("ASCII", "5.1") + kPoints +
                 "POLYGONS 3 7\nOFFSETS vtktypeint64\n0 3 7\nCONNECTIVITY vtktypeint64\n0 1 2 0 1 2 3\n")
                .triangles,
            expected);
  const std::string points =
      "POINTS 4 float\n" + big_endian({0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F, 0.F, 1.F, 0.F});
  EXPECT_EQ(read(head("BINARY", "5.1") + points + "\nPOLYGONS 3 7\nOFFSETS vtktypeint64\n" +
                 big_endian<std::int64_t>({0, 3, 7}) + "\nCONNECTIVITY vtktypeint64\n" +
                 big_endian<std::int64_t>({0, 1, 2, 0, 1, 2, 3}))
                .triangles,
            expected);
  EXPECT_THAT(problem(head("ASCII", "5.1") + kPoints + "POLYGONS 2 4\nOFFSETS vtktypeint64\n0 3\n"),
              HasSubstr("the last offset is 3; must be 4"));
  EXPECT_THAT(problem(head("ASCII", "5.1") + kPoints + "POLYGONS 3 4\nOFFSETS vtktypeint64\n0 4 3\n"),
              HasSubstr("3 must be a whole number from 4 to 4"));
}

TEST(VtkSurface, TheBoundaryOfATetGridOnlyWithItsNodes) {
  TetFile file = two_tets();
  file.mesh.nodes_m.insert(file.mesh.nodes_m.begin(), Vec3(9, 9, 9));  // of no tet
  for (auto& tet : file.mesh.corners) {
    for (int& node : tet) ++node;
  }
  const SurfaceFile surface = boundary_surface(file, "f.vtk");
  EXPECT_EQ(surface.mesh.positions_m, two_tets().mesh.nodes_m);
  EXPECT_EQ(surface.mesh.triangles.size(), 6u);
  EXPECT_EQ(bad_edge_count(surface.mesh), 0);
  EXPECT_NEAR(enclosed_volume_m3(surface.mesh), total_volume_m3(file.mesh), 1e-15);
  EXPECT_THAT(surface.notes, ::testing::IsEmpty());
  std::swap(file.mesh.corners[0][0], file.mesh.corners[0][1]);
  EXPECT_THAT(boundary_surface(file, "f.vtk").notes,
              ::testing::ElementsAre(HasSubstr("1 of its 2 tets are inside out")));
}

TEST(VtkSurface, DefectsNameFileLineValueAndRange) {
  EXPECT_THAT(problem(""), HasSubstr("f.vtk: line 1: is no legacy VTK"));
  EXPECT_THAT(problem(head("BASE64")), AllOf(HasSubstr("line 3"), HasSubstr("ASCII or BINARY")));
  EXPECT_THAT(problem("# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("POLYDATA or UNSTRUCTURED_GRID")));
  EXPECT_THAT(problem(head("ASCII") + kPoints), HasSubstr("holds no triangles"));
  EXPECT_THAT(problem(head("ASCII") + kPoints + "POLYGONS 1 4\n3 0 1 5\n"),
              AllOf(HasSubstr("line 9"), HasSubstr("from 0 to 4")));
  EXPECT_THAT(problem(head("ASCII") + kPoints + "POLYGONS 1 5\n3 0 1 2\n"), HasSubstr("1 cells do not take 5 numbers"));
  EXPECT_THAT(problem(head("ASCII") + kPoints + "POLYGONS 2 5\n3 0 1 2\n3 0 1 2\n"), HasSubstr("do not take 5"));
  EXPECT_THAT(problem(head("ASCII") + kPoints + "POLYGONS 1 3\n2 0 1\n"), HasSubstr("2 corners; must have 3"));
  EXPECT_THAT(problem(head("ASCII") + kPoints + "POLYGONS 1 4\n3 0 1\n"), HasSubstr("ends early"));
  EXPECT_THAT(problem(head("ASCII") + "POINTS 1 double\n0 nan 0\n"), AllOf(HasSubstr("line 6"), HasSubstr("finite")));
  EXPECT_THAT(problem(head("ASCII") + "POINTS 1 bit\n0\n"), HasSubstr("\"bit\""));
  EXPECT_THAT(problem(head("ASCII") + kPoints + kPoints), HasSubstr("stands twice"));
  EXPECT_THAT(problem(head("ASCII") + "HEXAHEDRA\n"), HasSubstr("begins no section"));
}

}  // namespace
}  // namespace myotact::geometry
