// The program myotact-plain-specimens: writes the specimens of meshes/ that are no limb, in which forces are known
// beforehand.

#include <filesystem>

#include <spdlog/spdlog.h>

#include "anatomy/specimen.h"
#include "core/error.h"
#include "core/log.h"
#include "geometry/box_mesh.h"
#include "geometry/plain_surfaces.h"

namespace {

using namespace myotact;

constexpr int kCells = 10;  // along every side of a box: edges to slide over on each face

anatomy::Specimen empty_specimen(const char* name) {
  anatomy::Specimen specimen;
  specimen.name = name;
  specimen.species = specimen.breed = "none";
  specimen.side = "left";
  specimen.source = "Made up: plain shapes, in which forces are known beforehand";
  specimen.licence = "Apache-2.0";
  specimen.created_by = "myotact-plain-specimens";
  return specimen;
}

struct Box {
  const char* key;
  Vec3 size_m, middle_m;
  double mass_kg;
};

/// A body of one box, and the box as its bone.
void add_box(anatomy::Specimen& specimen, const Box& box) {
  const auto& [key, size_m, middle_m, mass_kg] = box;
  const double x2 = size_m.x() * size_m.x(), y2 = size_m.y() * size_m.y(), z2 = size_m.z() * size_m.z();
  const double share_kg = mass_kg / 12.0;  // of a solid box
  anatomy::Body body{key, mass_kg, middle_m, {}, false};
  body.inertia_kg_m2 = {share_kg * (y2 + z2), share_kg * (x2 + z2), share_kg * (x2 + y2), 0.0, 0.0, 0.0};
  specimen.bodies.push_back(body);
  anatomy::Bone bone{key, key, key, static_cast<int>(specimen.bodies.size()) - 1, geometry::make_box(size_m, kCells)};
  for (Vec3& x : bone.surface.positions_m) x += middle_m;
  specimen.bones.push_back(std::move(bone));
}

anatomy::Specimen plane() {
  anatomy::Specimen specimen = empty_specimen("plane");
  const Vec3 size_m{0.3, 0.3, 0.02};
  add_box(specimen, {"plane", size_m, {0.0, 0.0, -0.5 * size_m.z()}, 1.0});  // fixed: its mass is without effect
  return specimen;
}

anatomy::Specimen plate() {
  // 0.85 N: the default device supports 0.88 N for ever, so a plate that hangs in the hand may hang there. 145 kg/m^3.
  constexpr double kMass_kg = 0.087;
  constexpr double kArm_m = 1.0;
  // A stop of 500 N m/rad with a toe of 9 mrad (simulation/skeleton_loads.h) yields sqrt(m g 1 m 2 9 mrad / 500) =
  // 5.5 mrad under the weight: there the plate lies on the ground.
  constexpr double kGap_m = 0.0055;
  anatomy::Specimen specimen = empty_specimen("plate");
  const Vec3 size_m{0.3, 0.2, 0.01};
  const Vec3 middle_m{0.0, 0.0, kGap_m + 0.5 * size_m.z()};
  add_box(specimen, {"ground", {0.4, 0.3, 0.02}, {0.0, 0.0, -0.01}, 1.0});  // fixed, likewise
  add_box(specimen, {"plate", size_m, middle_m, kMass_kg});
  anatomy::Joint hinge;
  hinge.key = "lift";
  hinge.parent = 0;
  hinge.child = 1;
  hinge.centre_m = middle_m - kArm_m * Vec3::UnitX();
  hinge.axes = {-Vec3::UnitY()};  // flexion lifts
  hinge.range_rad = {{0.0, 0.5}};
  hinge.damping_Nms_rad = 0.02;  // air: 0.02 N s/m at the plate, a fiftieth of a grip's
  specimen.joints.push_back(hinge);
  return specimen;
}

/// A block of relaxed muscle on the plane, clamped at its lower face, fibres along x.
anatomy::Specimen pad() {
  anatomy::Specimen specimen = plane();
  specimen.name = "pad";
  const Vec3 size_m{0.06, 0.06, 0.03};
  const Vec3 corner_m{-0.5 * size_m.x(), -0.5 * size_m.y(), 0.0};
  anatomy::Muscle muscle;
  muscle.key = muscle.name_la = muscle.name_en = "pad";
  muscle.material = "muscle";
  const double section_m2 = size_m.y() * size_m.z();
  muscle.peak_force_N = 300e3 * section_m2;  // 300 kPa: the usual specific tension
  muscle.optimal_fibre_m = size_m.x() / muscle.rest_stretch;
  muscle.estimated = {"rest_stretch"};
  muscle.sources = {"made up"};
  muscle.tets = geometry::make_box_mesh(size_m, {4, 4, 2});
  for (Vec3& x : muscle.tets.nodes_m) x += corner_m;
  muscle.fibres.assign(muscle.tets.corners.size(), Vec3::UnitX());
  muscle.sections_m2.assign(muscle.tets.corners.size(), section_m2);
  muscle.regions.assign(muscle.tets.corners.size(), anatomy::TissueRegion::Belly);
  for (const Vec3& x : muscle.tets.nodes_m) muscle.attachments.push_back(x.z() < 1e-9 ? 0 : -1);
  muscle.skin = geometry::make_box(size_m, kCells);
  for (Vec3& x : muscle.skin.positions_m) x += corner_m + 0.5 * size_m;
  specimen.muscles.push_back(std::move(muscle));
  const Vec3 end_m{0.5 * size_m.x(), 0.0, 0.5 * size_m.z()};
  specimen.lines.push_back({0,
                            {{0, {-end_m.x(), 0.0, end_m.z()}, anatomy::LinePointKind::Origin},
                             {0, end_m, anatomy::LinePointKind::Insertion}},
                            {}});
  return specimen;
}

/// Under a scene of which nothing is touched: it shows where down is and how large things are.
void add_table(anatomy::Specimen& specimen) {
  add_box(specimen, {"table", {0.16, 0.16, 0.004}, {0.0, 0.0, -0.06}, 1.0});  // fixed: its mass is without effect
}

/// The scene states where cube and particle are, and what the particle's mass is.
anatomy::Specimen particle() {
  constexpr double kRadius_m = 5e-3, kMass_kg = 0.2;
  anatomy::Specimen specimen = empty_specimen("particle");
  add_table(specimen);
  add_box(specimen, {"cube", Vec3::Constant(0.012), Vec3::Zero(), 1.0});
  const Vec3 middle_m{0.0, 0.0, 0.04};  // clear of the cube, as light falls on it
  const double inertia_kg_m2 = 0.4 * kMass_kg * kRadius_m * kRadius_m;
  specimen.bodies.push_back(
      {"particle", kMass_kg, middle_m, {inertia_kg_m2, inertia_kg_m2, inertia_kg_m2, 0.0, 0.0, 0.0}, false});
  anatomy::Bone ball{"particle", "particle", "particle", 2, geometry::make_ball(kRadius_m, 3)};
  for (Vec3& x : ball.surface.positions_m) x += middle_m;
  specimen.bones.push_back(std::move(ball));
  return specimen;
}

anatomy::Specimen spring() {
  anatomy::Specimen specimen = empty_specimen("spring");
  add_table(specimen);
  add_box(specimen, {"anchor", Vec3::Constant(0.008), Vec3::Zero(), 1.0});
  return specimen;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    start_log("info");
    if (argc != 2) throw Error(ExitStatus::Usage, "give the folder to write into, such as meshes");
    const std::filesystem::path folder = argv[1];
    for (const anatomy::Specimen& specimen : {plane(), plate(), pad(), particle(), spring()}) {
      anatomy::save_specimen(specimen, folder / specimen.name);
    }
    return 0;
  } catch (const Error& error) {
    spdlog::error("{}", error.what());
    return static_cast<int>(error.status());
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return static_cast<int>(ExitStatus::Internal);
  }
}
