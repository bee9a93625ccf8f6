// From the full canine meshes to a run: both programs, one after the other. The meshes are not part of the repository;
// MYOTACT_CANINE_DIR says where they are.

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "support/source_folder.h"

namespace myotact::testing {
namespace {

nlohmann::json read_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

/// Of K, by which it may differ from the perturbed one. K takes the normals of a touch as they are, which rotate where
/// muscles slide on each other: at rest, where contact shapes them most, 5.2 % were measured.
double allowed_share(double common) {
  return common > 0.0 ? 0.05 : 0.06;
}

TEST(FullScan, RunsTheElbow) {
  const char* canine = std::getenv("MYOTACT_CANINE_DIR");
  if (!canine) GTEST_SKIP() << "MYOTACT_CANINE_DIR is not set: the full canine meshes are not there";
  TemporaryFolder folder;
  const std::string specimen = (folder.path() / "specimen").string();
  const std::string out = (folder.path() / "out").string();
  const std::string prepare = std::string(MYOTACT_PREPARE) + " " + canine + "/forelimb_left --recipe " +
                              source_folder() + "/assets/canine/elbow.json -o " + specimen;
  ASSERT_EQ(std::system((prepare + " > " + specimen + ".log 2>&1").c_str()), 0) << prepare;

  const Outcome outcome =
      run_program("run elbow --seconds 1.2 --levels 0,1 --set specimen=" + specimen + " --out " + out);
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  const nlohmann::json summary = read_json(folder.path() / "out" / "summary.json");
  EXPECT_EQ(summary.at("muscles"), 7);
  EXPECT_GT(summary.at("contact_s").get<double>(), 0.1);
  for (const nlohmann::json& level : summary.at("stiffness")) {
    const double perturbed = level.at("K_perturbed_Nm_rad");
    EXPECT_NEAR(level.at("K_schur_Nm_rad"), perturbed, allowed_share(level.at("common")) * std::abs(perturbed))
        << level;
  }
}

}  // namespace
}  // namespace myotact::testing
