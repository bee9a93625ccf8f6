#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "anatomy/specimen.h"

namespace myotact::learn {

/// A muscle or a bone of the specimen, at most one of them.
struct Part {
  int muscle = -1;
  int bone = -1;

  bool operator==(const Part&) const = default;
};

enum class Motion { Flexion, Extension };

// What a step asks of the student; assets/lessons/README.md lists the same with examples.

struct ReadTask {};
struct FindTask {  // click the part
  Part part;
};
struct TouchTask {  // with the tool, for a moment
  Part part;
};
struct NameTask {  // say what is marked
  Part part;
  std::vector<Part> options;        // to choose from, the right one among them; none: it is typed
  std::vector<std::string> accept;  // other names that are right
};
struct PressTask {  // keep the force on the hand within a band
  int muscle = -1;
  double low_N = 0.0, high_N = 0.0;
  double hold_s = 1.0;
};
struct PredictTask {  // answer what the muscle does to the joint, then pull its line and see
  int muscle = -1;
  int joint = -1;
  Motion motion = Motion::Flexion;
  double turn_rad = 0.0;  // the pull rotates the joint at least by this
};
struct StiffenTask {  // by co-contraction, without moving the joint
  int joint = -1;
  double factor = 2.0;      // over the lowest stiffness of the step
  double within_rad = 0.0;  // of the angle at which the step began
  double hold_s = 1.0;
};
struct IdentifyTask {  // feel a part that is not named, then say which it is
  Part part;
  std::vector<Part> options;
};

using Task = std::variant<ReadTask, FindTask, TouchTask, NameTask, PressTask, PredictTask, StiffenTask, IdentifyTask>;

/// "read", "find", ...: the task's name in files and results.
const char* kind_of(const Task& task);

/// How the scene is to look in a step.
struct Show {
  std::optional<std::vector<int>> muscles, bones;  // only these; none: all
  std::vector<Part> faded;
  std::string colour = "activation";  // one of colour_names(); at rest all muscles look alike
  bool labels = false;
};

/// What is set of the scene when a step begins; what is not named stays.
struct Setting {
  std::optional<double> common, difference;  // of co-contraction
  std::optional<double> flexors, extensors;  // levels, both or none
  std::optional<bool> hold_posture, gravity;
};

struct Step {
  std::string title, text;
  std::string view;  // side from which it is seen; empty: as it is
  Show show;
  Setting set;
  Task task;
  std::vector<std::string> hints;  // shown one by one
  double points = 0.0;
};

/// A lesson whose names are resolved against a specimen.
struct Lesson {
  std::string file;  // it was read from
  std::string key, title, scene, author, language;
  std::vector<std::string> sources;
  std::vector<Step> steps;  // at least one
};

/// What can be read of a lesson without a specimen, for lists.
struct LessonHead {
  std::string file, key, title, scene, language;
  int steps = 0;
};

double most_points(const Lesson& lesson);

/// Of the specimen; empty for no part.
std::string key_of(const anatomy::Specimen& specimen, const Part& part);

/// What Show::colour may be; the same words as the view's.
const std::vector<std::string>& colour_names();

}  // namespace myotact::learn
