// The whole way on the full canine meshes, which are not part of the repository: MYOTACT_CANINE_DIR says where they are.

#include <cstdlib>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "prepare/anatomy_assets.h"
#include "prepare/assemble.h"
#include "prepare/read_scan.h"

namespace myotact::prepare {
namespace {

/// Levers about the elbow in the file pose [m], from the section centrelines of the data set's table.
const std::map<std::string, double> kLevers_m = {
    {"biceps_brachii", 7.5e-3},           {"brachialis", 11.3e-3},
    {"triceps_brachii_long", -32.1e-3},   {"triceps_brachii_lateral", -21.6e-3},
    {"triceps_brachii_medial", -22.9e-3}, {"triceps_brachii_accessory", -30.9e-3},
    {"anconeus", -16.2e-3}};
/// The uncertainty of the axis.
constexpr double kLeverTolerance_m = 3e-3;

TEST(FullScan, BecomesASpecimenWithThePublishedLevers) {
  const char* folder = std::getenv("MYOTACT_CANINE_DIR");
  if (!folder) GTEST_SKIP() << "MYOTACT_CANINE_DIR is not set: the full canine meshes are not there";
  PreparedInput input;
  input.anatomy = read_anatomy(data_folder() / "assets" / "canine");
  Scan scan = read_scan(std::filesystem::path(folder) / "forelimb_left", input.anatomy);
  input.bones = std::move(scan.bones);
  input.muscles = std::move(scan.muscles);
  std::vector<SurfaceReport> reports;
  const anatomy::Specimen specimen = assemble_specimen(input, {}, reports);
  EXPECT_EQ(specimen.muscles.size(), kLevers_m.size());
  for (const SurfaceReport& report : reports) {
    if (!report.muscle) continue;
    ASSERT_EQ(report.levers_m.size(), 1u) << report.key;
    EXPECT_NEAR(report.levers_m[0].second, kLevers_m.at(report.key), kLeverTolerance_m) << report.key;
    EXPECT_LT(std::abs(report.cage_volume_error), 0.01) << report.key;
    EXPECT_GT(report.tets.smallest_dihedral_deg, 5.0) << report.key;
  }
}

}  // namespace
}  // namespace myotact::prepare
