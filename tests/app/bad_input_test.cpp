// Every kind of broken input ends with the exit status that scripts rely on and one message that names the place.

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/program.h"

namespace myotact::testing {
namespace {

using ::testing::HasSubstr;

class BadInput : public ::testing::Test {
 protected:
  std::string scene(const std::string& text) {
    const auto path = folder_.path() / "scene.json";
    std::ofstream(path) << text;
    return path.string();
  }
  std::string out() const { return " --out " + (folder_.path() / "out").string(); }

  TemporaryFolder folder_;
};

TEST_F(BadInput, UnknownSceneNamesTheNearestAndIsNoInput) {
  const Outcome outcome = run_program("run elbo" + out());
  EXPECT_EQ(outcome.status, 66);
  EXPECT_THAT(outcome.output, HasSubstr("nearest: \"elbow\""));
}

TEST_F(BadInput, WrongOptionsAreUsage) {
  EXPECT_EQ(run_program("run elbow --nonsense").status, 2);
  EXPECT_EQ(run_program("nonsense elbow").status, 2);
  EXPECT_EQ(run_program("run elbow --set nonsense" + out()).status, 2);
  EXPECT_EQ(run_program("run elbow --seconds -1").status, 2);
}

TEST_F(BadInput, SyntaxErrorNamesLineAndColumn) {
  const Outcome outcome = run_program("run " + scene("{\n \"schema\": 1,,\n}") + out());
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, HasSubstr("scene.json: 2:14"));
}

TEST_F(BadInput, WrongTypesNameTheirPointer) {
  const Outcome outcome =
      run_program("run " + scene(R"({"schema": 1, "name": "x", "specimen": "canine_elbow", "dt_s": "fast"})") + out());
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, HasSubstr("/dt_s: is \"fast\"; must be a number"));
}

TEST_F(BadInput, UnknownMuscleNamesTheNearest) {
  const Outcome outcome = run_program(
      "run " + scene(R"({"schema": 1, "name": "x", "specimen": "canine_elbow", "activations": {"biceps_brachi": 1}})") +
      out());
  EXPECT_EQ(outcome.status, 65);
  EXPECT_THAT(outcome.output, HasSubstr("nearest is \"biceps_brachii\""));
}

TEST_F(BadInput, EmptySpecimenFolderIsNoInput) {
  const Outcome outcome = run_program(
      "run " + scene(R"({"schema": 1, "name": "x", "specimen": ")" + folder_.path().string() + R"("})") + out());
  EXPECT_EQ(outcome.status, 66);
  EXPECT_THAT(outcome.output, HasSubstr("specimen.json is missing"));
}

TEST_F(BadInput, UnwritableOutputIsInputOutput) {
  std::ofstream(folder_.path() / "taken") << "a file where a folder is asked for";
  const Outcome outcome = run_program("run elbow --out " + (folder_.path() / "taken").string());
  EXPECT_EQ(outcome.status, 74);
  EXPECT_EQ(run_program("run elbow --out /proc/nowhere").status, 74);
}

TEST_F(BadInput, NoDisplayIsUnavailableAndSaysWhatWorks) {
  const Outcome outcome = run_program("view elbow", "env -u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(outcome.status, 69);
  EXPECT_THAT(outcome.output, HasSubstr("myotact run elbow"));
}

TEST_F(BadInput, UnknownDeviceIsUnavailable) {
  const Outcome outcome = run_program("run elbow --device falcn" + out());
  EXPECT_EQ(outcome.status, 69);
  EXPECT_THAT(outcome.output, HasSubstr("nearest: falcon"));
}

TEST_F(BadInput, MoreDevicesThanToolsAreRefused) {
  const Outcome outcome = run_program("run elbow --device simulated,simulated" + out());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.output, HasSubstr("2 devices named, but the scene \"elbow\" has 1 tool"));
  EXPECT_EQ(run_program("run bimanual --device mouse,mouse" + out()).status, 2);
}

TEST_F(BadInput, ReplayRefusesWhatIsNoRecording) {
  EXPECT_EQ(run_program("replay " + scene("{}")).status, 65);
  EXPECT_EQ(run_program("replay " + (folder_.path() / "nothing").string()).status, 66);
}

TEST_F(BadInput, NothingHalfWrittenStaysBehind) {
  run_program("run " + scene("{}") + out());
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out" / "samples.csv"));
}

}  // namespace
}  // namespace myotact::testing
