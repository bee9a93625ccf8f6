#include "view/panels/lesson_look.h"

#include <gtest/gtest.h>

#include "learn/lesson_file.h"
#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

/// What a step of these members makes of a view in which all is otherwise.
struct Looked {
  explicit Looked(const std::string& members)
      : specimen(testing::antagonist_hinge()), view(start_view(specimen, 1.0f)) {
    lesson = learn::parse_lesson(
        R"({"schema": 1, "key": "l", "title": "T", "scene": "s", "steps": [{"title": "S", "text": "X", )" + members +
            "}]}",
        "l.json", specimen);
    view.muscles[1] = {true, true};
    view.bones[0].faded = true;
    view.section.on = true;
    view.selected_bone = 1;
    before = view;
    show_step(lesson.steps[0], view, scene);
  }
  anatomy::Specimen specimen;
  learn::Lesson lesson;
  ViewState view, before;
  SceneControls scene{{}};
};

TEST(LessonLook, AStepThatSaysNothingShowsEverything) {
  const Looked looked(R"("points": 0)");
  EXPECT_EQ(looked.view.muscles, std::vector<PartLook>(2));
  EXPECT_EQ(looked.view.bones, std::vector<PartLook>(2));
  EXPECT_FALSE(looked.view.section.on);
  EXPECT_EQ(looked.view.selected_bone, -1);
  EXPECT_EQ(looked.view.camera, looked.before.camera);
  EXPECT_FALSE(looked.view.names_hidden);
  EXPECT_TRUE(looked.scene.asked().empty());
}

TEST(LessonLook, ShowsSetsAndLooksAsTheStepSays) {
  const Looked looked(R"("view": "medial", "show": {"muscles": ["extensor"], "bones": [], "faded": ["extensor"],
    "labels": true, "colour": "tension"}, "set": {"common": 0.4, "hold_posture": true, "gravity": true})");
  EXPECT_EQ(looked.view.muscles, (std::vector<PartLook>{{true, false}, {false, true}}));
  EXPECT_EQ(looked.view.bones, (std::vector<PartLook>{{true, false}, {true, false}}));
  EXPECT_EQ(looked.view.colour, MuscleColour::Tension);
  EXPECT_TRUE(looked.view.labels);
  EXPECT_EQ(looked.scene.state().drive, Drive::Balance);
  EXPECT_EQ(looked.scene.state().common, 0.4);
  EXPECT_TRUE(looked.scene.state().hold_posture);
  EXPECT_TRUE(looked.scene.state().gravity);
  for (const messages::Command& command : looked.scene.asked()) EXPECT_EQ(command.by, messages::Commander::Lesson);
  const Looked levels(R"("set": {"flexors": 0.25, "extensors": 0.75})");
  EXPECT_EQ(levels.scene.state().drive, Drive::Levels);
  EXPECT_EQ(levels.scene.state().extensors, 0.75);
}

TEST(LessonLook, NoNameIsOnTheScreenWhereOneIsAskedFor) {
  for (const char* task : {R"({"kind": "find", "part": "flexor"})",
                           R"({"kind": "identify", "part": "flexor", "options": ["flexor", "extensor"]})",
                           R"({"kind": "predict", "muscle": "flexor", "joint": "elbow", "motion": "flexion"})",
                           R"({"kind": "name", "part": "flexor"})"}) {
    const Looked looked(R"("show": {"labels": true}, "task": )" + std::string(task));
    EXPECT_TRUE(looked.view.names_hidden) << task;
    EXPECT_FALSE(looked.view.labels) << task;
  }
  EXPECT_FALSE(Looked(R"("task": {"kind": "touch", "part": "flexor"})").view.names_hidden);
}

TEST(LessonLook, TheMouseIsWhatTheTaskNeeds) {
  EXPECT_EQ(pointer_mode_for(learn::PressTask{}), PointerMode::Touch);
  EXPECT_EQ(pointer_mode_for(learn::PredictTask{}), PointerMode::Pull);
  EXPECT_EQ(pointer_mode_for(learn::FindTask{}), PointerMode::Look);
}

TEST(LessonLook, WhatIsToBeNamedIsMarkedAndAllIsThereAgainAfterwards) {
  Looked looked(R"("show": {"bones": []}, "task": {"kind": "name", "part": "extensor"})");
  EXPECT_EQ(looked.view.selected_muscle, 1);
  end_lesson_look(looked.view);
  EXPECT_EQ(looked.view.selected_muscle, -1);
  EXPECT_FALSE(looked.view.names_hidden);
  EXPECT_EQ(looked.view.bones, std::vector<PartLook>(2));
}

TEST(LessonLook, APartOfALessonIsThatOfTheView) {
  EXPECT_EQ(part_of({0, -1}), (Part{PartKind::Muscle, 0}));
  EXPECT_EQ(part_of({-1, 1}), (Part{PartKind::Bone, 1}));
  EXPECT_FALSE(part_of({-1, -1}));
}

}  // namespace
}  // namespace myotact::view
