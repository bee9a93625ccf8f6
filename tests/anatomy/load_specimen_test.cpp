#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "anatomy/specimen.h"
#include "core/data_folder.h"
#include "core/file.h"
#include "core/json_reader.h"
#include "support/complaint.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace myotact::anatomy {
namespace {

using myotact::testing::complaint;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

class LoadSpecimen : public ::testing::Test {
 protected:
  void SetUp() override {
    myotact::testing::BarShape shape;
    shape.cells = {2, 1, 1};
    save_specimen(myotact::testing::single_muscle(shape), folder_ / "s");
    json_ = read_json(folder_ / "s/specimen.json");
  }

  /// What loading says after `change` to specimen.json.
  std::string problem(const std::function<void(json&)>& change, ExitStatus status = ExitStatus::BadData) const {
    json changed = json_;
    change(changed);
    write_file(folder_ / "s/specimen.json", changed.dump());
    return complaint(status, [&] { load_specimen(folder_ / "s"); });
  }

  myotact::testing::TemporaryFolder folder_;
  json json_;
};

TEST_F(LoadSpecimen, FolderThatHoldsNone) {
  std::filesystem::create_directory(folder_ / "empty");
  EXPECT_THAT(complaint(ExitStatus::NoInput, [&] { load_specimen(folder_ / "empty"); }),
              AllOf(HasSubstr("specimen.json is missing"), HasSubstr("myotact-prepare")));
  complaint(ExitStatus::NoInput, [&] { load_specimen(folder_ / "nothing"); });
  complaint(ExitStatus::NoInput, [&] { load_specimen(folder_ / "s/specimen.json"); });
  complaint(ExitStatus::NoInput, [&] { load_specimen(folder_ / std::string(5000, 'x')); });
}

TEST_F(LoadSpecimen, SyntaxErrorNamesLineAndColumn) {
  write_file(folder_ / "s/specimen.json", "{\n \"schema\" 1\n}");
  EXPECT_THAT(complaint(ExitStatus::BadData, [&] { load_specimen(folder_ / "s"); }),
              HasSubstr("specimen.json: 2:11: "));
}

TEST_F(LoadSpecimen, WrongValuesNameTheirPointer) {
  EXPECT_THAT(problem([](json& s) { s["schema"] = 2; }), HasSubstr("/schema: is 2; must be between 1 and 1"));
  EXPECT_THAT(problem([](json& s) { s["side"] = "port"; }),
              HasSubstr("/side: is \"port\"; must be one of left, right"));
  EXPECT_THAT(problem([](json& s) { s["muscles"] = 7; }), HasSubstr("/muscles: is 7; must be a list"));
  EXPECT_THAT(problem([](json& s) { s["muscles"][0]["peak_force_N"] = "strong"; }),
              HasSubstr("/muscles/0/peak_force_N: is \"strong\"; must be a number"));
  EXPECT_THAT(problem([](json& s) { s["joints"][0]["type"] = "hing"; }), HasSubstr("nearest: \"hinge\""));
  EXPECT_THAT(problem([](json& s) {
                s["joints"][0]["axes"][0] = {1, 0};
              }),
              HasSubstr("/joints/0/axes/0: has 2 elements"));
  EXPECT_THAT(problem([](json& s) { s["joints"][0]["range_rad"][0][1] = 360; }), HasSubstr("between -6.3 and 6.3"));
  EXPECT_THAT(problem([](json& s) { s["joints"][0]["stiffness_Nm_rad"] = -1; }), HasSubstr("/joints/0: stiffness"));
  EXPECT_THAT(problem([](json& s) { s["bodies"][1]["mass_kg"] = 0; }), HasSubstr("/bodies/1/mass_kg: is 0"));
  EXPECT_THAT(problem([](json& s) { s["lines"][0]["points"][1]["kind"] = "end"; }),
              HasSubstr("/lines/0/points/1/kind: is \"end\""));
}

TEST_F(LoadSpecimen, UnknownAndMissingKeysAreNamed) {
  EXPECT_THAT(problem([](json& s) { s["muscels"] = json::array(); }),
              HasSubstr("/muscels: unknown key; the nearest known one is \"muscles\""));
  EXPECT_THAT(problem([](json& s) { s["muscles"][0]["pennation"] = 0; }), HasSubstr("\"pennation_rad\""));
  EXPECT_THAT(problem([](json& s) { s.erase("joints"); }), HasSubstr("the key \"joints\" is missing"));
  EXPECT_THAT(problem([](json& s) { s["bones"][0].erase("file"); }),
              HasSubstr("/bones/0: the key \"file\" is missing"));
}

TEST_F(LoadSpecimen, UnknownNamesSuggestTheNearest) {
  EXPECT_THAT(problem([](json& s) { s["lines"][0]["muscle"] = "flexxor"; }),
              HasSubstr("/lines/0/muscle: names the muscle \"flexxor\" that is not there; the nearest is \"flexor\""));
  EXPECT_THAT(problem([](json& s) { s["joints"][0]["child"] = "lowe"; }), HasSubstr("the nearest is \"lower\""));
  EXPECT_THAT(problem([](json& s) { s["groups"][0]["joint"] = "knee"; }), HasSubstr("the nearest is \"elbow\""));
  EXPECT_THAT(problem([](json& s) { s["bodies"].push_back(s["bodies"][0]); }), HasSubstr("\"upper\" is used twice"));
}

TEST_F(LoadSpecimen, WrapsNameTheirPlaceWhenTheyAreWrong) {
  const json wrap = {{"body", "upper"},
                     {"shape", "cylinder"},
                     {"after", 0},
                     {"centre_m", {0.0, 0.0, 0.0}},
                     {"axis", {0.0, 1.0, 0.0}},
                     {"radius_m", 0.01},
                     {"side", {0.0, 0.0, 1.0}}};
  const auto told = [&](const char* key, const json& value) {
    return problem([&](json& s) {
      s["lines"][0]["wraps"] = json::array({wrap});
      s["lines"][0]["wraps"][0][key] = value;
    });
  };
  EXPECT_THAT(told("body", "uper"), HasSubstr("/lines/0/wraps/0/body: names the body \"uper\" that is not there; the "
                                              "nearest is \"upper\""));
  EXPECT_THAT(told("shape", "cone"), HasSubstr("/lines/0/wraps/0/shape"));
  EXPECT_THAT(told("after", -1), HasSubstr("/lines/0/wraps/0/after"));
  EXPECT_THAT(told("axis", {0.0, 2.0, 0.0}), HasSubstr("line of flexor: wrap 0: its axes must be of length 1"));
  EXPECT_THAT(told("radius", 0.01), HasSubstr("the nearest known one is \"radius_m\""));
  EXPECT_THAT(told("shape", "ellipsoid"), HasSubstr("the key \"radii_m\" is missing"));
}

TEST_F(LoadSpecimen, LinesStayOutOfBones) {
  // The upper bone is 16 mm thick about its middle line.
  EXPECT_THAT(
      problem([](json& s) {
        json via = s["lines"][0]["points"][0];
        via["kind"] = "via";
        via["position_m"] = {-0.1, 0.0, 0.001};
        json& points = s["lines"][0]["points"];
        points.insert(points.begin() + 1, via);
      }),
      HasSubstr("line of flexor: via point 1 lies 7.0 mm inside the bone upper, at most 6.0 are allowed; move"));
  EXPECT_THAT(problem([](json& s) { s["lines"][0]["points"][0]["body"] = "uper"; }),
              HasSubstr("/lines/0/points/0/body: names the body \"uper\" that is not there"));
}

TEST_F(LoadSpecimen, PartsStayInsideTheFolder) {
  for (const char* path : {"../s/bones/upper.ply", "/etc/passwd"}) {
    EXPECT_THAT(problem([&](json& s) { s["bones"][0]["file"] = path; }),
                HasSubstr("/bones/0/file: must be a path inside"));
  }
  EXPECT_THAT(problem([](json& s) { s["bones"][0]["file"] = "bones/gone.ply"; }, ExitStatus::NoInput),
              HasSubstr("gone.ply"));
  problem([](json& s) { s["bones"][0]["file"] = ""; });
  problem([](json& s) { s["bones"][0]["file"] = "muscles/flexor.vtk"; });
}

TEST_F(LoadSpecimen, AChangedPartIsNoticed) {
  const std::string skin = read_file(folder_ / "s/skins/flexor.ply");
  write_file(folder_ / "s/skins/flexor.ply", skin + " ");
  EXPECT_THAT(
      complaint(ExitStatus::BadData, [&] { load_specimen(folder_ / "s"); }),
      AllOf(HasSubstr("/files/skins~1flexor.ply"), HasSubstr("another SHA-256"), HasSubstr("prepare the specimen")));
  write_file(folder_ / "s/skins/flexor.ply", skin);
  EXPECT_EQ(load_specimen(folder_ / "s").muscles.size(), 1u);
}

TEST_F(LoadSpecimen, DefectsEndTheLoad) {
  EXPECT_THAT(problem([](json& s) { s["muscles"][0]["peak_force_N"] = -5; }),
              AllOf(HasSubstr("specimen.json"), HasSubstr("muscle flexor: peak_force_N is -5; must be between")));
}

TEST(FindInSpecimen, ByKeyOrNothing) {
  const Specimen specimen = myotact::testing::antagonist_hinge();
  EXPECT_EQ(find_muscle(specimen, "extensor"), 1);
  EXPECT_EQ(find_muscle(specimen, "extens"), -1);
  EXPECT_EQ(find_joint(specimen, "elbow"), 0);
  EXPECT_EQ(find_body(specimen, "lower"), 1);
  EXPECT_EQ(find_body(specimen, ""), -1);
}

TEST(EmbeddedSpecimens, HoldTheMusclesOfTheirJoints) {
  struct Expected {
    const char* name;
    std::size_t muscles;
    const char* muscle;
    const char* joint;
  };
  for (const Expected& expected : {Expected{"canine_elbow", 7, "biceps_brachii", "elbow"},
                                   Expected{"canine_forelimb", 25, "supraspinatus", "elbow"},
                                   Expected{"canine_hindlimb", 12, "gastrocnemius", "stifle"}}) {
    const Specimen limb = load_specimen(data_folder() / "meshes" / expected.name);
    EXPECT_EQ(limb.muscles.size(), expected.muscles) << expected.name;
    EXPECT_GE(find_muscle(limb, expected.muscle), 0);
    EXPECT_GE(find_joint(limb, expected.joint), 0);
  }
}

TEST(SurveySpecimen, NamesEveryDefectAndReadsTheRest) {
  const myotact::testing::TemporaryFolder folder;
  const auto copy = folder / "elbow";
  std::filesystem::copy(data_folder() / "meshes/canine_elbow", copy, std::filesystem::copy_options::recursive);
  std::filesystem::remove(copy / "skins/anconeus.ply");
  std::string text = read_file(copy / "specimen.json");
  const auto spoil = [&](const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  spoil("\"pennation_rad\": 0.", "\"pennation_rad\": 9.");  // the biceps'
  spoil("\"type\": \"hinge\"", "\"type\": \"hindge\"");
  write_file(copy / "specimen.json", text);
  const SpecimenSurvey survey = survey_specimen(copy);
  EXPECT_EQ(survey.specimen.muscles.size(), 6u);
  std::string all;
  for (const std::string& defect : survey.defects) all += defect + "\n";
  for (const char* told : {"anconeus.ply", "hinge", "biceps_brachii: pennation_rad"}) {
    EXPECT_THAT(all, ::testing::HasSubstr(told));
  }
}

}  // namespace
}  // namespace myotact::anatomy
