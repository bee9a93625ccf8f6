// Whatever is wrong with a case, the complaint leads to it.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/case_example.h"

namespace myotact::measure {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A case with something of everything that the reader knows.
json full_case() {
  json full = example_case();
  full["fibre"] = {{"direction", {0, 1, 0}}};
  full["tolerance"] = 1e-8;
  full["sets"]["corner"] = {{"box", {-0.5, -0.5, -0.5, 0.5, 0.5, 0.5}}};
  full["sets"]["some"] = {{"nodes", {8, 9, 10}}};
  full["materials"].push_back({{"region", 0}, {"law", "muscle_fibre"}, {"parameters", {{"peak_Pa", 3e5}}}});
  full["conditions"].push_back({{"kind", "activation"}, {"value", 0.5}, {"ramp", 2}});
  full["conditions"].push_back({{"kind", "gravity"}, {"value", {0, 0, -9.81}}});
  full["conditions"].push_back({{"kind", "pressure"}, {"set", "tip"}, {"value", 20}});
  full["conditions"].push_back({{"kind", "displace"}, {"set", "some"}, {"value", {0.1, nullptr, 0}}});
  full["conditions"].push_back({{"kind", "symmetry"}, {"set", "root"}});
  full["outputs"].push_back({{"set", "all"}, {"quantity", "stress"}, {"reduce", "max"}});
  return full;
}

/// Values of a kind that must not stand there.
std::vector<json> wrong_kinds(const json& value) {
  if (value.is_string()) return {7, true, nullptr, json::object(), json::array({1}), ""};
  return {"7", true, json::object(), json::array({1})};
}

/// Numbers that are beyond what is computed with; sets and directions may be of any size.
std::vector<json> wrong_sizes(const std::string& place, const json& value) {
  const bool any_size = value.is_string() || place.starts_with("/sets") || place.starts_with("/fibre");
  return any_size ? std::vector<json>{} : std::vector<json>{-1e300, 1e300};
}

/// Whatever value is of a kind or size that it must not be, the complaint says in which file and where it is.
TEST(CasePlaces, EveryWrongValueIsNamedByFileAndPlace) {
  const CaseFolder folder;
  const json full = full_case(), leaves = full.flatten();
  EXPECT_EQ(folder.load(full).outputs.size(), 2U);
  std::size_t places = 0;
  for (const auto& [place, value] : leaves.items()) {
    std::vector<json> wrong = wrong_sizes(place, value);
    const std::vector<json> kinds = wrong_kinds(value);
    wrong.push_back(kinds[places++ % kinds.size()]);  // all of them at every place would take seconds
    for (const json& other : wrong) {
      json changed = full;
      changed[json::json_pointer(place)] = other;
      EXPECT_THAT(folder.problem(changed), AllOf(HasSubstr("case.json"), HasSubstr(place))) << other.dump();
    }
  }
  EXPECT_GT(places, 60u);
}

/// A key that is left out is either not needed, or named with the place where it is missed.
TEST(CasePlaces, EveryMissingKeyIsNamedWithTheObjectThatLacksIt) {
  const CaseFolder folder;
  const json full = full_case();
  int needed = 0;
  std::vector<json::json_pointer> objects{json::json_pointer()};
  for (std::size_t k = 0; k < objects.size(); ++k) {
    const json& here = full[objects[k]];
    for (const auto& [key, value] : here.items()) {
      if (value.is_structured()) objects.push_back(objects[k] / key);
      if (!here.is_object()) continue;
      json changed = full;
      changed[objects[k]].erase(key);
      try {
        folder.load(changed);
      } catch (const Error& error) {
        EXPECT_EQ(error.status(), ExitStatus::BadData);
        // Without any sets it is the first condition's that is not found.
        const std::string missed = key == "sets" ? "/conditions/0/set: is \"root\"" : key;
        EXPECT_THAT(std::string(error.what()), AllOf(HasSubstr("case.json"), HasSubstr(missed)))
            << objects[k].to_string();
        ++needed;
      }
    }
  }
  EXPECT_GT(needed, 25);
}

}  // namespace
}  // namespace myotact::measure
