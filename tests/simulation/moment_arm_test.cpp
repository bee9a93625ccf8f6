#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "anatomy/specimen.h"
#include "core/file.h"
#include "simulation/line/line_model.h"
#include "support/source_folder.h"

// Moment arms of the embedded limbs' muscle lines over the range of motion beside those of the attachment points that
// the authors of the published model chose (source_sites.json), about the same axes.

namespace myotact::simulation {
namespace {

constexpr std::array kAngles_deg = {-10.0, 0.0, 20.0, 40.0, 60.0};
/// A moment arm below the uncertainty of the fitted axes (3 mm) has no sign to speak of.
constexpr double kNoMomentArm_m = 3e-3;

struct Limb {
  const char* name;
  const char* prefix;      // of its muscles in the data set
  const char* fixed_body;  // that bones without one of their own move with
};

std::string body_of_bone(const std::string& bone, const anatomy::Specimen& specimen, const Limb& limb) {
  for (const anatomy::Bone& known : specimen.bones) {
    if (known.key == bone) return specimen.bodies[static_cast<std::size_t>(known.body)].key;
  }
  return limb.fixed_body;
}

/// Origin, via points and insertion of the published model as a line; several on one body are taken as their mean. No
/// points when the model has no origin and insertion for it.
anatomy::MuscleLine published_line(const nlohmann::json& sites, const anatomy::Specimen& specimen, const Limb& limb) {
  anatomy::MuscleLine line;
  for (const std::string role : {"origin", "via", "insertion"}) {
    std::vector<std::pair<std::string, std::vector<Vec3>>> places;  // by body, in the file's order
    for (const nlohmann::json& site : sites) {
      if (site.at("role") != role) continue;
      const std::string body = body_of_bone(site.at("bone"), specimen, limb);
      auto place = std::find_if(places.begin(), places.end(), [&](const auto& p) { return p.first == body; });
      if (place == places.end()) place = places.insert(places.end(), {body, {}});
      const auto p = site.at("position").get<std::array<double, 3>>();
      place->second.emplace_back(p[0], p[1], p[2]);
    }
    if (places.empty() && role != "via") return {};
    if (role != "via") places.resize(1);
    for (const auto& [body, points] : places) {
      Vec3 mean = Vec3::Zero();
      for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
      line.points.push_back({anatomy::find_body(specimen, body), mean, anatomy::LinePointKind::Via});
    }
  }
  return line;
}

double moment_arm_m(const anatomy::MuscleLine& line, Skeleton& skeleton, int joint, double angle_rad) {
  std::vector<double> angles(static_cast<std::size_t>(skeleton.joint_count()), 0.0);
  angles[static_cast<std::size_t>(joint)] = angle_rad;
  skeleton.set_pose(angles);
  LineGeometry geometry;
  measure_line(line, skeleton, geometry);
  return -geometry.slope_m_rad[joint];
}

class MomentArms : public ::testing::TestWithParam<Limb> {};
INSTANTIATE_TEST_SUITE_P(Canine, MomentArms,
                         ::testing::Values(Limb{"canine_forelimb", "fore.", "trunk"},
                                           Limb{"canine_hindlimb", "hind.", "pelvis"}));

TEST_P(MomentArms, HaveTheSignOfThePublishedModels) {
  const char* folder = std::getenv("MYOTACT_CANINE_DIR");
  if (folder == nullptr) GTEST_SKIP() << "MYOTACT_CANINE_DIR is not set: the published sites are not there";
  const auto sites = nlohmann::json::parse(read_file(std::filesystem::path(folder) / "source_sites.json")).at("sites");
  const auto specimen = anatomy::load_specimen(source_folder() + "/meshes/" + GetParam().name);
  Skeleton skeleton(specimen);
  int compared = 0;
  fmt::print("moment arm of the line / of the published sites [mm] at {} degrees\n", fmt::join(kAngles_deg, ", "));
  for (const anatomy::MuscleLine& line : specimen.lines) {
    const std::string& key = specimen.muscles[static_cast<std::size_t>(line.muscle)].key;
    const std::string name = key.find('.') == std::string::npos ? GetParam().prefix + key : key;
    if (!sites.contains(name)) continue;
    const anatomy::MuscleLine published = published_line(sites.at(name), specimen, GetParam());
    for (int j = 0; j < skeleton.joint_count(); ++j) {
      if (published.points.empty() || !spans_joint(line, skeleton, j) || !spans_joint(published, skeleton, j)) continue;
      std::string row;
      for (const double angle_deg : kAngles_deg) {
        const double angle_rad = angle_deg * std::numbers::pi / 180.0;
        const double ours = moment_arm_m(line, skeleton, j, angle_rad);
        const double theirs = moment_arm_m(published, skeleton, j, angle_rad);
        row += fmt::format(" {:6.1f}/{:6.1f}", 1e3 * ours, 1e3 * theirs);
        if (std::min(std::abs(ours), std::abs(theirs)) < kNoMomentArm_m) continue;
        EXPECT_GT(ours * theirs, 0.0) << key << " at " << angle_deg << " degrees";
        ++compared;
      }
      fmt::print("{:8} {:36}{}\n", specimen.joints[static_cast<std::size_t>(j)].key, key, row);
    }
  }
  EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace myotact::simulation
