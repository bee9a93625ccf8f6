#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "anatomy/read_wrap.h"
#include "anatomy/specimen.h"
#include "core/file.h"
#include "support/complaint.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace myotact::anatomy {
namespace {

using myotact::testing::complaint;
using ::testing::HasSubstr;

Specimen example() {
  myotact::testing::BarShape shape;
  shape.cells = {3, 1, 1};
  shape.tendon_cells = 1;
  Specimen specimen = myotact::testing::single_muscle(shape);
  specimen.overlaps = {{"upper", "flexor", 1e-3, 2e-9}};
  specimen.joints[0].centre_uncertainty_m = 2e-3;
  specimen.muscles[0].pennation_rad = 1.0 / 3.0;
  LineWrap cylinder;
  cylinder.body = 1;
  cylinder.axes = axes_about(Vec3(0.0, 0.6, 0.8));
  cylinder.radii_m.setConstant(0.01 / 3.0);
  LineWrap egg = cylinder;
  egg.after = 1;
  egg.body = 0;
  egg.shape = geometry::WrapShape::Ellipsoid;
  egg.centre_m = Vec3(0.01, 0.0, -0.01 / 3.0);
  egg.radii_m = Vec3(0.01, 0.02, 0.015);
  egg.side = Vec3(0.0, 0.0, 1.0);
  specimen.lines[0].wraps = {cylinder, egg};
  return specimen;
}

std::size_t entries_of(const std::filesystem::path& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

void expect_same_muscle(const Muscle& a, const Muscle& b) {
  EXPECT_EQ(a.key, b.key);
  EXPECT_EQ(a.name_la, b.name_la);
  EXPECT_EQ(a.peak_force_N, b.peak_force_N);
  EXPECT_EQ(a.optimal_fibre_m, b.optimal_fibre_m);
  EXPECT_EQ(a.pennation_rad, b.pennation_rad);
  EXPECT_EQ(a.rest_stretch, b.rest_stretch);
  EXPECT_EQ(a.estimated, b.estimated);
  EXPECT_EQ(a.sources, b.sources);
  EXPECT_EQ(a.tets.nodes_m, b.tets.nodes_m);
  EXPECT_EQ(a.tets.corners, b.tets.corners);
  EXPECT_EQ(a.fibres, b.fibres);
  EXPECT_EQ(a.sections_m2, b.sections_m2);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.attachments, b.attachments);
  EXPECT_EQ(a.skin.positions_m, b.skin.positions_m);
  EXPECT_EQ(a.skin.triangles, b.skin.triangles);
}

TEST(SaveSpecimen, EverythingComesBackBitForBit) {
  const myotact::testing::TemporaryFolder folder;
  const Specimen specimen = example();
  save_specimen(specimen, folder / "s");
  const Specimen back = load_specimen(folder / "s");
  EXPECT_EQ(back.name, specimen.name);
  EXPECT_EQ(back.side, "left");
  EXPECT_EQ(back.licence, specimen.licence);
  ASSERT_EQ(back.bones.size(), 2u);
  EXPECT_EQ(back.bones[1].body, 1);
  EXPECT_EQ(back.bones[1].surface.positions_m, specimen.bones[1].surface.positions_m);
  EXPECT_EQ(back.bodies[1].inertia_kg_m2, specimen.bodies[1].inertia_kg_m2);
  EXPECT_EQ(back.joints[0].axes, specimen.joints[0].axes);
  EXPECT_EQ(back.joints[0].range_rad, specimen.joints[0].range_rad);
  EXPECT_EQ(back.joints[0].centre_uncertainty_m, 2e-3);
  expect_same_muscle(back.muscles[0], specimen.muscles[0]);
  ASSERT_EQ(back.lines[0].points.size(), 3u);
  EXPECT_EQ(back.lines[0].points[1].position_m, specimen.lines[0].points[1].position_m);
  EXPECT_EQ(back.lines[0].points[1].kind, LinePointKind::Via);
  ASSERT_EQ(back.lines[0].wraps.size(), 2u);
  for (std::size_t w = 0; w < 2; ++w) {
    const LineWrap &here = back.lines[0].wraps[w], &there = specimen.lines[0].wraps[w];
    EXPECT_EQ(here.body, there.body);
    EXPECT_EQ(here.after, there.after);
    EXPECT_EQ(here.shape, there.shape);
    EXPECT_EQ(here.centre_m, there.centre_m);
    EXPECT_EQ(here.axes, there.axes);
    EXPECT_EQ(here.radii_m, there.radii_m);
    EXPECT_EQ(here.side, there.side);
  }
  EXPECT_EQ(back.groups[0].flexors, std::vector<int>{0});
  EXPECT_EQ(back.overlaps[0].volume_m3, 2e-9);
}

TEST(SaveSpecimen, TheSameSpecimenGivesTheSameBytes) {
  const myotact::testing::TemporaryFolder folder;
  save_specimen(example(), folder / "a");
  save_specimen(load_specimen(folder / "a"), folder / "b");
  for (const char* file : {"specimen.json", "bones/upper.ply", "skins/flexor.ply", "muscles/flexor.vtk"}) {
    EXPECT_EQ(read_file(folder / "a" / file), read_file(folder / "b" / file)) << file;
  }
}

TEST(SaveSpecimen, AnOlderSpecimenIsReplacedWhole) {
  const myotact::testing::TemporaryFolder folder;
  save_specimen(example(), folder / "s");
  write_file(folder / "s/left_over", "x");
  Specimen changed = example();
  changed.name = "second";
  save_specimen(changed, (folder / "s").string() + "/");
  EXPECT_EQ(load_specimen(folder / "s").name, "second");
  EXPECT_FALSE(std::filesystem::exists(folder / "s/left_over"));
  EXPECT_EQ(entries_of(folder.path()), 1u);
}

TEST(SaveSpecimen, WhatIsNoSpecimenIsNotReplaced) {
  const myotact::testing::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "thesis");
  write_file(folder / "thesis/chapter", "x");
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { save_specimen(example(), folder / "thesis"); }),
              HasSubstr("name another folder"));
  EXPECT_EQ(read_file(folder / "thesis/chapter"), "x");
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { save_specimen(example(), folder / "thesis/chapter"); }),
              HasSubstr("chapter"));
  EXPECT_EQ(entries_of(folder.path()), 1u);
}

TEST(SaveSpecimen, NothingIsWrittenWhereItCannotBeOrOfWhatCannotBeRead) {
  const myotact::testing::TemporaryFolder folder;
  EXPECT_THAT(complaint(ExitStatus::InputOutput, [&] { save_specimen(example(), "/proc/specimen"); }),
              HasSubstr("/proc"));
  Specimen broken = example();
  broken.muscles[0].peak_force_N = -1.0;
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { save_specimen(broken, folder / "b"); }), HasSubstr("peak_force_N"));
  EXPECT_EQ(entries_of(folder.path()), 0u);
}

}  // namespace
}  // namespace myotact::anatomy
