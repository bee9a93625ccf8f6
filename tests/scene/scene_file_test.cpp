#include "scene/scene_file.h"

#include <filesystem>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "core/file.h"
#include "scene/fascia_file.h"
#include "support/synthetic_specimen.h"

namespace myotact::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A folder with the two-muscle specimen, removed at the end.
class SceneFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("myotact_scene_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    anatomy::save_specimen(myotact::testing::antagonist_hinge(), folder_ / "hinge");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Scene parse(const std::string& more, const Overrides& overrides = {}) const {
    return parse_scene(R"({"schema": 1, "name": "s", "specimen": "hinge")" + more + "}", folder_ / "s.json", overrides);
  }

  std::string complaint(const std::string& more) const {
    try {
      parse(more);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData);
      return error.what();
    }
    return "nothing";
  }

  std::filesystem::path folder_;
};

TEST_F(SceneFile, FillsDefaultsAndResolvesNames) {
  const Scene scene = parse(R"(, "co_contraction": {"joint": "elbow", "common": 0.5},
    "activations": {"extensor": 0.25}, // as at rest
    "script": [{"t_s": 1, "do": "activate", "muscle": "flexor", "to": 1, "duration_s": 2}])");
  ASSERT_EQ(scene.tools.size(), 1u);
  ASSERT_TRUE(scene.co_contraction.has_value());
  EXPECT_EQ(scene.co_contraction->flexors.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.settings.dt_s, 0.01);
  ASSERT_EQ(scene.script.size(), 1u);
  EXPECT_DOUBLE_EQ(scene.script[0].end_s(), 3.0);
  EXPECT_DOUBLE_EQ(scene.activations[static_cast<std::size_t>(anatomy::find_muscle(scene.specimen, "extensor"))], 0.25);
}

constexpr const char* kTwoTools =
    R"(, "tools": [{"device": "simulated"}, {"device": "simulated", "hand": "left", "shape": "clamp"}], "script": )";

TEST_F(SceneFile, AnActionIsTheFirstToolsUnlessItNamesAHand) {
  const Scene scene = parse(kTwoTools + std::string(R"([
    {"t_s": 0, "do": "grab_bone", "hand": "left", "bone": "lower", "from": [1, 0, 0], "drag_m": [0, 0, 0], "duration_s": 3},
    {"t_s": 1, "do": "release", "duration_s": 1}, {"t_s": 1.5, "do": "activate", "muscle": "flexor", "to": 1},
    {"t_s": 2, "do": "release", "hand": "right"}])"));
  ASSERT_EQ(scene.tools.size(), 2u);
  EXPECT_EQ(scene.tools[1].shape, messages::ToolShape::Clamp);
  ASSERT_EQ(scene.script.size(), 4u);
  EXPECT_EQ(scene.script[0].tool, 1u);
  EXPECT_EQ(scene.script[1].tool, 0u);
  EXPECT_EQ(scene.script[3].tool, 0u);
}

TEST_F(SceneFile, OneHandCannotDoTwoThingsAtOnce) {
  const std::string release = R"({"t_s": 0, "do": "release", "duration_s": 2}, )";
  EXPECT_THAT(complaint(kTwoTools + ("[" + release + R"({"t_s": 1, "do": "release", "hand": "right"}])")),
              HasSubstr("/script/1: starts at 1 s, before the same hand's action 0 ends at 2 s"));
  EXPECT_EQ(complaint(kTwoTools + ("[" + release + R"({"t_s": 1, "do": "release", "hand": "left"}])")), "nothing");
  EXPECT_EQ(complaint(kTwoTools + ("[" + release + R"({"t_s": 2, "do": "release"}])")), "nothing");
}

TEST_F(SceneFile, HandsMustBeThere) {
  EXPECT_THAT(complaint(R"(, "script": [{"t_s": 0, "do": "release", "hand": "left"}])"),
              HasSubstr("/script/0/hand: the scene has no tool for the left hand"));
  EXPECT_THAT(complaint(kTwoTools + std::string(R"([{"t_s": 0, "do": "picture", "view": "lateral", "hand": "left"}])")),
              HasSubstr("hand"));  // no hand takes pictures
  EXPECT_THAT(complaint(R"(, "tools": [{"device": "simulated"}, {"device": "simulated"}])"),
              HasSubstr("both tools are for the right hand"));
  EXPECT_THAT(complaint(R"(, "tools": [{"device": "a"}, {"device": "b", "hand": "left"}, {"device": "c"}])"),
              HasSubstr("/tools/2"));
}

TEST_F(SceneFile, APointIsFinerThanABall) {
  const auto radius = [&](const std::string& key) {
    return parse(R"(, "tools": [{"device": "simulated", )" + key + "}]").tools.front().radius_m;
  };
  EXPECT_EQ(radius(R"("shape": "point")"), 0.5e-3);
  EXPECT_EQ(radius(R"("shape": "ball")"), 3e-3);
  EXPECT_EQ(radius(R"("shape": "point", "radius_m": 0.0004)"), 0.4e-3);
  EXPECT_THAT(complaint(R"(, "tools": [{"device": "simulated", "shape": "point", "radius_m": 0.003}])"),
              HasSubstr("/tools/0/radius_m"));
  EXPECT_THAT(complaint(R"(, "tools": [{"device": "simulated", "shape": "cube"}])"), HasSubstr("ball"));
}

TEST_F(SceneFile, AToolsForcesAreBounded) {
  const auto tool = [](const std::string& key) { return R"(, "tools": [{"device": "simulated", )" + key + "}]"; };
  EXPECT_EQ(parse("").tools.front().force_limit, 0.5);
  EXPECT_EQ(parse("").tools.front().line_snap_N, 0.0);
  EXPECT_EQ(parse(tool(R"("line_snap_N": 0.1)")).tools.front().line_snap_N, 0.1);
  EXPECT_EQ(parse(tool(R"("force_limit": 1)")).tools.front().force_limit, 1.0);
  EXPECT_THAT(complaint(tool(R"("line_snap_N": 2)")), HasSubstr("/tools/0/line_snap_N"));
  EXPECT_THAT(complaint(tool(R"("force_limit": 1.5)")), HasSubstr("/tools/0/force_limit"));
}

TEST_F(SceneFile, AToolNamesItsForceMethod) {
  const auto tool = [](const std::string& key) { return R"(, "tools": [{"device": "simulated", )" + key + "}]"; };
  EXPECT_EQ(parse("").tools.front().method, haptics::ForceMethod::Proxy);
  EXPECT_EQ(parse(tool(R"("method": "proxy")")).tools.front().method, haptics::ForceMethod::Proxy);
  EXPECT_EQ(parse(tool(R"("method": "penetration")")).tools.front().method, haptics::ForceMethod::Penetration);
  EXPECT_EQ(parse(tool(R"("method": "plane")")).tools.front().method, haptics::ForceMethod::Plane);
  EXPECT_EQ(parse(tool(R"("method": "pulling")")).tools.front().method, haptics::ForceMethod::Pulling);
  EXPECT_THAT(complaint(tool(R"("method": "planes")")), HasSubstr("plane"));
}

TEST_F(SceneFile, TakesOneTissueModelForAllAndOneForAMuscle) {
  const Scene scene = parse(R"(, "tissue": {"default": "mass_spring", "muscles": {"extensor": "fem"}})");
  const auto model = [&](const char* key) {
    return scene.settings.tissue.at(static_cast<std::size_t>(anatomy::find_muscle(scene.specimen, key)));
  };
  EXPECT_EQ(model("flexor"), simulation::TissueModel::MassSpring);
  EXPECT_EQ(model("extensor"), simulation::TissueModel::Fem);
  EXPECT_EQ(parse(R"(, "tissue": {"default": "line"})").settings.tendon, simulation::Tendon::Elastic);
  EXPECT_EQ(parse(R"(, "tissue": {"tendon": "rigid"})").settings.tendon, simulation::Tendon::Rigid);
  EXPECT_THAT(complaint(R"(, "tissue": {"default": "lines"})"), HasSubstr("line"));
}

TEST_F(SceneFile, MusclesTouchBonesAndEachOtherUnlessItSaysOtherwise) {
  EXPECT_EQ(parse("").settings.contact, simulation::Contact::All);
  EXPECT_EQ(parse(R"(, "contact": true)").settings.contact, simulation::Contact::All);
  EXPECT_EQ(parse(R"(, "contact": "bones")").settings.contact, simulation::Contact::Bones);
  EXPECT_EQ(parse(R"(, "contact": false)").settings.contact, simulation::Contact::None);
  EXPECT_THAT(complaint(R"(, "contact": "bone")"),
              AllOf(HasSubstr("/contact"), HasSubstr("\"bone\""), HasSubstr("must be true, false or \"bones\"")));
}

TEST_F(SceneFile, FasciaIsThereWhereItIsAskedFor) {
  EXPECT_DOUBLE_EQ(parse("").settings.fascia.tension_Pa_m, 0.0);
  EXPECT_DOUBLE_EQ(parse(R"(, "fascia": false)").settings.fascia.tension_Pa_m, 0.0);
  const simulation::Fascia fascia = parse(R"(, "fascia": true)").settings.fascia;
  EXPECT_GT(fascia.tension_Pa_m, fascia.shear_Pa_m);  // soft along
  EXPECT_GT(fascia.shear_Pa_m, 0.0);
  EXPECT_GT(fascia.reach_m, 0.0);
  EXPECT_THAT(complaint(R"(, "fascia": 3)"), HasSubstr("/fascia"));
}

TEST_F(SceneFile, FasciaThatIsStifferAlongThanAcrossIsRefused) {
  write_file(folder_ / "stiff.json", R"({"schema": 1, "tension_Pa_m": 1e6, "shear_Pa_m": 2e6, "reach_m": 0.001})");
  try {
    read_fascia(folder_ / "stiff.json");
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::BadData);
    EXPECT_THAT(error.what(), ::testing::AllOf(HasSubstr("stiff.json"), HasSubstr("/shear_Pa_m")));
  }
}

TEST_F(SceneFile, ReadsTheFrictionOfATool) {
  const auto tool = [](const std::string& friction) {
    return R"(, "tools": [{"device": "simulated", "friction": )" + friction + "}]";
  };
  const ToolSettings read = parse(tool(R"({"static": 0.4, "dynamic": 0.2, "stribeck_m_s": 0.02,
    "along_over_across": 0.5, "viscous_Ns_m": 1.5})"))
                                .tools.front();
  EXPECT_EQ(read.static_friction, 0.4);
  EXPECT_EQ(read.dynamic_friction, 0.2);
  EXPECT_EQ(read.stribeck_m_s, 0.02);
  EXPECT_EQ(read.along_over_across, 0.5);
  EXPECT_EQ(read.viscous_Ns_m, 1.5);
  EXPECT_THAT(complaint(tool(R"({"static": 0.2, "dynamic": 0.3})")), HasSubstr("/tools/0/friction/dynamic"));
  EXPECT_THAT(complaint(tool(R"({"static": 0.3, "dynamic": 0.3, "stribeck_m_s": 0})")), HasSubstr("stribeck_m_s"));
  EXPECT_THAT(complaint(tool(R"({"static": 0.3, "dynamic": 0.3, "along_over_across": 9})")), HasSubstr("between"));
  EXPECT_THAT(complaint(tool(R"({"static": 0.3, "dynamic": 0.3, "viscous": 1})")), HasSubstr("viscous_Ns_m"));
}

TEST_F(SceneFile, ReadsTheTextureOfATool) {
  const auto tool = [](const std::string& texture) {
    return R"(, "tools": [{"device": "simulated", "texture": )" + texture + "}]";
  };
  const auto waves_of = [&](const std::string& texture, messages::Tissue tissue) {
    return parse(tool(texture)).tools.front().texture.by_tissue[static_cast<std::size_t>(tissue)].relief.size();
  };
  EXPECT_EQ(waves_of("false", messages::Tissue::Muscle), 0u);
  EXPECT_GT(waves_of("true", messages::Tissue::Muscle), 0u);
  EXPECT_EQ(waves_of("true", messages::Tissue::Skin), 0u);
  EXPECT_GT(waves_of(R"("bone")", messages::Tissue::Skin), 0u);
  EXPECT_THAT(complaint(tool(R"("bones")")), HasSubstr("nearest: \"bone\""));
  EXPECT_THAT(complaint(tool("3")), HasSubstr("/tools/0/texture"));
}

TEST_F(SceneFile, AWeldCannotBeCoContracted) {
  anatomy::Specimen fused = myotact::testing::antagonist_hinge();
  anatomy::Joint& joint = fused.joints[0];
  joint.type = anatomy::JointType::Weld;
  joint.axes.clear();
  joint.range_rad.clear();
  anatomy::save_specimen(fused, folder_ / "fused");
  try {
    parse(R"(, "co_contraction": {"joint": "elbow"})", {{"specimen", "fused"}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/co_contraction/joint: this joint does not rotate"));
  }
}

TEST_F(SceneFile, OverridesReplaceKeys) {
  EXPECT_DOUBLE_EQ(parse("", {{"dt_s", "0.005"}}).settings.dt_s, 0.005);
  const Scene scene = parse(R"(, "tissue": {"muscles": {"extensor": "fem"}})", {{"tissue.default", "line"}});
  EXPECT_EQ(scene.settings.tissue[static_cast<std::size_t>(anatomy::find_muscle(scene.specimen, "flexor"))],
            simulation::TissueModel::Line);
  EXPECT_EQ(scene.settings.tissue[static_cast<std::size_t>(anatomy::find_muscle(scene.specimen, "extensor"))],
            simulation::TissueModel::Fem);
}

TEST_F(SceneFile, RefusesMusclesThatCannotCoContract) {
  EXPECT_THAT(complaint(R"(, "co_contraction": {"joint": "elbow", "presets": [{"name": "a", "common": 2}]})"),
              HasSubstr("/co_contraction/presets/0/common"));
  EXPECT_THAT(complaint(R"(, "co_contraction": {"joint": "elbow", "extensors": ["flexor"]})"),
              HasSubstr("\"flexor\" is on both sides"));
  anatomy::Specimen specimen = myotact::testing::antagonist_hinge();
  for (anatomy::LinePoint& point : specimen.lines[0].points) point.body = 0;
  anatomy::save_specimen(specimen, folder_ / "hinge");
  EXPECT_THAT(complaint(R"(, "co_contraction": {"joint": "elbow"})"),
              HasSubstr("/co_contraction: \"flexor\" does not cross the joint \"elbow\""));
}

TEST_F(SceneFile, ChoosesWhereFibresWork) {
  const Scene scene = parse(R"(, "rest_stretch": {"flexor": 0.7})");
  EXPECT_EQ(
      scene.specimen.muscles[static_cast<std::size_t>(anatomy::find_muscle(scene.specimen, "flexor"))].rest_stretch,
      0.7);
  EXPECT_THAT(complaint(R"(, "rest_stretch": {"flexor": 7})"), HasSubstr("must be between 0.3 and 1.8"));
}

/// A line of the flexor by hand that ends on `body`, through a point at height `z_m` over the middle of the upper bone.
std::string line_by_hand(const std::string& body, const std::string& z_m) {
  return R"({"muscle": "flexor", "points": [
    {"body": "upper", "position_m": [-0.15, 0, 0.03], "kind": "origin"},
    {"body": "upper", "position_m": [-0.1, 0, )" +
         z_m + R"(], "kind": "via"},
    {"body": ")" +
         body + R"(", "position_m": [0.05, 0, 0.03], "kind": "insertion"}]})";
}

TEST_F(SceneFile, LinesByHandReplaceTheSpecimens) {
  const Scene scene = parse(R"(, "lines": [)" + line_by_hand("lower", "0.02") + "]");
  ASSERT_EQ(scene.specimen.lines.size(), scene.specimen.muscles.size());
  const int flexor = anatomy::find_muscle(scene.specimen, "flexor");
  for (const anatomy::MuscleLine& line : scene.specimen.lines) {
    if (line.muscle != flexor) continue;
    ASSERT_EQ(line.points.size(), 3u);
    EXPECT_EQ(line.points[1].position_m, Vec3(-0.1, 0.0, 0.02));
  }
  const auto told = [&](const std::string& lines) { return complaint(R"(, "lines": [)" + lines + "]"); };
  EXPECT_THAT(told(line_by_hand("lower", "0.002")),
              HasSubstr("/lines/0: line of flexor: via point 1 lies 6.0 mm inside"));
  EXPECT_THAT(told(line_by_hand("upper", "0.02")), HasSubstr("crosses no joint"));
  EXPECT_THAT(told(line_by_hand("louer", "0.02")), HasSubstr("the nearest is \"lower\""));
  const std::string line = line_by_hand("lower", "0.02");
  EXPECT_THAT(told(line + "," + line), HasSubstr("/lines/1: this muscle has a line already"));
}

TEST_F(SceneFile, OverridesMustBeText) {
  try {
    parse("", {{"title", "\xff"}});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::Usage);
  }
}

TEST_F(SceneFile, ErrorsNamePlaceAndNearestWord) {
  EXPECT_THAT(complaint(R"(, "activations": {"flexer": 1})"), HasSubstr("nearest is \"flexor\""));
  EXPECT_THAT(complaint(R"(, "activations": {"flexor": 2})"),
              HasSubstr("/activations/flexor: is 2; must be between 0"));
  EXPECT_THAT(complaint(R"(, "activation": {})"), HasSubstr("nearest known one is \"activations\""));
  EXPECT_THAT(complaint(R"(, "dt_s": "fast")"), HasSubstr("/dt_s"));
  EXPECT_THAT(complaint(R"(, "script": [{"t_s": 0, "do": "grab_bone", "bone": "louer", "from": [1, 0, 0]}])"),
              HasSubstr("no bone \"louer\"; the nearest is \"lower\""));
  EXPECT_THAT(complaint(R"(, "script": [{"t_s": 0, "do": "grab_bone", "bone": "lower", "from": [1, 0, 0]}])"),
              HasSubstr("drag_m"));
  EXPECT_THAT(complaint(R"(, "script": [{"t_s": 0, "do": "tuch"}])"), HasSubstr("nearest: \"touch\""));
  EXPECT_THAT(complaint(R"(, "script": [{"t_s": 1, "do": "release"}, {"t_s": 0, "do": "release"}])"),
              HasSubstr("/script/1"));
  EXPECT_THAT(complaint(R"(, "joints": {"elbow": {"q_rad": 9}})"), HasSubstr("/joints/elbow/q_rad"));
  EXPECT_THAT(complaint(R"(, "co_contraction": {"joint": "knee"})"), HasSubstr("nearest is \"elbow\""));
}

TEST_F(SceneFile, MissingThingsAreNoInput) {
  for (const auto& make :
       {std::function<void()>([&] { load_scene("elbo"); }),
        std::function<void()>([&] { load_scene(std::string(5000, 'a')); }), std::function<void()>([&] {
          parse("", {{"specimen", std::string(5000, 'a')}});
        }),
        std::function<void()>([&] {
          parse("", {{"specimen", "nowhere"}});
        })}) {
    try {
      make();
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::NoInput);
    }
  }
}

}  // namespace
}  // namespace myotact::scene
