#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/parse_mesh.h"
#include "support/complaint.h"

namespace myotact::geometry {
namespace {

using myotact::testing::complaint;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Triangles = std::vector<std::array<int, 3>>;

TriangleMesh obj(const std::string& text) {
  const SurfaceFile surface = parse_obj(text, "f.obj");
  EXPECT_THAT(surface.notes, IsEmpty());
  return surface.mesh;
}

std::string obj_problem(const std::string& text) {
  return complaint(ExitStatus::BadData, [&] { parse_obj(text, "f.obj"); });
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, CornersMayNameTexturesAndNormalsAndCountBackwards) {
  const Triangles expected = {{0, 1, 2}};
  EXPECT_EQ(obj(kSquare + "f 1 2 3\n").triangles, expected);
  EXPECT_EQ(obj(kSquare + "vt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1\n").triangles, expected);
  EXPECT_EQ(obj(kSquare + "f -4/-1 -3 -2//-1\n").triangles, expected);
  EXPECT_EQ(obj("v 9 9 9\n" + kSquare + "f -4 -3 -2\n").triangles, (Triangles{{1, 2, 3}}));
}

TEST(Obj, WeightsAndColoursAreReadOver) {
  const TriangleMesh mesh = obj("v 1 2 3 0.5 0.25 0.125\nv +4 5 6 1.0\nv 7 8 9 1 .1 .2 .3\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions_m, (std::vector<Vec3>{Vec3(1, 2, 3), Vec3(4, 5, 6), Vec3(7, 8, 9)}));
}

TEST(Obj, GroupsCommentsLinesThatGoOnAndWindowsEndsAreReadOver) {
  const TriangleMesh mesh =
      obj("# C:\\models\\\nmtllib a.mtl\r\no bone#1\r\n\r\n\tv 0 0 0 # first\r\nv 1 \\\r\n 0 \\\n0\nv 0 1 0\ng a "
          "b\nusemtl x\ns "
          "off\nf 1 \\\n2 3\nl 1 2\np 1\n");
  EXPECT_EQ(mesh.positions_m, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(Obj, PolygonsAreCutWithoutOverlap) {
  EXPECT_EQ(obj(kSquare + "f 1 2 3 4\n").triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  const TriangleMesh arrow = obj("v 0 0 0\nv 2 -1 0\nv .5 0 0\nv 2 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(surface_area_m2(arrow), 0.5);  // a fan of the second corner would cover 1.75
  EXPECT_EQ(surface_area_m2(obj("v 0 0 0\nv 2 -1 0\nv .5 0 0\nv 2 1 0\nf 2 3 4 1\n")), 0.5);
}

TEST(Obj, FacesThatAreDegenerateAreKept) {
  EXPECT_EQ(obj(kSquare + "f 1 1 2\nf 1 2 3\nf 1 2 3\n").triangles, (Triangles{{0, 0, 1}, {0, 1, 2}, {0, 1, 2}}));
}

TEST(Obj, DoublesComeBackExactly) {
  const TriangleMesh mesh =
      obj("v 1e-9 1.0000000000000002e-9 0\nv 100000.00000000001 1e5 -100000.00000000003\nv 0 .1 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.positions_m[0], Vec3(1e-9, 1.0000000000000002e-9, 0));
  EXPECT_EQ(mesh.positions_m[1], Vec3(100000.00000000001, 1e5, -100000.00000000003));
}

TEST(Obj, DefectsNameFileLineValueAndRange) {
  EXPECT_THAT(obj_problem(kSquare + "f 1 2 5\n"),
              AllOf(HasSubstr("f.obj: line 5"), HasSubstr("vertex 5"), HasSubstr("1 to 4")));
  EXPECT_THAT(obj_problem(kSquare + "f 1 2 0\n"), HasSubstr("names vertex 0"));
  EXPECT_THAT(obj_problem(kSquare + "f 1 2 -5\n"), HasSubstr("names vertex -5"));
  EXPECT_THAT(obj_problem(kSquare + "f 1 2 3.5\n"), HasSubstr("whole number"));
  EXPECT_THAT(obj_problem(kSquare + "f 1 2 /3\n"), HasSubstr("\"\" is no finite number"));
  EXPECT_THAT(obj_problem(kSquare + "f 1 2\n"), AllOf(HasSubstr("line 5"), HasSubstr("2 corners; must have 3")));
  EXPECT_THAT(obj_problem("v 0 0\n"), AllOf(HasSubstr("line 1"), HasSubstr("2 numbers")));
  EXPECT_THAT(obj_problem("\nv 0 nan 0\n"), AllOf(HasSubstr("line 2"), HasSubstr("\"nan\"")));
  EXPECT_THAT(obj_problem("v 0 0 1.#INF\n"), HasSubstr("\"1.#INF\""));  // "#" within a word begins no comment
  EXPECT_THAT(obj_problem("v 0 0 0,5\n"), HasSubstr("\"0,5\""));
  EXPECT_THAT(obj_problem("w 0 0 0\n"), HasSubstr("\"w\" begins no line"));
  EXPECT_THAT(obj_problem(""), HasSubstr("holds no triangles"));
  EXPECT_THAT(obj_problem(kSquare), HasSubstr("holds no triangles"));
  EXPECT_THAT(obj_problem("# " + std::string(2'000'000, 'x') + "\n"), HasSubstr("2000002 bytes; at most"));
}

TEST(Obj, NotesSayWhatAPersonShouldKnow) {
  EXPECT_THAT(parse_obj(kSquare + "f 1 2 3", "f.obj").notes, ::testing::ElementsAre(HasSubstr("cut short")));
  const auto crossed = parse_obj("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\n", "f.obj");
  EXPECT_THAT(crossed.notes, ::testing::ElementsAre(HasSubstr("1 of its faces cross themselves")));
}

TriangleMesh off(const std::string& text) {
  return parse_off(text, "f.off").mesh;
}

std::string off_problem(const std::string& text) {
  return complaint(ExitStatus::BadData, [&] { parse_off(text, "f.off"); });
}

TEST(Off, CountsMayStandInEitherLine) {
  for (const std::string head : {"OFF\n3 1 0\n", "OFF 3 1 0\r\n", "# by hand\nOFF # mesh\n\n# counts\n 3 1\n"}) {
    const TriangleMesh mesh = off(head + "0 0 0\n1 0 0 # second\n\n0 1e-9 100000.00000000001\n3 0 1 2\n");
    EXPECT_EQ(mesh.positions_m, (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1e-9, 100000.00000000001)}));
    EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  }
}

TEST(Off, ColoursNormalsAndTexturesAreReadOver) {
  EXPECT_EQ(off("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 0.5 0.5 0.5\n").positions_m[1],
            Vec3(1, 0, 0));
  EXPECT_EQ(off("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n").triangles.size(), 1u);
  EXPECT_EQ(off("STOFF\n3 1 0\n0 0 0 0 1\n1 0 0 0 1\n0 1 0 1 1\n3 0 1 2 7\n").triangles.size(), 1u);
  EXPECT_EQ(off("OFF\n4 1 0\n0 0 0\n2 -1 0\n.5 0 0\n2 1 0\n4 1 2 3 0\n").triangles, (Triangles{{2, 3, 0}, {1, 2, 0}}));
}

TEST(Off, DefectsNameFileLineValueAndRange) {
  const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(off_problem(""), HasSubstr("f.off: line 1"));
  EXPECT_THAT(off_problem("4OFF\n"), AllOf(HasSubstr("\"4OFF\""), HasSubstr("STOFF")));
  EXPECT_THAT(off_problem("OFF BINARY\n"), HasSubstr("write it as text"));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n" + corners + "3 0 1 3\n"),
              AllOf(HasSubstr("line 6"), HasSubstr("from 0 to 2")));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n" + corners + "3 0 1 -1\n"), HasSubstr("-1 must be"));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n" + corners + "4 0 1 2\n"), HasSubstr("of 4 corners has 3 numbers"));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n" + corners + "2 0 1 0\n"), HasSubstr("from 3 to 10000"));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n" + corners), HasSubstr("ends early"));
  EXPECT_THAT(off_problem("OFF\n2 1 0\n" + corners + "3 0 1 2\n"), AllOf(HasSubstr("line 5")));
  EXPECT_THAT(off_problem("OFF\n4 1 0\n" + corners + "3 0 1 2\n"), HasSubstr("ends early"));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n" + corners + "3 0 1 2\n3 0 2 1\n"),
              AllOf(HasSubstr("line 7"), HasSubstr("goes on")));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n0 0 inf\n"), AllOf(HasSubstr("line 3"), HasSubstr("\"inf\"")));
  EXPECT_THAT(off_problem("OFF\n3 1 0\n0 0 1.#QNAN\n"), HasSubstr("\"1.#QNAN\""));
  EXPECT_THAT(off_problem("NOFF\n3 1 0\n0 0 0\n"), HasSubstr("at least 6"));
  EXPECT_THAT(off_problem("OFF\n3000000000 1 0\n"), HasSubstr("20000000"));
}

}  // namespace
}  // namespace myotact::geometry
