// Markups as 3D Slicer writes them, and what their names mean.

#include "prepare/guess/markups.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace myotact::prepare {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MarkupsFile : public ::testing::Test {
 protected:
  std::vector<Markup> read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_markups(file_, notes_);
  }

  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::BadData);
      EXPECT_THAT(error.what(), HasSubstr(file_.filename().string()));
      return error.what();
    }
    ADD_FAILURE() << "was accepted: " << text;
    return "";
  }

  testing::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "joint stifle femur tibia.mrk.json";
  std::vector<std::string> notes_;
};

/// All that Slicer 5 writes of a line, in either system.
std::string line_of_slicer(const std::string& system) {
  return R"({
    "@schema": "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/markups-schema-v1.0.3.json#",
    "markups": [{
        "type": "Line", "coordinateSystem": ")" +
         system + R"(", "coordinateUnits": "mm", "locked": false, "fixedNumberOfControlPoints": false,
        "labelFormat": "%N-%d", "lastUsedControlPointNumber": 2,
        "controlPoints": [
            {"id": "1", "label": "L-1", "description": "", "associatedNodeID": "", "position": [10.0, -20.0, 30.0],
             "orientation": [-1.0, -0.0, -0.0, -0.0, -1.0, -0.0, 0.0, 0.0, 1.0], "selected": true, "locked": false,
             "visibility": true, "positionStatus": "defined"},
            {"id": "2", "label": "L-2", "description": "", "associatedNodeID": "", "position": [40.0, -20.0, 30.0],
             "orientation": [-1.0, -0.0, -0.0, -0.0, -1.0, -0.0, 0.0, 0.0, 1.0], "selected": true, "locked": false,
             "visibility": true, "positionStatus": "defined"},
            {"id": "3", "label": "L-3", "position": [0, 0, 0], "positionStatus": "undefined"}],
        "measurements": [{"name": "length", "enabled": true, "value": 30.0, "units": "mm"}],
        "display": {"visibility": true, "opacity": 1.0, "color": [0.4, 1.0, 1.0]}}]})";
}

TEST_F(MarkupsFile, ReadsALineOfSlicerInMillimetres) {
  const auto markups = read(line_of_slicer("LPS"));
  ASSERT_EQ(markups.size(), 1u);
  EXPECT_EQ(markups[0].kind, MarkupKind::Line);
  EXPECT_EQ(markups[0].name, "joint stifle femur tibia");
  ASSERT_EQ(markups[0].points.size(), 2u);
  EXPECT_NEAR((markups[0].points[0].position_m - Vec3(0.01, -0.02, 0.03)).norm(), 0.0, 1e-15);
}

TEST_F(MarkupsFile, TurnsRightAnteriorSuperiorRound) {
  const auto markups = read(line_of_slicer("RAS"));
  EXPECT_NEAR((markups[0].points[1].position_m - Vec3(-0.04, 0.02, 0.03)).norm(), 0.0, 1e-15);
}

TEST_F(MarkupsFile, ReadsUnitsAsAWordOrAsACode) {
  const auto with_units = [](const std::string& units) {
    return R"({"markups": [{"type": "Fiducial", "coordinateUnits": )" + units +
           R"(, "controlPoints": [{"label": "origin a", "position": [1, 2, 3]}]}]})";
  };
  EXPECT_NEAR(read(with_units("[\"cm\", \"UCUM\", \"centimeter\"]"))[0].points[0].position_m.z(), 0.03, 1e-15);
  EXPECT_NEAR(read(with_units("\"m\""))[0].points[0].position_m.z(), 3.0, 1e-15);
  EXPECT_THAT(refusal(with_units("\"inch\"")), HasSubstr("/markups/0/coordinateUnits"));
  EXPECT_THAT(refusal(with_units("7")), HasSubstr("coordinateUnits"));
}

TEST_F(MarkupsFile, LeavesPlanesOutWithANote) {
  EXPECT_TRUE(read(R"({"markups": [{"type": "Plane", "controlPoints": []}]})").empty());
  EXPECT_THAT(notes_.at(0), HasSubstr("Plane"));
}

TEST_F(MarkupsFile, RefusesWhatIsNoMarkup) {
  EXPECT_THAT(refusal("[1, 2]"), HasSubstr("object"));
  EXPECT_THAT(refusal("{}"), HasSubstr("markups"));
  EXPECT_THAT(refusal(R"({"markups": [{}]})"), HasSubstr("/markups/0"));
  EXPECT_THAT(refusal(R"({"markups": [{"type": "Line", "coordinateSystem": "XYZ", "controlPoints": []}]})"),
              HasSubstr("LPS"));
  const auto at_place = [](const std::string& position) {
    return R"({"markups": [{"type": "Fiducial", "controlPoints": [{"label": "a", "position": )" + position + "}]}]}";
  };
  EXPECT_THAT(refusal(at_place("[1, 2]")), HasSubstr("/markups/0/controlPoints/0/position"));
  EXPECT_THAT(refusal(at_place("[1, 2, \"x\"]")), HasSubstr("position"));
  EXPECT_THAT(refusal(at_place("[1e9, 0, 0]")), HasSubstr("Check the unit"));
  EXPECT_THAT(refusal(R"({"markups": [{"type": "Line")"), HasSubstr(": 1:"));
}

Markup points(const std::string& label) {
  return {MarkupKind::Points, "f.mrk.json", "F", {{label, Vec3::UnitX()}}};
}

Markup line(MarkupKind kind, const std::string& name, int count) {
  Markup markup{kind, "l.mrk.json", name, {}};
  for (int i = 0; i < count; ++i) markup.points.push_back({"L-" + std::to_string(i + 1), Vec3(0.01 * i, 0.0, 0.0)});
  return markup;
}

const std::vector<std::string> kBones = {"femur", "os_femoris", "tibia"};
const std::vector<std::string> kMuscles = {"biceps", "digit_1"};

LimbMarks understood(const Markup& markup) {
  return understand_markups({markup}, kBones, kMuscles);
}

std::string not_understood(const Markup& markup) {
  try {
    understood(markup);
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "was understood";
  return "";
}

TEST(UnderstandMarkups, ReadsEndsByLabelWithOrWithoutSlicersNumber) {
  EXPECT_EQ(understood(points("origin biceps")).origins.at(0).muscle, 0);
  EXPECT_EQ(understood(points("Insertion Biceps-3")).insertions.at(0).muscle, 0);
  EXPECT_EQ(understood(points("origin digit_1")).origins.at(0).muscle, 1);
}

TEST(UnderstandMarkups, ReadsJointsWithAndWithoutBones) {
  const MarkedJoint named = understood(line(MarkupKind::Line, "joint stifle femur tibia", 2)).joints.at(0);
  EXPECT_EQ(named.key, "stifle");
  EXPECT_EQ(named.parent, 0);
  EXPECT_EQ(named.child, 2);
  EXPECT_EQ(understood(line(MarkupKind::Line, "joint_stifle_os_femoris_tibia", 2)).joints.at(0).parent, 1);
  EXPECT_EQ(understood(line(MarkupKind::Line, "joint stifle", 2)).joints.at(0).parent, -1);
}

TEST(UnderstandMarkups, RefusesWhatItCannotPlace) {
  EXPECT_THAT(not_understood(points("origin bicps")), HasSubstr("nearest is \"biceps\""));
  EXPECT_THAT(not_understood(points("F-1")), HasSubstr("origin MUSCLE"));
  EXPECT_THAT(not_understood(line(MarkupKind::Line, "joint stifle", 3)), HasSubstr("3 points"));
  EXPECT_THAT(not_understood(line(MarkupKind::Curve, "line biceps", 1)), HasSubstr("two or more"));
  EXPECT_THAT(not_understood(line(MarkupKind::Curve, "C", 4)), HasSubstr("\"joint\" or \"line\""));
  Markup twice = line(MarkupKind::Line, "joint stifle", 2);
  twice.points[1].position_m = twice.points[0].position_m;
  EXPECT_THAT(not_understood(twice), HasSubstr("one place"));
}

}  // namespace
}  // namespace myotact::prepare
