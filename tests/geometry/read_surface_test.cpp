#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/file.h"
#include "geometry/mesh_examples.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::geometry {
namespace {

using myotact::testing::complaint;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::vector<const char*> kExtensions = {".stl", ".obj", ".ply", ".off", ".vtk", ".mesh", ".node", ".ele"};

class ReadSurface : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    write_file(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string problem(const std::string& name, const std::string& bytes) const {
    return complaint(ExitStatus::BadData, [&] { read_surface(write(name, bytes)); });
  }

  myotact::testing::TemporaryFolder folder_;
};

TEST_F(ReadSurface, EveryKindIsToldByItsExtension) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string nodes = "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n";
  write("m.node", nodes);
  write_ply(corner_surface(), folder_ / "m.ply");
  write_vtk(two_tets(), folder_ / "m.vtk");
  EXPECT_EQ(read_surface(write("m.stl", ascii_stl())).mesh.triangles.size(), 1u);
  EXPECT_EQ(read_surface(write("M.STL", binary_stl(corner_surface()))).mesh.triangles.size(), 4u);
  EXPECT_EQ(read_surface(write("m.Obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).mesh.triangles.size(), 1u);
  EXPECT_EQ(read_surface(folder_ / "m.ply").mesh.positions_m, corner_surface().positions_m);
  EXPECT_EQ(read_surface(write("m.off", off)).mesh.triangles.size(), 1u);
  EXPECT_EQ(read_surface(folder_ / "m.vtk").mesh.triangles.size(), 6u);
  const TriangleMesh tet = read_surface(write("m.ele", "1 4\n0 0 1 2 3\n")).mesh;
  EXPECT_EQ(tet.positions_m, corner_surface().positions_m);
  EXPECT_EQ(tet.triangles, (std::vector<std::array<int, 3>>{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}));
  EXPECT_EQ(read_surface(folder_ / "m.node").mesh.triangles, tet.triangles);
  const std::string medit =
      "MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\nTetrahedra 1\n1 2 3 4 "
      "5\nEnd\n";
  EXPECT_EQ(read_surface(write("m.mesh", medit)).mesh.triangles, tet.triangles);
}

TEST_F(ReadSurface, AnotherKindInsideIsNamed) {
  EXPECT_THAT(problem("a.stl", "ply\nformat ascii 1.0\n"),
              AllOf(HasSubstr("a.stl"), HasSubstr("holds PLY"), HasSubstr("rename it to end in .ply")));
  EXPECT_THAT(problem("a.obj", binary_stl(corner_surface())), HasSubstr("holds STL"));
  EXPECT_THAT(problem("a.ply", "OFF\n"), HasSubstr("holds OFF"));
  EXPECT_THAT(problem("a.off", "# vtk DataFile Version 3.0\n"), HasSubstr("holds legacy VTK"));
  EXPECT_THAT(problem("a.vtk", "<?xml version=\"1.0\"?>"), AllOf(HasSubstr("holds XML"), HasSubstr("export")));
  EXPECT_THAT(problem("a.ply", "\x1f\x8b\x08"), HasSubstr("holds gzip"));
  EXPECT_THAT(problem("a.off", "v 0 0 0\n"), HasSubstr("holds OBJ"));
  EXPECT_THAT(problem("a.mesh", "solid x\n"), HasSubstr("holds STL"));
  EXPECT_EQ(read_surface(write("a.stl", binary_stl(corner_surface(), "OFF is its name"))).mesh.triangles.size(), 4u);
  EXPECT_THAT(problem("a.3mf", ""), AllOf(HasSubstr("\".3mf\""), HasSubstr(".stl, .obj, .ply, .off, .vtk")));
}

TEST_F(ReadSurface, WhatIsNoFileIsRefusedAtOnce) {
  for (const char* extension : kExtensions) {
    const std::string name = std::string("f") + extension;
    EXPECT_THAT(complaint(ExitStatus::NoInput, [&] { read_surface(folder_ / name); }), HasSubstr("f."));
  }
  for (const std::string extension : {".stl", ".obj", ".ply", ".off", ".vtk", ".mesh", ".ele"}) {
    write("e.node", "4 3\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n");
    EXPECT_THAT(problem("e" + extension, ""), HasSubstr("e" + extension));
  }
  for (const char* extension : kExtensions) {
    const auto folder = folder_ / (std::string("d") + extension);
    std::filesystem::create_directory(folder);
    EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_surface(folder); }), HasSubstr("is not a regular file"));
    const auto pipe = folder_ / (std::string("p") + extension);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    if (extension == kExtensions[7]) continue;  // its pair, the pipe p.node, is read first
    EXPECT_THAT(complaint(ExitStatus::BadData, [&] { read_surface(pipe); }), HasSubstr("is not a regular file"));
  }
}

}  // namespace
}  // namespace myotact::geometry
