// Device profiles: the shipped ones, and what is wrong with others, by place.

#include "device/profile_file.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "core/file.h"

namespace myotact::device {
namespace {

constexpr const char* kSound = R"({"schema": 1, "title": "t",
 "peak_force_N": {"value": 3, "source": "s"}, "continuous_force_N": {"value": 1, "source": "s"},
 "max_stiffness_N_m": {"value": 900, "source": "s"}, "inertia_kg": {"value": 0.1, "source": "s"},
 "viscous_Ns_m": {"value": 0.1, "source": "s"}, "coulomb_N": {"value": 0.1, "source": "s"},
 "resolution_m": {"value": 2e-5, "source": "s"}, "delay_ticks": {"value": 2, "source": "s"},
 "workspace_m": {"value": [0.2, 0.1, 0.1], "source": "s"}})";

class ProfileFile : public ::testing::Test {
 protected:
  ~ProfileFile() override { std::filesystem::remove(path_); }
  NamedProfile load(std::string text, const std::string& from = "", const std::string& to = "") {
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    write_file(path_, text);
    return load_profile(path_.string());
  }
  /// The message of the error that the change leads to.
  std::string refusal(const std::string& from, const std::string& to) {
    try {
      load(kSound, from, to);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData);
      return error.what();
    }
    return "no error";
  }
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("myotact_profile_" + std::to_string(::getpid()) + ".json");
};

TEST_F(ProfileFile, AFileSaysWhatTheDeviceBears) {
  const NamedProfile named = load(kSound);
  EXPECT_EQ(named.title, "t");
  EXPECT_EQ(named.profile.peak_force_N, 3.0);
  EXPECT_EQ(named.profile.max_stiffness_N_m, 900.0);
  EXPECT_EQ(named.profile.resolution_m, 2e-5);
  EXPECT_EQ(named.profile.delay_ticks, 2);
  EXPECT_EQ(named.profile.workspace_m, (std::array{0.2, 0.1, 0.1}));
  EXPECT_FALSE(named.profile.shows_force_only);
}

TEST_F(ProfileFile, WhatIsWrongIsNamedWithItsPlaceAndRange) {
  const std::string heavy = refusal(R"("inertia_kg": {"value": 0.1)", R"("inertia_kg": {"value": 99)");
  EXPECT_NE(heavy.find("/inertia_kg/value"), std::string::npos) << heavy;
  EXPECT_NE(heavy.find("10"), std::string::npos) << heavy;
  EXPECT_NE(refusal(R"("source": "s")", R"("source": "")").find("/peak_force_N/source"), std::string::npos);
  EXPECT_NE(refusal("\"coulomb_N\"", "\"coulomb\"").find("coulomb_N"), std::string::npos);
  EXPECT_NE(refusal("\"value\": 2,", "\"value\": 9,").find("/delay_ticks/value"), std::string::npos);
  EXPECT_NE(refusal("[0.2,", "[0.001,").find("/workspace_m/value/0"), std::string::npos);
  EXPECT_NE(refusal("[0.2, 0.1, 0.1]", "[0.2]").find("/workspace_m/value"), std::string::npos);
  EXPECT_NE(refusal("\"value\": 1,", "\"value\": 4,").find("/continuous_force_N/value"), std::string::npos);
  EXPECT_NE(refusal("\"schema\": 1", "\"schema\": 2").find("/schema"), std::string::npos);
  EXPECT_NE(refusal("{\"schema\"", "[\"schema\"").find(path_.string()), std::string::npos);
}

TEST(Profiles, EveryShippedOneIsReadAndSimulatedIsTheDefault) {
  EXPECT_GE(built_in_profiles().size(), 5u);
  for (const std::string& name : built_in_profiles()) EXPECT_NO_THROW(load_profile(name)) << name;
  const DeviceProfile read = load_profile("simulated").profile, standard;
  EXPECT_EQ(read.peak_force_N, standard.peak_force_N);
  EXPECT_EQ(read.continuous_force_N, standard.continuous_force_N);
  EXPECT_EQ(read.max_stiffness_N_m, standard.max_stiffness_N_m);
  EXPECT_EQ(read.inertia_kg, standard.inertia_kg);
  EXPECT_EQ(read.viscous_Ns_m, standard.viscous_Ns_m);
  EXPECT_EQ(read.coulomb_N, standard.coulomb_N);
  EXPECT_EQ(read.resolution_m, standard.resolution_m);
  EXPECT_EQ(read.delay_ticks, standard.delay_ticks);
}

TEST(Profiles, ASceneNamesASimulatedDeviceWithTheProfileOfARealOne) {
  EXPECT_EQ(simulated_profile("simulated").peak_force_N, DeviceProfile{}.peak_force_N);
  EXPECT_EQ(simulated_profile("simulated:omega").peak_force_N, 12.0);
  EXPECT_THROW(simulated_profile("simulated:omego"), Error);
}

TEST(Profiles, AnUnknownNameIsRefusedWithTheNearest) {
  try {
    load_profile("stilus");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::NoInput);
    EXPECT_NE(std::string(error.what()).find("nearest: stylus"), std::string::npos);
  }
}

}  // namespace
}  // namespace myotact::device
