#include <algorithm>
#include <map>
#include <variant>

#include <gtest/gtest.h>

#include "learn/lesson_file.h"
#include "learn/lesson_list.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"
#include "support/source_folder.h"

// What the shipped lessons say is what the model shows.

namespace myotact::learn {
namespace {

struct Shipped {
  scene::Scene scene;
  Lesson lesson;
};

/// All muscles as lines: moment arms depend on the lines alone.
const std::vector<Shipped>& shipped() {
  static const std::vector<Shipped> kLessons = [] {
    std::vector<Shipped> lessons;
    for (const ListedLesson& listed : list_lessons()) {
      if (!listed.path.string().starts_with(source_folder())) continue;
      EXPECT_EQ(listed.complaint, "");
      scene::Scene scene = scene::load_scene(listed.head.scene, {{"tissue.default", "line"}});
      scene.settings.shapes = false;  // nobody looks
      Lesson lesson = load_lesson(listed.path, scene.specimen);
      lessons.push_back({std::move(scene), std::move(lesson)});
    }
    return lessons;
  }();
  return kLessons;
}

TEST(ShippedLessons, AreTwelveAndNameTheirSources) {
  EXPECT_GE(shipped().size(), 12u);
  for (const Shipped& one : shipped()) {
    EXPECT_FALSE(one.lesson.sources.empty()) << one.lesson.key;
    EXPECT_EQ(std::filesystem::path(one.lesson.file).stem(), one.lesson.key);
  }
}

TEST(ShippedLessons, EveryPredictedMotionIsTheSignOfTheSimulatedMomentArm) {
  int predictions = 0;
  for (const Shipped& one : shipped()) {
    const auto predicts = [](const Step& step) { return std::holds_alternative<PredictTask>(step.task); };
    if (std::none_of(one.lesson.steps.begin(), one.lesson.steps.end(), predicts)) continue;
    simulation::Simulation simulation(one.scene.specimen, one.scene.settings);
    std::vector<double> angles_rad;
    for (const auto& joint : one.scene.joints) angles_rad.push_back(joint.angle_rad);
    simulation.settle(angles_rad, one.scene.activations);
    for (const Step& step : one.lesson.steps) {
      const auto* predict = std::get_if<PredictTask>(&step.task);
      if (predict == nullptr) continue;
      ++predictions;
      const double moment_arm_m = simulation.muscle_at_joint(predict->muscle, predict->joint).moment_arm_m;
      EXPECT_GT(std::abs(moment_arm_m), 0.005) << step.title << ": too short to be asked for";
      EXPECT_EQ(moment_arm_m > 0.0, predict->motion == Motion::Flexion) << one.lesson.key << ", " << step.title;
    }
  }
  EXPECT_GE(predictions, 8);
}

TEST(ShippedLessons, WhatIsToBeFoundIsDrawn) {
  for (const Shipped& one : shipped()) {
    for (const Step& step : one.lesson.steps) {
      const auto* find = std::get_if<FindTask>(&step.task);
      const auto* name = std::get_if<NameTask>(&step.task);
      if (find == nullptr && name == nullptr) continue;
      const Part part = find != nullptr ? find->part : name->part;
      const auto& list = part.muscle >= 0 ? step.show.muscles : step.show.bones;
      const int index = part.muscle >= 0 ? part.muscle : part.bone;
      const bool drawn = !list || std::find(list->begin(), list->end(), index) != list->end();
      EXPECT_TRUE(drawn) << one.lesson.key << ", " << step.title;
    }
  }
}

/// The figures that the texts quote [mm].
TEST(ShippedLessons, QuotedMomentArmsAreTheSimulatedOnes) {
  const std::map<std::string, std::map<std::string, double>> quoted_mm = {
      {"2_pull_a_line", {{"biceps_brachii", 11.0}, {"brachialis", 11.0}, {"triceps_brachii_long", -32.0}}},
      {"5_hock", {{"gastrocnemius", -35.0}, {"tibialis_cranialis", 11.0}}}};
  for (const Shipped& one : shipped()) {
    const auto quoted = quoted_mm.find(one.lesson.key);
    if (quoted == quoted_mm.end()) continue;
    simulation::Simulation simulation(one.scene.specimen, one.scene.settings);
    simulation.settle(std::vector<double>(one.scene.joints.size(), 0.0), one.scene.activations);
    for (const auto& [key, moment_arm_mm] : quoted->second) {
      const int muscle = anatomy::find_muscle(one.scene.specimen, key);
      const double simulated_m = simulation.muscle_at_joint(muscle, one.scene.co_contraction->joint).moment_arm_m;
      EXPECT_NEAR(1e3 * simulated_m, moment_arm_mm, 1.0) << key;
    }
  }
}

}  // namespace
}  // namespace myotact::learn
