#include <cctype>
#include <limits>

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

class Stl : public ::testing::Test {
 protected:
  TriangleMesh read(const std::string& bytes) const {
    write_file(folder_ / "f.stl", bytes);
    return read_stl(folder_ / "f.stl");
  }

  std::string problem(const std::string& bytes) const {
    return complaint(ExitStatus::BadData, [&] { read(bytes); });
  }

  myotact::testing::TemporaryFolder folder_;
};

/// Its triangles when the corners are numbered as they appear.
std::vector<std::array<int, 3>> corner_surface_by_corners() {
  return {{0, 1, 2}, {0, 2, 3}, {2, 1, 3}, {0, 3, 1}};
}

TEST_F(Stl, BinaryCornersAreWeldedIntoAClosedSurface) {
  const TriangleMesh mesh = read(binary_stl(corner_surface()));
  EXPECT_EQ(mesh.positions_m, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1)}));
  EXPECT_EQ(mesh.triangles, corner_surface_by_corners());
  EXPECT_EQ(bad_edge_count(mesh), 0);
  EXPECT_NEAR(enclosed_volume_m3(mesh), 1.0 / 6.0, 1e-15);
}

TEST_F(Stl, ABinaryFileWhoseTitleSaysSolidIsStillBinary) {
  EXPECT_EQ(read(binary_stl(corner_surface(), "solid exported by a scanner")).triangles.size(), 4u);
}

TEST_F(Stl, NegativeZeroIsZero) {
  TriangleMesh mesh = corner_surface();
  mesh.positions_m.emplace_back(-0.0, 0.0, -0.0);
  mesh.triangles[3][0] = 4;
  EXPECT_EQ(read(binary_stl(mesh)).positions_m.size(), 4u);
}

TEST_F(Stl, AsciiIsReadInDoublePrecision) {
  const TriangleMesh mesh = read(ascii_stl());
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.positions_m[1], Vec3(1.5, 0.0, 0.0));
  std::string fine = ascii_stl();
  fine.replace(fine.find("+1.5e0"), 6, "0.12345678901234567");
  EXPECT_EQ(read(fine).positions_m[1].x(), 0.12345678901234567);
}

TEST_F(Stl, LinesMayEndAsOnWindows) {
  std::string text;
  for (const char c : ascii_stl()) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(read(text).triangles.size(), 1u);
}

TEST_F(Stl, ASizeThatDoesNotFitTheHeaderIsRefused) {
  const std::string whole = binary_stl(corner_surface());
  EXPECT_THAT(problem(whole.substr(0, whole.size() - 1)), AllOf(HasSubstr("4 facets"), HasSubstr("284 bytes")));
  std::string huge = whole;
  const std::uint32_t most = std::numeric_limits<std::uint32_t>::max();
  std::memcpy(huge.data() + 80, &most, sizeof most);
  EXPECT_THAT(problem(huge), HasSubstr("4294967295 facets"));
  EXPECT_THAT(problem(""), HasSubstr("is no STL"));
  EXPECT_THAT(problem("ply\n"), HasSubstr("is no STL"));
  EXPECT_THAT(problem(binary_stl({})), HasSubstr("no triangles"));
}

TEST_F(Stl, AWrongCountIsNotedWhereTheSizeIsThatOfWholeFacets) {
  std::string bytes = binary_stl(corner_surface());
  bytes[80] = 3;
  write_file(folder_ / "n.stl", bytes);
  const SurfaceFile surface = read_surface(folder_ / "n.stl");
  EXPECT_EQ(surface.mesh.triangles, corner_surface_by_corners());
  ASSERT_EQ(surface.notes.size(), 1u);
  EXPECT_THAT(surface.notes[0], HasSubstr("announces 3 facets, the file holds 4"));
  EXPECT_THAT(problem(bytes), HasSubstr("3 facets (234 bytes), the file has 284"));  // read_stl() returns no notes
  for (const std::string& misfit : {bytes + "x", bytes.substr(0, 283), bytes.substr(0, 60)}) {
    write_file(folder_ / "n.stl", misfit);
    EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_surface(folder_ / "n.stl"); }),
                AllOf(HasSubstr("n.stl: byte "), HasSubstr("is no STL")));
  }
}

TEST_F(Stl, ABinaryFileThatSaysSolidAndHasAWrongCountIsStillBinary) {
  std::string bytes = binary_stl(corner_surface(), "solid made by a scanner");
  bytes[80] = 9;
  write_file(folder_ / "n.stl", bytes);
  EXPECT_EQ(read_surface(folder_ / "n.stl").mesh.triangles.size(), 4u);
}

TEST_F(Stl, SeveralSolidsAreOneSurfaceAndCapitalsAreTheSame) {
  std::string second = ascii_stl();
  second.replace(second.find("+1.5e0"), 6, "-3");
  for (char& c : second) c = static_cast<char>(std::toupper(c));
  const TriangleMesh mesh = read(ascii_stl() + second);
  EXPECT_EQ(mesh.positions_m, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1.5, 0, 0), Vec3(0, 2, 0), Vec3(-3, 0, 0)}));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 3, 2}}));
}

TEST_F(Stl, CornersThatAreNotFiniteAreRefused) {
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    TriangleMesh mesh = corner_surface();
    mesh.positions_m[3].z() = bad;
    EXPECT_THAT(problem(binary_stl(mesh)), AllOf(HasSubstr("facet 1"), HasSubstr("not finite")));
  }
  std::string text = ascii_stl();
  text.replace(text.find("vertex 0 2 0"), 12, "vertex 0 nan 0");
  EXPECT_THAT(problem(text), HasSubstr("6:1: must be \"vertex X Y Z\""));
}

TEST_F(Stl, BrokenAsciiNamesTheLine) {
  const std::string text = ascii_stl();
  EXPECT_THAT(problem(text.substr(0, text.find("endfacet"))), HasSubstr("cut off"));
  EXPECT_THAT(problem(text.substr(0, text.find("endsolid"))), HasSubstr("cut off"));
  EXPECT_THAT(problem("solid x\nfacet\nvertex 0 0 0\nendfacet\nendsolid\n"), HasSubstr("4:1: a facet has fewer"));
  EXPECT_THAT(problem("solid x\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nvertex 1 1 1\n"),
              HasSubstr("5:1: a facet has more"));
  EXPECT_THAT(problem("solid x\nfacet\nvertex 0 0 0\nfacet\n"), HasSubstr("4:1: a facet begins before"));
  EXPECT_THAT(problem("solid x\nnonsense\nendsolid\n"), HasSubstr("2:1: is no line of an STL"));
  EXPECT_THAT(problem("solid x\nvertex 0 0\n"), HasSubstr("2:1"));
}

}  // namespace
}  // namespace myotact::geometry
