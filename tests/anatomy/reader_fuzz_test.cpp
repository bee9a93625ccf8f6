#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "anatomy/specimen.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "geometry/mesh_files.h"
#include "support/mutator.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

// Broken bytes never crash a reader: each gives a result or an Error. The mutations are drawn from a fixed seed, so
// that a failure comes again.

namespace myotact::anatomy {
namespace {

constexpr int kRounds = 1500;  // a few seconds for all readers together, under sanitizers too

using myotact::testing::Mutator;
using myotact::testing::write_quickly;

struct Tally {
  int read = 0, refused = 0;
};

/// Runs `reader` on mutations of `bytes`, written to `path`.
Tally fuzz(const std::string& bytes, const std::filesystem::path& path, const std::function<void()>& reader) {
  Mutator mutator;
  Tally tally;
  for (int round = 0; round < kRounds; ++round) {
    write_quickly(path, mutator.broken(bytes));
    try {
      reader();
      ++tally.read;
    } catch (const Error& error) {
      // Only the stem, since a mesh may be two files, and a change in one may show in the other.
      EXPECT_NE(std::string(error.what()).find(path.stem().string() + "."), std::string::npos) << error.what();
      ++tally.refused;
    }
  }
  return tally;
}

class ReaderFuzz : public ::testing::Test {
 protected:
  void SetUp() override {
    myotact::testing::BarShape shape;
    shape.cells = {1, 1, 1};
    save_specimen(myotact::testing::single_muscle(shape), folder_ / "s");
  }

  std::string part(const std::string& name) const { return read_file(folder_ / "s" / name); }

  myotact::testing::TemporaryFolder folder_;
};

TEST_F(ReaderFuzz, Ply) {
  const auto tally = fuzz(part("bones/upper.ply"), folder_ / "f.ply",
                          [&] { EXPECT_FALSE(geometry::read_ply(folder_ / "f.ply").triangles.empty()); });
  EXPECT_GT(tally.refused, kRounds / 4);
}

TEST_F(ReaderFuzz, BinaryStl) {
  std::string bytes(80, ' ');
  const std::uint32_t facets = 12;
  bytes.append(reinterpret_cast<const char*>(&facets), sizeof facets);
  bytes.resize(bytes.size() + 50 * facets, '\1');
  const auto tally = fuzz(bytes, folder_ / "f.stl", [&] { geometry::read_stl(folder_ / "f.stl"); });
  EXPECT_GT(tally.read, 0);
  EXPECT_GT(tally.refused, kRounds / 4);
}

TEST_F(ReaderFuzz, AsciiStl) {
  std::string text = "solid s\n";
  for (int i = 0; i < 5; ++i) {
    text += "facet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1.5 0 0\nvertex 0 1e-3 0\nendloop\nendfacet\n";
  }
  const auto tally = fuzz(text + "endsolid s\n", folder_ / "f.stl", [&] { geometry::read_stl(folder_ / "f.stl"); });
  EXPECT_GT(tally.read, 0);
  EXPECT_GT(tally.refused, kRounds / 4);
}

TEST_F(ReaderFuzz, Vtk) {
  const auto tally = fuzz(part("muscles/flexor.vtk"), folder_ / "f.vtk",
                          [&] { EXPECT_FALSE(geometry::read_vtk(folder_ / "f.vtk").mesh.corners.empty()); });
  EXPECT_GT(tally.refused, kRounds / 4);
}

TEST_F(ReaderFuzz, TetgenNodesAndTets) {
  const std::string nodes = "4 3 0 1 # points\n1 0 0 0 1\n2 1 0 0 1\n3 0 1 0 1\n4 0 0 0.5 1\n";
  const std::string tets = "2 4 1\n1 1 2 3 4 7\n2 1 2 3 4 7\n# end\n";
  const auto reader = [&] { EXPECT_FALSE(geometry::read_tet_mesh(folder_ / "f.ele").mesh.corners.empty()); };
  write_quickly(folder_ / "f.ele", tets);
  EXPECT_GT(fuzz(nodes, folder_ / "f.node", reader).refused, kRounds / 4);
  write_quickly(folder_ / "f.node", nodes);
  EXPECT_GT(fuzz(tets, folder_ / "f.ele", reader).refused, kRounds / 4);
}

TEST_F(ReaderFuzz, Medit) {
  const auto tally = fuzz(
      "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1 1\nTriangles\n1\n1 2 3 1\n"
      "Tetrahedra\n2\n1 2 3 4 0\n1 2 3 4 1\nEnd\n",
      folder_ / "f.mesh", [&] { EXPECT_FALSE(geometry::read_tet_mesh(folder_ / "f.mesh").mesh.corners.empty()); });
  EXPECT_GT(tally.refused, kRounds / 4);
}

TEST_F(ReaderFuzz, Json) {
  const auto tally = fuzz(part("specimen.json"), folder_ / "f.json", [&] { read_json(folder_ / "f.json"); });
  EXPECT_GT(tally.refused, kRounds / 4);
}

TEST_F(ReaderFuzz, SpecimenWithBrokenJson) {
  const auto path = folder_ / "s/specimen.json";
  Mutator mutator;
  const std::string whole = part("specimen.json");
  for (int round = 0; round < kRounds / 3; ++round) {
    write_quickly(path, mutator.broken(whole));
    try {
      EXPECT_EQ(find_defect(load_specimen(folder_ / "s")), "");
    } catch (const Error& error) {
      EXPECT_NE(error.status(), ExitStatus::Internal) << error.what();
    }
  }
}

/// Without check sums, so that broken meshes reach the checks behind the readers.
TEST_F(ReaderFuzz, SpecimenWithBrokenParts) {
  auto json = read_json(folder_ / "s/specimen.json");
  json.erase("files");
  write_file(folder_ / "s/specimen.json", json.dump());
  for (const char* name : {"muscles/flexor.vtk", "skins/flexor.ply"}) {
    const std::string whole = part(name);
    Mutator mutator;
    for (int round = 0; round < kRounds / 3; ++round) {
      write_quickly(folder_ / "s" / name, mutator.broken(whole));
      try {
        EXPECT_EQ(find_defect(load_specimen(folder_ / "s")), "");
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::BadData) << error.what();
      }
    }
    write_file(folder_ / "s" / name, whole);
  }
}

}  // namespace
}  // namespace myotact::anatomy
