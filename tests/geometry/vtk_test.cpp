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

class Vtk : public ::testing::Test {
 protected:
  void SetUp() override {
    write_vtk(two_tets(), folder_ / "e.vtk");
    text_ = read_file(folder_ / "e.vtk");
  }

  TetFile read(const std::string& text) const {
    write_file(folder_ / "f.vtk", text);
    return read_vtk(folder_ / "f.vtk");
  }

  std::string problem(const std::string& text) const {
    return complaint(ExitStatus::BadData, [&] { read(text); });
  }

  /// The example with the first `from` replaced.
  std::string with(const std::string& from, const std::string& to) const {
    std::string text = text_;
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return place == std::string::npos ? text : text.replace(place, from.size(), to);
  }

  myotact::testing::TemporaryFolder folder_;
  std::string text_;
};

void expect_same(const TetFile& a, const TetFile& b) {
  EXPECT_EQ(a.mesh.nodes_m, b.mesh.nodes_m);
  EXPECT_EQ(a.mesh.corners, b.mesh.corners);
  EXPECT_EQ(a.mesh.midsides, b.mesh.midsides);
  EXPECT_EQ(a.fibres, b.fibres);
  EXPECT_EQ(a.sections_m2, b.sections_m2);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.attachments, b.attachments);
}

TEST_F(Vtk, LinearTetsComeBackBitForBit) {
  expect_same(read(text_), two_tets());
}

TEST_F(Vtk, QuadraticTetsComeBackBitForBit) {
  TetFile file = two_tets();
  file.mesh = make_quadratic(file.mesh);
  file.attachments.resize(file.mesh.nodes_m.size(), -1);
  write_vtk(file, folder_ / "q.vtk");
  EXPECT_THAT(read_file(folder_ / "q.vtk"), HasSubstr("CELL_TYPES 2\n24\n24\n"));
  expect_same(read_vtk(folder_ / "q.vtk"), file);
}

TEST_F(Vtk, SectionsAreOptionalAndTheTitleMayBeEmpty) {
  TetFile file = two_tets();
  file.sections_m2.clear();
  write_vtk(file, folder_ / "s.vtk");
  expect_same(read_vtk(folder_ / "s.vtk"), file);
  expect_same(read(with("\nmuscle\n", "\n\n")), two_tets());
}

TEST_F(Vtk, AFileCutAnywhereIsRefusedOrWhole) {
  for (std::size_t size = 0; size < text_.find("CELL_DATA"); size += 3) problem(text_.substr(0, size));
  EXPECT_THAT(problem(text_.substr(0, text_.find("LOOKUP_TABLE"))), HasSubstr("ends early"));
}

TEST_F(Vtk, WrongWordsNameTheLine) {
  EXPECT_THAT(problem("no header\n"), HasSubstr("is no legacy VTK file"));
  EXPECT_THAT(problem(with("ASCII", "BINARY")), AllOf(HasSubstr("line 3"), HasSubstr("must be \"ASCII\"")));
  EXPECT_THAT(problem(with("UNSTRUCTURED_GRID", "POLYDATA")), HasSubstr("line 4"));
  EXPECT_THAT(problem(with("POINTS 5 double", "POINTS 5 int")), AllOf(HasSubstr("line 5"), HasSubstr("float")));
  EXPECT_THAT(problem(with("4 0 1 2 3", "OFFSETS vtktypeint64")),
              AllOf(HasSubstr("line 12"), HasSubstr("version 4.2")));
  EXPECT_THAT(problem(with("VECTORS", "TENSORS")), HasSubstr("\"TENSORS\" is not read"));
  EXPECT_THAT(problem(with("region int 1", "region int 3")), HasSubstr("1 component"));
}

TEST_F(Vtk, WrongNumbersNameLineValueAndRange) {
  EXPECT_THAT(problem(with("1 1 1\n", "1 nan 1\n")), AllOf(HasSubstr("line 10"), HasSubstr("\"nan\"")));
  EXPECT_THAT(problem(with("1 1 1\n", "1 1e400 1\n")), HasSubstr("no finite number"));
  EXPECT_THAT(problem(with("4 1 4 2 3", "4 1 5 2 3")), AllOf(HasSubstr("line 13"), HasSubstr("from 0 to 4")));
  EXPECT_THAT(problem(with("4 1 4 2 3", "4 -1 4 2 3")), HasSubstr("-1 must be"));
  EXPECT_THAT(problem(with("4 1 4 2 3", "8 1 4 2 3")), HasSubstr("4 or 10 nodes"));
  EXPECT_THAT(problem(with("POINTS 5", "POINTS 2000000000")), HasSubstr("from 0 to 20000000"));
  EXPECT_THAT(problem(with("POINTS 5", "POINTS 20000000")), HasSubstr("no finite number"));
  EXPECT_THAT(problem(with("CELL_TYPES 2\n10", "CELL_TYPES 2\n12")), HasSubstr("cell type 12; must be 10"));
  EXPECT_THAT(problem(with("CELL_TYPES 2", "CELL_TYPES 1")), HasSubstr("one type a cell"));
  EXPECT_THAT(problem(with("CELL_DATA 2", "CELL_DATA 3")), HasSubstr("must have 2 entries"));
  EXPECT_THAT(problem(with("LOOKUP_TABLE default\n0\n1\n", "LOOKUP_TABLE default\n0\n0.5\n")),
              HasSubstr("whole numbers"));
}

}  // namespace
}  // namespace myotact::geometry
