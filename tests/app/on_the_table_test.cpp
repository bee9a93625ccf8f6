// The program with a device on the table: an Inverse3 of the test's own service, over a real WebSocket.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.h"
#include "core/file.h"
#include "device/drivers/inverse/fake_inverse_service.h"

namespace myotact::testing {
namespace {

using device::inverse::FakeInverseService;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kUsage = 2, kUnavailable = 69;
constexpr double kPeak_N = 10.0;  // of an Inverse3
/// A force command carries five decimals a component, so what arrives may be 0.5e-5 sqrt(3) N more than what was sent.
constexpr double kRounding_N = 0.9e-5;

class OnTheTable : public ::testing::Test {
 protected:
  /// The program with this service's device and settings of nobody.
  Outcome run(const std::string& arguments, const std::string& answers = "") {
    const std::string port = std::to_string(service_.port());
    return run_program(arguments + " --set inverse3.port=" + port + " --set inverse3.version_port=" + port,
                       answers + " XDG_CONFIG_HOME=" + folder_.path().string());
  }
  std::string out() const { return " --log-level warning --out " + (folder_.path() / "out").string(); }

  const TemporaryFolder folder_;
  FakeInverseService service_{{"049D", "05A0"}};
};

TEST_F(OnTheTable, TheTableHasItsLimits) {
  const Outcome outcome = run("devices --json");
  EXPECT_EQ(outcome.status, 0);
  for (const auto& row : nlohmann::json::parse(outcome.output)) {
    if (row["name"] != "inverse3:2") continue;
    EXPECT_EQ(row["available"], true);
    EXPECT_EQ(row["peak_force_N"], kPeak_N);
    EXPECT_THAT(row["what"].get<std::string>(), HasSubstr("05A0"));
    return;
  }
  FAIL() << outcome.output;
}

TEST_F(OnTheTable, ARunOnTheWallClockIsFeltThroughTheGate) {
  const Outcome outcome = run("run spring --realtime --seconds 3 --device inverse3" + out());
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  const auto summary = nlohmann::json::parse(read_file(folder_.path() / "out" / "summary.json"));
  const device::inverse::Received received = service_.received();
  EXPECT_EQ(received.last_id, "049D");
  EXPECT_GT(received.zeros_first, 0) << "through a ramp, from nothing";
  EXPECT_GT(received.greatest_N, 0.01);
  EXPECT_LE(received.greatest_N, 0.5 * kPeak_N + kRounding_N) << "half of it, unless the scene says otherwise";
  EXPECT_LE(received.greatest_N, summary["largest_force_N"].get<double>() + kRounding_N);
  EXPECT_EQ(received.last_N, Vec3::Zero());
}

TEST_F(OnTheTable, AVirtualClockHasNoHand) {
  const Outcome outcome = run("run spring --seconds 1 --device inverse3" + out());
  EXPECT_EQ(outcome.status, kUsage);
  EXPECT_THAT(outcome.output, HasSubstr("--realtime"));
  EXPECT_EQ(service_.received().greatest_N, 0.0);
}

TEST_F(OnTheTable, NoDeviceIsTakenWhereNoHandIsFelt) {
  for (const std::string command : {"serve spring", "lesson 2_pull_a_line", "stiffness elbow"}) {
    const Outcome outcome = run(command + " --device inverse3" + out());
    EXPECT_EQ(outcome.status, kUsage) << command;
    EXPECT_THAT(outcome.output, HasSubstr("--device inverse3: ")) << command;
  }
  const Outcome played = run("view --replay x.myorec --device inverse3");
  EXPECT_EQ(played.status, kUsage);
  EXPECT_THAT(played.output, HasSubstr("--device excludes --replay"));
  EXPECT_EQ(service_.received().greatest_N, 0.0);
}

TEST_F(OnTheTable, AHandIsGivenByName) {
  EXPECT_EQ(run("run spring --realtime --seconds 1 --device left=inverse3" + out()).status, 0);
  EXPECT_EQ(run("run spring --realtime --seconds 1 --device middle=inverse3" + out()).status, kUsage);
  const Outcome twice = run("run bimanual --realtime --seconds 1 --device inverse3,inverse3" + out());
  EXPECT_EQ(twice.status, kUsage);
  EXPECT_THAT(twice.output, HasSubstr("inverse3:2"));
  const Outcome same = run("run bimanual --realtime --seconds 1 --device left=inverse3,left=inverse3:2" + out());
  EXPECT_EQ(same.status, kUsage);
  EXPECT_THAT(same.output, HasSubstr("left hand gets two"));
  for (const std::string devices : {"left=simulated,inverse3", "inverse3,right=simulated"}) {
    EXPECT_EQ(run("run bimanual --set tissue.default=line --realtime --seconds 1 --device " + devices + out()).status,
              0)
        << devices;
  }
}

TEST_F(OnTheTable, ACheckPushesAfterAYesAlone) {
  const Outcome no = run("devices --test inverse3", "printf '\\nno\\n' |");
  EXPECT_EQ(no.status, 0) << no.output;
  EXPECT_THAT(no.output, HasSubstr("exchanges with the device"));
  EXPECT_EQ(service_.received().greatest_N, 0.0);
  const Outcome yes = run("devices --test inverse3", "printf '\\nyes\\n' |");
  EXPECT_THAT(yes.output, HasSubstr("right: pushed with "));
  EXPECT_GT(service_.received().greatest_N, 0.1);
  EXPECT_LT(service_.received().greatest_N, 1.5);
}

TEST_F(OnTheTable, WhatNeedsNoCalibrationSaysSo) {
  const Outcome outcome = run("devices --calibrate inverse3", "true |");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("ready"));
}

TEST_F(OnTheTable, SettingsThatAreNoneAreNamedWithTheirPlace) {
  const Outcome key = run("devices --set falcon.firmwar=/nowhere");
  EXPECT_EQ(key.status, 65);
  EXPECT_THAT(key.output, HasSubstr("/falcon/firmwar"));
  EXPECT_THAT(key.output, HasSubstr("\"firmware\""));
  const Outcome value = run("devices --set inverse3.peak_force_N=900");
  EXPECT_EQ(value.status, 65);
  EXPECT_THAT(value.output, HasSubstr("between 0.1 and 20"));
}

TEST_F(OnTheTable, WhatIsNotPluggedInIsUnavailableWithARemedy) {
  const Outcome third = run("run spring --realtime --seconds 1 --device inverse3:3" + out());
  EXPECT_EQ(third.status, kUnavailable);
  EXPECT_THAT(third.output, HasSubstr("inverse3:3"));
  const Outcome falcon = run("run spring --realtime --seconds 1 --device falcon" + out());
  EXPECT_EQ(falcon.status, kUnavailable);
  EXPECT_THAT(falcon.output, Not(HasSubstr("terminate")));
}

}  // namespace
}  // namespace myotact::testing
