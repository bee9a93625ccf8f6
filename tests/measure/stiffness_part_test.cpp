#include "measure/stiffness_part.h"

#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::measure {
namespace {

using myotact::testing::complaint;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Rows with numbers that few digits do not carry, and some that are not there.
StiffnessRow row_of(const SweepOrigin& origin, int cell) {
  const std::size_t levels = origin.grid.levels.size();
  StiffnessRow row;
  row.joint = origin.joint;
  row.q_rad = origin.grid.angles_rad[static_cast<std::size_t>(cell) / levels];
  row.common = origin.grid.levels[static_cast<std::size_t>(cell) % levels];
  row.K_schur_Nm_rad = std::sqrt(2.0 + cell);
  row.K_low_Nm_rad = -1e-300 / 3.0;
  row.net_torque_Nm = -0.0;
  row.K_perturbed_Nm_rad = cell == 1 ? -std::nan("") : 1.0 / (3.0 + cell);
  row.K_high_Nm_rad = cell == 2 ? std::numeric_limits<double>::infinity() : 5e-324;
  row.held = cell % 2 == 0;
  row.converged = true;
  row.preview = cell == 3;
  row.why = "because \"of\" <it>";
  row.band = {{"joint axis", 0.1, 0.2}};
  row.muscles = {{"flexor", 0.3, 1.0 / 7.0, 1e17 / 3.0, -0.1, 0.2}};
  return row;
}

SweepOrigin origin_of_six() {
  return {"1.2.3", "elbow", "A title", "abc", "elbow", {{-0.1, 0.1 + 0.2, 0.5}, {0.1, 1.0}}};
}

SweepPart part_of(const SweepOrigin& origin, int part, int parts) {
  SweepPart made{origin, part, parts, {}};
  const CellRange cells = share_of_cells(origin.grid, part, parts);
  for (int cell = cells.first; cell < cells.end; ++cell) made.rows.push_back(row_of(origin, cell));
  return made;
}

class StiffnessPart : public ::testing::Test {
 protected:
  std::filesystem::path put(const SweepPart& part, const std::string& prefix = "") {
    const auto file = folder_ / fmt::format("{}{}", prefix, part_file_name(part.part, part.parts));
    write_file(file, part_json(part));
    return file;
  }
  testing::TemporaryFolder folder_;
};

TEST_F(StiffnessPart, SharesCoverAllCellsOnceAndDifferByOneAtMost) {
  const SweepGrid grid{{0.0, 0.1, 0.2}, {0.0, 0.5, 0.7, 1.0}};
  for (const int parts : {1, 2, 5, 12, 17}) {
    int next = 0;
    for (int part = 1; part <= parts; ++part) {
      const CellRange cells = share_of_cells(grid, part, parts);
      EXPECT_EQ(cells.first, next);
      EXPECT_LE(std::abs((cells.end - cells.first) * parts - grid.cells()), parts);
      next = cells.end;
    }
    EXPECT_EQ(next, grid.cells());
  }
}

TEST_F(StiffnessPart, MergedIsTheWholeToTheByteWhateverTheOrder) {
  const SweepOrigin origin = origin_of_six();
  const SweepPart whole = part_of(origin, 1, 1);
  EXPECT_EQ(part_file_name(2, 8), "stiffness_part_2_of_8.json");
  for (const int parts : {1, 4, 6, 8}) {  // of 8 two are empty
    std::vector<std::filesystem::path> files;
    for (int part = parts; part >= 1; --part) files.push_back(put(part_of(origin, part, parts)));
    const SweepPart merged = merge_parts(files);
    EXPECT_EQ(merged.origin, origin);
    EXPECT_EQ(stiffness_csv(merged.rows), stiffness_csv(whole.rows));
    EXPECT_EQ(part_json(merged), part_json(whole));
  }
}

TEST_F(StiffnessPart, TableBeginsWithTheColumnsThatScriptsRelyOn) {
  const std::string csv = stiffness_csv(part_of(origin_of_six(), 1, 1).rows);
  EXPECT_THAT(csv, StartsWith("joint,q_rad,common,difference,K_schur_Nm_rad,K_perturbed_Nm_rad,K_line_Nm_rad,"
                              "net_torque_Nm,K_muscle_Nm_rad,K_geometry_Nm_rad,K_contact_Nm_rad,K_passive_Nm_rad,held,"
                              "converged,"));
  EXPECT_THAT(csv, HasSubstr("\nelbow,-0.1,0.1,0,1.4142135623730951,0.3333333333333333,0,-0,"));
  EXPECT_THAT(csv, HasSubstr("\nelbow,-0.1,1,0,1.7320508075688772,nan,"));
}

TEST_F(StiffnessPart, NamesWhatIsMissingTwiceOrForeign) {
  const SweepOrigin origin = origin_of_six();
  const auto one = put(part_of(origin, 1, 3)), two = put(part_of(origin, 2, 3)), three = put(part_of(origin, 3, 3));
  const auto complain = [&](const std::vector<std::filesystem::path>& files) {
    return complaint(ExitStatus::BadData, [&] { merge_parts(files); });
  };
  EXPECT_THAT(complain({one, three}), HasSubstr("lacks stiffness_part_2_of_3.json"));
  EXPECT_THAT(complain({one, two, one, three}), HasSubstr("name each part once"));
  const auto other_count = put(part_of(origin, 2, 2));
  EXPECT_THAT(complain({one, other_count}), HasSubstr(other_count.string() + ": /parts: is 2"));
  const auto with = [&](void (*change)(SweepOrigin&)) {
    SweepOrigin changed = origin;
    change(changed);
    return complain({one, put(part_of(changed, 2, 3), "other_"), three});
  };
  EXPECT_THAT(with([](SweepOrigin& o) { o.version = std::string("9.0"); }), HasSubstr("of version 9.0, not 1.2.3"));
  EXPECT_THAT(with([](SweepOrigin& o) { o.joint = std::string("carpus"); }), HasSubstr("of the joint carpus"));
  EXPECT_THAT(with([](SweepOrigin& o) { o.scene = std::string("hock"); }), HasSubstr("of the scene hock"));
  EXPECT_THAT(with([](SweepOrigin& o) { o.scene_hash = std::string("abd"); }), HasSubstr("another state of the scene"));
  EXPECT_THAT(with([](SweepOrigin& o) { o.grid.levels[0] = 0.2; }), HasSubstr("other angles or levels"));
  EXPECT_THAT(with([](SweepOrigin& o) { o.joint = std::string("carpus"); }),
              HasSubstr("other_stiffness_part_2_of_3.json"));
}

TEST_F(StiffnessPart, RefusesFilesThatWereCutOrEdited) {
  const SweepPart part = part_of(origin_of_six(), 1, 2);
  const auto read = [&](const std::function<void(nlohmann::json&)>& edit) {
    nlohmann::json json = nlohmann::json::parse(part_json(part));
    edit(json);
    write_file(folder_ / "edited.json", json.dump());
    return complaint(ExitStatus::BadData, [&] { read_part(folder_ / "edited.json"); });
  };
  EXPECT_THAT(read([](auto& json) { json["rows"].erase(1); }), HasSubstr("/rows: holds 2 rows; this part has 3"));
  EXPECT_THAT(read([](auto& json) { json["rows"][1]["common"] = 0.4; }), HasSubstr("row 1 is not of the cell 1"));
  EXPECT_THAT(read([](auto& json) { json["part"] = 3; }), HasSubstr("/part"));
  EXPECT_THAT(read([](auto& json) { json["parts"] = 0; }), HasSubstr("/parts"));
  EXPECT_THAT(read([](auto& json) { json["levels"][0] = 1.5; }), HasSubstr("/levels/0"));
  EXPECT_THAT(read([](auto& json) { json["levels"] = nlohmann::json::array(); }), HasSubstr("/levels: is empty"));
  EXPECT_THAT(read([](auto& json) { json["rows"][0]["held"] = 2; }), HasSubstr("/rows/0/held"));
  EXPECT_THAT(read([](auto& json) { json["rows"][0]["surplus"] = 2; }), HasSubstr("surplus"));
  EXPECT_THAT(read([](auto& json) { json.erase("scene_hash"); }), HasSubstr("scene_hash"));
  EXPECT_THAT(read([](auto& json) { json = 7; }), HasSubstr("edited.json"));
  EXPECT_THAT(complaint(ExitStatus::NoInput, [&] { read_part(folder_ / "nothing.json"); }), HasSubstr("nothing.json"));
}

}  // namespace
}  // namespace myotact::measure
