#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/specimen.h"
#include "support/synthetic_specimen.h"

namespace myotact::anatomy {
namespace {

using ::testing::HasSubstr;

/// Two muscles of twelve tets: small, so that every defect is found quickly under sanitizers too.
Specimen example() {
  myotact::testing::BarShape shape;
  shape.cells = {2, 1, 1};
  return myotact::testing::single_muscle(shape);
}

TEST(FindDefect, ASoundSpecimenHasNone) {
  EXPECT_EQ(find_defect(example()), "");
  Specimen quadratic = example();
  Muscle& muscle = quadratic.muscles[0];
  muscle.tets = geometry::make_quadratic(muscle.tets);
  muscle.attachments.resize(muscle.tets.nodes_m.size(), -1);
  EXPECT_EQ(find_defect(quadratic), "");
}

struct Damage {
  const char* told;  // part of what is said
  std::function<void(Specimen&)> act;
};

void expect_told(const std::vector<Damage>& damages) {
  for (const Damage& damage : damages) {
    Specimen specimen = example();
    damage.act(specimen);
    EXPECT_THAT(find_defect(specimen), HasSubstr(damage.told));
  }
}

TEST(FindDefect, KeysAreNamesOfFiles) {
  expect_told({
      {"muscle \"../x\": a key must be", [](Specimen& s) { s.muscles[0].key = "../x"; }},
      {"bone \"\"", [](Specimen& s) { s.bones[0].key = ""; }},
      {"body \"Upper\"", [](Specimen& s) { s.bodies[0].key = "Upper"; }},
      {"joint \".elbow\"", [](Specimen& s) { s.joints[0].key = ".elbow"; }},
      {"1 to 100", [](Specimen& s) { s.joints[0].key = std::string(101, 'a'); }},
  });
}

TEST(FindDefect, ReferencesLeadSomewhere) {
  expect_told({
      {"bone upper: its body is 2; there are 2", [](Specimen& s) { s.bones[0].body = 2; }},
      {"joint elbow: its bodies are -1 and 1", [](Specimen& s) { s.joints[0].parent = -1; }},
      {"a line names muscle 1; there are 1", [](Specimen& s) { s.lines[0].muscle = 1; }},
      {"a line names body -1", [](Specimen& s) { s.lines[0].points[0].body = -1; }},
      {"a group names", [](Specimen& s) { s.groups[0].flexors = {7}; }},
      {"a group names", [](Specimen& s) { s.groups[0].joint = 1; }},
  });
}

TEST(FindDefect, BodiesAndJointsAreRigidBodyMechanics) {
  expect_told({
      {"bodies: is empty", [](Specimen& s) { s = Specimen{}; }},
      {"body upper: mass_kg is 0", [](Specimen& s) { s.bodies[0].mass_kg = 0.0; }},
      {"body upper: mass_kg is nan", [](Specimen& s) { s.bodies[0].mass_kg = std::nan(""); }},
      {"positive definite", [](Specimen& s) { s.bodies[1].inertia_kg_m2[5] = 1.0; }},
      {"com_m must lie within 10 m", [](Specimen& s) { s.bodies[1].com_m.x() = 100.0; }},
      {"parent and child are the same", [](Specimen& s) { s.joints[0].child = 0; }},
      {"its type needs 2 of each", [](Specimen& s) { s.joints[0].type = JointType::Universal; }},
      {"an axis is not of length 1", [](Specimen& s) { s.joints[0].axes[0] *= 1.01; }},
      {"an axis is not of length 1", [](Specimen& s) { s.joints[0].axes[0].x() = std::nan(""); }},
      {"range_rad must rise",
       [](Specimen& s) {
         s.joints[0].range_rad[0] = {1.0, -1.0};
       }},
  });
}

TEST(FindDefect, MuscleNumbersStayInTheirRange) {
  expect_told({
      {"peak_force_N is -1; must be between 0.001 and 1e+05", [](Specimen& s) { s.muscles[0].peak_force_N = -1.0; }},
      {"optimal_fibre_m is 42", [](Specimen& s) { s.muscles[0].optimal_fibre_m = 42.0; }},
      {"rest_stretch is 0.8; must be above 0.84", [](Specimen& s) { s.muscles[0].pennation_rad = 1.0; }},
      {"rest_stretch is nan", [](Specimen& s) { s.muscles[0].rest_stretch = std::nan(""); }},
      {"activation_tau_s is 0", [](Specimen& s) { s.muscles[0].activation_tau_s = 0.0; }},
  });
}

TEST(FindDefect, TetsAreWholeAndHangOnSomething) {
  expect_told({
      {"tet 3 has volume -",
       [](Specimen& s) { std::swap(s.muscles[0].tets.corners[3][0], s.muscles[0].tets.corners[3][1]); }},
      {"one fibre, region and section", [](Specimen& s) { s.muscles[0].fibres.pop_back(); }},
      {"fibre of tet 0 is not", [](Specimen& s) { s.muscles[0].fibres[0] = Vec3::Zero(); }},
      {"section of tet 1", [](Specimen& s) { s.muscles[0].sections_m2[1] = -1.0; }},
      {"one attachment a node", [](Specimen& s) { s.muscles[0].attachments.pop_back(); }},
      {"node 0 is attached to body 2; must be -1 .. 1", [](Specimen& s) { s.muscles[0].attachments[0] = 2; }},
      {"float away",
       [](Specimen& s) {
         for (int& a : s.muscles[0].attachments) a = -1;
       }},
      {"node 12 belongs to no tet",
       [](Specimen& s) {
         s.muscles[0].tets.nodes_m.emplace_back(0, 0, 0);
         s.muscles[0].attachments.push_back(-1);
       }},
      {"are the units metres?",
       [](Specimen& s) {
         for (Vec3& p : s.muscles[0].tets.nodes_m) p *= 1000.0;
       }},
      {"the order is VTK's",
       [](Specimen& s) {
         Muscle& m = s.muscles[0];
         m.tets = geometry::make_quadratic(m.tets);
         m.attachments.resize(m.tets.nodes_m.size(), -1);
         std::swap(m.tets.midsides[0][4], m.tets.midsides[0][5]);
       }},
  });
}

TEST(FindDefect, SurfacesAreClosed) {
  expect_told({
      {"skin of flexor: is not closed (3 bad edges)", [](Specimen& s) { s.muscles[0].skin.triangles.pop_back(); }},
      {"bone lower: has no triangles", [](Specimen& s) { s.bones[1].surface = {}; }},
      {"beyond 10 m", [](Specimen& s) { s.bones[1].surface.positions_m[0].z() = 1e9; }},
  });
}

TEST(FindDefect, EveryMuscleHasOneLineFromOriginToInsertion) {
  expect_told({
      {"has 0 lines", [](Specimen& s) { s.lines.clear(); }},
      {"has 2 lines", [](Specimen& s) { s.lines.push_back(s.lines[0]); }},
      {"at least two points", [](Specimen& s) { s.lines[0].points.resize(1); }},
      {"begin with an origin", [](Specimen& s) { s.lines[0].points[0].kind = LinePointKind::Via; }},
      {"points 0 and 1 are the same",
       [](Specimen& s) { s.lines[0].points[1].position_m = s.lines[0].points[0].position_m; }},
      {"point 1 must lie within", [](Specimen& s) { s.lines[0].points[1].position_m.y() = std::nan(""); }},
  });
}

/// Round a cylinder of 25 mm about the joint, below the line that runs 30 mm above it.
Specimen wrapped() {
  Specimen specimen = example();
  LineWrap wrap;
  wrap.body = 0;
  wrap.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  wrap.radii_m.setConstant(0.025);
  wrap.side = Vec3::UnitZ();
  specimen.lines[0].wraps = {wrap};
  return specimen;
}

TEST(FindDefect, WrapsAreSurfacesThatTheLineCanClear) {
  EXPECT_EQ(find_defect(wrapped()), "");
  using Change = std::function<void(MuscleLine&)>;
  const std::vector<std::pair<const char*, Change>> changes = {
      {"a wrap of a line names body 2; there are 2", [](MuscleLine& l) { l.wraps[0].body = 2; }},
      {"line of flexor: wrap 0: after is 1; must be 0 .. 0", [](MuscleLine& l) { l.wraps[0].after = 1; }},
      {"wraps 0 and 1 are on the same segment, after point 0", [](MuscleLine& l) { l.wraps.push_back(l.wraps[0]); }},
      {"a radius is 0 m; must be between 1e-04 and 0.2", [](MuscleLine& l) { l.wraps[0].radii_m[1] = 0.0; }},
      {"a radius is nan m", [](MuscleLine& l) { l.wraps[0].radii_m[0] = std::nan(""); }},
      {"largest radius is 5 times its smallest", [](MuscleLine& l) { l.wraps[0].radii_m = Vec3(0.002, 0.01, 0.01); }},
      {"centre_m must lie within 10 m", [](MuscleLine& l) { l.wraps[0].centre_m.x() = 100.0; }},
      {"its axes must be of length 1 and at right angles", [](MuscleLine& l) { l.wraps[0].axes(0, 0) = 0.1; }},
      {"side must be of length 1", [](MuscleLine& l) { l.wraps[0].side *= 1.1; }},
      {"side points along the axis", [](MuscleLine& l) { l.wraps[0].side = Vec3::UnitY(); }},
      {"point 1 of the line lies inside it", [](MuscleLine& l) { l.wraps[0].centre_m = l.points[1].position_m; }},
      {"more than half round",
       [](MuscleLine& l) {
         l.wraps[0].shape = geometry::WrapShape::Sphere;
         l.wraps[0].side = -Vec3::UnitZ();
       }},
  };
  for (const auto& [told, change] : changes) {
    Specimen specimen = wrapped();
    change(specimen.lines[0]);
    EXPECT_THAT(find_defect(specimen), HasSubstr(told));
  }
}

}  // namespace
}  // namespace myotact::anatomy
