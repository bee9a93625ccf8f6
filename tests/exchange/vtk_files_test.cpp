// What is written is read by VTK itself, and is the same to the last bit.

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "core/file.h"
#include "core/text.h"
#include "exchange/vtk_scene.h"
#include "simulation/tissue_snapshot.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace myotact::exchange {
namespace {

constexpr int kNoVtk = 77;

/// What VTK says of a file, by name, and the folder with its arrays.
struct VtkAnswer {
  int status = 0;
  std::map<std::string, std::string> lines;
};

VtkAnswer read_by_vtk(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto said = folder / "said.txt";
  const std::string command = std::string("/usr/bin/python3 ") + MYOTACT_READ_VTK + " " + file.string() + " " +
                              folder.string() + " > " + said.string() + " 2> /dev/null";
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c)
  VtkAnswer answer;
  answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::ifstream lines(said);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t blank = line.find(' ');
    answer.lines[line.substr(0, blank)] = line.substr(blank + 1);
  }
  return answer;
}

/// The numbers of an array as VTK has them.
template <class Number>
std::vector<Number> numbers_in(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

/// Bits, so that NaN equals NaN.
template <class Number>
bool same_bits(const std::vector<Number>& a, const std::vector<Number>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Number)) == 0;
}

std::vector<double> flat(std::span<const Vec3> vectors) {
  std::vector<double> numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), v.data(), v.data() + 3);
  return numbers;
}

class VtkFiles : public ::testing::Test {
 protected:
  VtkFiles() : specimen_(myotact::testing::antagonist_hinge()), simulation_(specimen_, {}) {}

  /// Writes and reads again; false where there is no VTK.
  bool read(const VtkPiece& piece, const std::string& name) {
    write_file(folder_ / name, vtk_xml(piece));
    answer_ = read_by_vtk(folder_ / name, folder_ / ".");
    return answer_.status != kNoVtk;
  }
  void move() {
    ASSERT_TRUE(simulation_.settle(std::vector<double>{0.3}, std::vector<double>{0.2, 0.0}));
    simulation_.set_excitation(0, 0.8);
    for (int step = 0; step < 5; ++step) simulation_.step({});
  }
  double volume_m3(const std::vector<double>& ratios) const {
    double sum = 0.0;
    std::size_t place = 0;
    for (const anatomy::Muscle& muscle : specimen_.muscles) {
      for (std::size_t t = 0; t < muscle.tets.corners.size(); ++t) {
        sum += ratios[place++] * geometry::corner_volume_m3(muscle.tets, t);
      }
    }
    return sum;
  }

  anatomy::Specimen specimen_;
  simulation::Simulation simulation_;
  myotact::testing::TemporaryFolder folder_;
  VtkAnswer answer_;
};

constexpr const char* kSkip = "needs VTK for /usr/bin/python3 (apt: python3-vtk9)";

TEST_F(VtkFiles, AGridIsReadToTheLastBit) {
  move();
  const VtkPiece piece = vtk_tissue(specimen_, simulation_);
  if (!read(piece, "state.vtu")) GTEST_SKIP() << kSkip;
  ASSERT_EQ(answer_.status, 0);
  EXPECT_EQ(answer_.lines["points"], std::to_string(piece.points_m.size()));
  EXPECT_EQ(answer_.lines["cells"], std::to_string(piece.types.size()));
  EXPECT_EQ(answer_.lines["types"], "24");
  EXPECT_EQ(answer_.lines["muscle_keys"], "flexor,extensor");
  EXPECT_TRUE(same_bits(numbers_in<double>(folder_ / "Points"), flat(piece.points_m)));
  for (const auto* arrays : {&piece.point_data, &piece.cell_data}) {
    for (const VtkArray& array : *arrays) {
      if (const auto* reals = std::get_if<std::vector<double>>(&array.values)) {
        EXPECT_TRUE(same_bits(numbers_in<double>(folder_ / array.name), *reals)) << array.name;
      } else {
        EXPECT_TRUE(same_bits(numbers_in<std::int32_t>(folder_ / array.name),
                              std::get<std::vector<std::int32_t>>(array.values)))
            << array.name;
      }
    }
  }
  EXPECT_EQ(numbers_in<double>(folder_ / "TimeValue"), std::vector<double>{simulation_.time_s()});
}

TEST_F(VtkFiles, WhatIsInThemIsTheSimulation) {
  move();
  const VtkPiece grid = vtk_tissue(specimen_, simulation_);
  const simulation::TissueSnapshot now = simulation_.tissue(0);
  EXPECT_TRUE(std::equal(now.position_m.begin(), now.position_m.end(), grid.points_m.begin()));
  const auto& velocity = std::get<std::vector<double>>(grid.point_data[1].values);
  EXPECT_EQ(velocity[0], now.velocity_m_s[0].x());
  EXPECT_GT(*std::max_element(velocity.begin(), velocity.end()), 1e-4);
  const VtkPiece surfaces = vtk_surfaces(specimen_, simulation_);
  const std::span<const Vec3> skin = simulation_.skin_world_m(0);
  const std::size_t before =
      specimen_.bones[0].surface.positions_m.size() + specimen_.bones[1].surface.positions_m.size();
  EXPECT_TRUE(std::equal(skin.begin(), skin.end(), surfaces.points_m.begin() + static_cast<std::ptrdiff_t>(before)));
}

TEST_F(VtkFiles, SurfacesHavePartsByName) {
  const VtkPiece piece = vtk_surfaces(specimen_, simulation_);
  if (!read(piece, "state.vtp")) GTEST_SKIP() << kSkip;
  ASSERT_EQ(answer_.status, 0);
  EXPECT_EQ(answer_.lines["types"], "5");
  EXPECT_EQ(answer_.lines["part_keys"], specimen_.bones[0].key + "," + specimen_.bones[1].key + ",flexor,extensor");
  EXPECT_TRUE(same_bits(numbers_in<double>(folder_ / "Points"), flat(piece.points_m)));
  const auto parts = numbers_in<std::int32_t>(folder_ / "part");
  EXPECT_EQ(parts.front(), 0);
  EXPECT_EQ(parts.back(), 3);
}

TEST(VtkXml, AGridWithoutCellsIsOne) {
  const std::string text = vtk_xml({});
  EXPECT_NE(text.find("type=\"UnstructuredGrid\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfCells=\"0\""), std::string::npos);
}

/// VTK cuts a quadratic tet into linear ones, so only straight-sided ones have its volume exactly.
TEST_F(VtkFiles, VtkFindsOurVolume) {
  if (!read(vtk_tissue(specimen_, simulation_), "rest.vtu")) GTEST_SKIP() << kSkip;
  const double rest_m3 = *parse_number(answer_.lines["volume"]);
  EXPECT_NEAR(rest_m3, volume_m3(numbers_in<double>(folder_ / "volume_ratio")), 1e-12 * rest_m3);
  move();
  ASSERT_TRUE(read(vtk_tissue(specimen_, simulation_), "moved.vtu"));
  const double moved_m3 = *parse_number(answer_.lines["volume"]);
  EXPECT_NEAR(moved_m3, volume_m3(numbers_in<double>(folder_ / "volume_ratio")), 2e-3 * moved_m3);
}

/// sigma = P F^T / J of a bar that rests: no stress; pulled along: along its fibres alone, nearly.
TEST_F(VtkFiles, StressIsAlongTheFibresOfAnActiveBar) {
  ASSERT_TRUE(simulation_.settle(std::vector<double>{0.0}, std::vector<double>{0.0, 0.0}));
  ASSERT_TRUE(simulation_.settle(std::vector<double>{0.0}, std::vector<double>{0.5, 0.5}));
  const simulation::TissueSnapshot now = simulation_.tissue(0);
  const std::size_t middle = now.cauchy_Pa.size() / 2;
  EXPECT_GT(now.fibre_Pa[middle], 1e4);
  EXPECT_NEAR(now.cauchy_Pa[middle](0, 0), now.fibre_Pa[middle] * now.stretch[middle], 0.2 * now.fibre_Pa[middle]);
  EXPECT_LT(std::abs(now.cauchy_Pa[middle](1, 1)), 0.1 * now.fibre_Pa[middle]);
  // Force through the middle: sections times stress, beside the tension that the muscle hands on.
  EXPECT_NEAR(now.cauchy_Pa[middle].trace(), now.cauchy_Pa[middle](0, 0), 0.3 * now.fibre_Pa[middle]);
}

TEST(VtkSeries, NamesItsFilesAndTimes) {
  const std::string text = vtk_series({{0.0, 0, "limb/limb_0.vtu"}, {0.05, 1, "limb/a&b.vtp"}});
  EXPECT_NE(text.find("timestep=\"0.05\" part=\"1\" file=\"limb/a&amp;b.vtp\""), std::string::npos);
  EXPECT_NE(text.find("type=\"Collection\""), std::string::npos);
}

}  // namespace
}  // namespace myotact::exchange
