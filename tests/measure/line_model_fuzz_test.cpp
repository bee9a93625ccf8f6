#include <cmath>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "core/error.h"
#include "core/file.h"
#include "measure/line/line_stiffness.h"
#include "support/mutator.h"
#include "support/temporary_folder.h"

// Broken bytes never crash the reader of line models, and whatever it lets pass can be computed and written.

namespace myotact::measure {
namespace {

TEST(LineModelFuzz, BrokenModelsAreComputedOrRefused) {
  constexpr int kRounds = 1500;  // a few seconds
  const std::string whole = read_file(data_folder() / "assets" / "cases" / "line_hock.json");
  const myotact::testing::TemporaryFolder folder;
  myotact::testing::Mutator mutator;
  int refused = 0;
  for (int round = 0; round < kRounds; ++round) {
    myotact::testing::write_quickly(folder / "model.json", mutator.broken(whole));
    try {
      const LineModel model = load_line_model(folder / "model.json");
      const std::vector<LineRow> rows = line_stiffness(model);
      ASSERT_EQ(rows.size(), model.q_rad.size() * model.levels.size());
      for (const LineRow& row : rows) {
        EXPECT_TRUE(std::isfinite(row.state.all().torque_Nm)) << round;
        EXPECT_TRUE(std::isfinite(row.state.all().stiffness_Nm_rad())) << round;
      }
      EXPECT_FALSE(line_stiffness_json(model, rows).empty());
    } catch (const Error& error) {
      ++refused;
      EXPECT_EQ(error.status(), ExitStatus::BadData) << error.what();
    }
  }
  EXPECT_GT(refused, kRounds / 3);
}

}  // namespace
}  // namespace myotact::measure
