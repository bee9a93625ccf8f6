#include <chrono>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "geometry/mesh_examples.h"
#include "support/temporary_folder.h"

namespace myotact::geometry {
namespace {

constexpr int kCellsAlong = 2500, kCellsAcross = 1000;  // of a torus: two triangles a cell
constexpr double kBudget_s = 5.0;                       // a person waits for a scan
constexpr double kBudget_GB = 1.5;                      // beside the meshing that follows

std::array<float, 3> torus_point(int i, int k) {
  const double u = 2.0 * M_PI * (i % kCellsAlong) / kCellsAlong, v = 2.0 * M_PI * (k % kCellsAcross) / kCellsAcross;
  const double r = 2.0 + std::cos(v);
  return {static_cast<float>(r * std::cos(u)), static_cast<float>(r * std::sin(u)), static_cast<float>(std::sin(v))};
}

void append_facet(std::string& bytes, const std::array<std::array<float, 3>, 3>& corners) {
  for (int k = 0; k < 3; ++k) append_bytes(bytes, 0.0F);
  for (const auto& corner : corners) append_bytes(bytes, corner);
  append_bytes(bytes, std::uint16_t{0});
}

void write_torus(const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  std::string bytes(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(2 * kCellsAlong * kCellsAcross));
  for (int i = 0; i < kCellsAlong; ++i) {
    for (int k = 0; k < kCellsAcross; ++k) {
      const auto a = torus_point(i, k), b = torus_point(i + 1, k), c = torus_point(i + 1, k + 1),
                 d = torus_point(i, k + 1);
      append_facet(bytes, {a, b, c});
      append_facet(bytes, {a, c, d});
    }
    file << bytes;
    bytes.clear();
  }
}

TEST(LargeStl, FiveMillionTrianglesAreReadInSeconds) {
  const myotact::testing::TemporaryFolder folder;
  write_torus(folder / "torus.stl");
  const auto start = std::chrono::steady_clock::now();
  const SurfaceFile surface = read_surface(folder / "torus.stl");
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const double peak_GB = static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e9;
  fmt::print("5 000 000 triangles: {:.2f} s (budget {} s: {}), peak {:.2f} GB (budget {} GB: {})\n", took_s, kBudget_s,
             took_s <= kBudget_s ? "met" : "missed", peak_GB, kBudget_GB, peak_GB <= kBudget_GB ? "met" : "missed");
  EXPECT_EQ(surface.mesh.triangles.size(), 5'000'000u);
  EXPECT_EQ(surface.mesh.positions_m.size(), 2'500'000u);
  EXPECT_NEAR(enclosed_volume_m3(surface.mesh), 4.0 * M_PI * M_PI, 1e-3);
}

}  // namespace
}  // namespace myotact::geometry
