#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/reach.h"
#include "learn/lesson_run.h"
#include "messages/scene_frame.h"
#include "scene/lockstep_session.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::app {

/// What a student answers in the steps that are named (from 1), one after the other: a key, a word or a number, "hint"
/// or "skip". Steps that are not named are answered rightly.
using Answers = std::map<std::size_t, std::vector<std::string>>;

/// Plays a lesson without a window, on a virtual clock: clicks, touches with the scripted hand, presses within the
/// band, pulls lines, raises the co-contraction. Evaluated by the LessonRun as a person at the window is.
class ScriptedStudent {
 public:
  /// The scene's script is empty; all outlive the student.
  ScriptedStudent(const scene::Scene& scene, simulation::Simulation& simulation, scene::LockstepSession& session,
                  learn::LessonRun& run)
      : scene_(&scene), simulation_(&simulation), session_(&session), run_(&run) {}

  /// To the lesson's end.
  void play(const Answers& answers);

 private:
  void begin_step();
  void answer(const std::string& word);
  void wait(double seconds);
  void step();

  void answer_task(const learn::ReadTask&, const std::string&) {}
  void answer_task(const learn::FindTask& task, const std::string& word);
  void answer_task(const learn::TouchTask& task, const std::string& word);
  void answer_task(const learn::NameTask& task, const std::string& word);
  void answer_task(const learn::PressTask& task, const std::string& word);
  void answer_task(const learn::PredictTask& task, const std::string& word);
  void answer_task(const learn::StiffenTask& task, const std::string& word);
  void answer_task(const learn::IdentifyTask& task, const std::string& word);

  /// Until the muscle is touched, at one of its clearest places; false where none can be reached.
  bool touch(int muscle);
  /// Until the lesson has seen the joint rotate, or no place is left to take the line at.
  void pull(int muscle);
  void begin(const scene::Action& action, double duration_s);
  void let_go();
  /// Round the limb at a distance, to the side from which the muscle is reached.
  void go_to_side(int muscle, const Reach& reach);
  Vec3 hand_m() const;
  learn::Part part_of(const std::string& key) const;

  const scene::Scene* scene_;
  simulation::Simulation* simulation_;
  scene::LockstepSession* session_;
  learn::LessonRun* run_;
  messages::SceneFrame frame_;
  learn::Part selected_;
  Vec3 from_ = Vec3::UnitY();  // of the last reach
};

}  // namespace myotact::app
