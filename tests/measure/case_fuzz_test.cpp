#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/case_example.h"
#include "support/mutator.h"

// Broken bytes never crash the reader of cases: each gives a case or an Error that says what is wrong.

namespace myotact::measure {
namespace {

TEST(CaseFuzz, BrokenCasesAreReadOrRefused) {
  constexpr int kRounds = 1500;  // a second or two
  nlohmann::json json = example_case();
  json["fibre"] = {{"direction", {0, 1, 0}}};
  json["tolerance"] = 1e-8;
  json["sets"]["box"] = {{"box", {0, 0, 0, 2, 1, 1}}};
  json["sets"]["nodes"] = {{"nodes", {0, 1, 2}}};
  json["materials"].push_back({{"region", 0}, {"law", "muscle_fibre"}, {"parameters", {{"peak_Pa", 3e5}}}});
  json["conditions"].push_back({{"kind", "activation"}, {"value", 0.5}, {"ramp", 2}});
  const std::string whole = json.dump(1);
  const CaseFolder folder;
  myotact::testing::Mutator mutator;
  int refused = 0;
  for (int round = 0; round < kRounds; ++round) {
    myotact::testing::write_quickly(folder / "case.json", mutator.broken(whole));
    try {
      EXPECT_FALSE(load_case(folder / "case.json").mesh.mesh.corners.empty());
    } catch (const Error& error) {
      ++refused;
      const bool expected = error.status() == ExitStatus::BadData || error.status() == ExitStatus::NoInput;
      EXPECT_TRUE(expected) << error.what();
    }
  }
  EXPECT_GT(refused, kRounds / 2);
}

}  // namespace
}  // namespace myotact::measure
