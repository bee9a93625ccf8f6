#include "app/scripted_student.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace myotact::app {

namespace {

constexpr std::size_t kTries = 6;    // places at which a muscle is looked for
constexpr double kApproach_s = 0.8;  // of the scripted hand, from 30 mm before the skin
constexpr double kDepth_m = 0.004;   // of the device below the skin: felt, and far from the end of its force

std::string key_of_option(const std::vector<learn::Part>& options, const learn::Part& part,
                          const anatomy::Specimen& specimen) {
  const bool given = std::find(options.begin(), options.end(), part) != options.end();
  return given || options.empty() ? learn::key_of(specimen, part) : "";
}

std::size_t place_of(const std::vector<learn::Part>& options, const learn::Part& part) {
  return static_cast<std::size_t>(std::find(options.begin(), options.end(), part) - options.begin());
}

}  // namespace

void ScriptedStudent::play(const Answers& answers) {
  while (!run_->finished()) {
    const std::size_t index = run_->index();
    begin_step();
    const auto given = answers.find(index + 1);
    const std::vector<std::string> words = given == answers.end() ? std::vector<std::string>{""} : given->second;
    for (const std::string& word : words) {
      if (!run_->state().done) answer(word);
    }
    let_go();
    run_->go_on();
  }
}

void ScriptedStudent::begin_step() {
  selected_ = {};
  const learn::Setting& set = run_->step().set;
  const auto set_scene = [&](const messages::Order& order) {
    session_->conductor().apply({order, messages::Commander::Lesson});
  };
  if (set.gravity) set_scene(messages::SetGravity{*set.gravity});
  if (set.hold_posture) set_scene(messages::HoldPosture{*set.hold_posture});
  if (set.common || set.difference) {
    set_scene(messages::CoContract{set.common.value_or(0.0), set.difference.value_or(0.0)});
  }
  if (set.flexors) set_scene(messages::SetLevels{*set.flexors, *set.extensors});
  constexpr double kRead_s = 1.0;  // until all is at rest
  wait(kRead_s);
}

void ScriptedStudent::answer(const std::string& word) {
  if (word == "hint") return run_->ask_hint();
  if (word == "skip") return;
  std::visit([&](const auto& task) { answer_task(task, word); }, run_->step().task);
}

void ScriptedStudent::step() {
  session_->step();
  simulation_->write_frame(frame_);
  frame_.tools = session_->tool_frames();
  run_->observe({scene_->specimen, frame_, simulation_->time_s(), selected_});
}

void ScriptedStudent::wait(double seconds) {
  const auto steps = static_cast<int>(std::ceil(seconds / scene_->settings.dt_s));
  for (int i = 0; i < steps; ++i) step();
}

learn::Part ScriptedStudent::part_of(const std::string& key) const {
  if (const int muscle = anatomy::find_muscle(scene_->specimen, key); muscle >= 0) return {muscle, -1};
  const auto& bones = scene_->specimen.bones;
  const auto bone = std::find_if(bones.begin(), bones.end(), [&](const auto& b) { return b.key == key; });
  return bone == bones.end() ? learn::Part{} : learn::Part{-1, static_cast<int>(bone - bones.begin())};
}

void ScriptedStudent::answer_task(const learn::FindTask& task, const std::string& word) {
  selected_ = word.empty() ? task.part : part_of(word);
  step();
}

void ScriptedStudent::answer_task(const learn::TouchTask& task, const std::string& word) {
  const learn::Part part = word.empty() ? task.part : part_of(word);
  if (part.muscle >= 0 && touch(part.muscle)) wait(0.5);
}

void ScriptedStudent::answer_task(const learn::NameTask& task, const std::string& word) {
  const std::string name = word.empty() ? learn::key_of(scene_->specimen, task.part) : word;
  if (task.options.empty()) return run_->type(name);
  run_->choose(place_of(task.options, part_of(name)));
}

void ScriptedStudent::answer_task(const learn::PressTask& task, const std::string& word) {
  if (!touch(task.muscle)) return;
  const double wanted_N = parse_number(word).value_or(0.5 * (task.low_N + task.high_N));
  // Half of what a spring of the coupling alone would need: the tissue and the device give way as well.
  const double gain_m_N = 0.5 / scene_->tools.front().stiffness_N_m;
  constexpr double kMost_m = 0.001, kCorrection_s = 0.1, kPatience_s = 6.0;
  for (double spent_s = 0.0; spent_s < kPatience_s + task.hold_s && !run_->state().done; spent_s += kCorrection_s) {
    const double short_N = wanted_N - run_->state().force_N;
    const double deeper_m = std::clamp(gain_m_N * short_N, -kMost_m, kMost_m);
    begin(scene::MoveHand{hand_m() - deeper_m * from_}, kCorrection_s);
    wait(kCorrection_s);
  }
}

void ScriptedStudent::answer_task(const learn::PredictTask& task, const std::string& word) {
  const bool flexion = word.empty() ? task.motion == learn::Motion::Flexion : word == "flexion";
  run_->predict(flexion ? learn::Motion::Flexion : learn::Motion::Extension);
  pull(task.muscle);
}

void ScriptedStudent::answer_task(const learn::StiffenTask& task, const std::string& word) {
  constexpr double kRise = 0.1, kEach_s = 0.5;
  const double most = parse_number(word).value_or(1.0);
  for (double common = kRise; common < most + 0.5 * kRise && !run_->state().done; common += kRise) {
    session_->conductor().apply({messages::CoContract{std::min(common, most), 0.0}});
    wait(kEach_s);
  }
  if (!run_->state().done) wait(task.hold_s + kEach_s);
}

void ScriptedStudent::answer_task(const learn::IdentifyTask& task, const std::string& word) {
  if (!run_->state().touched && task.part.muscle >= 0 && touch(task.part.muscle)) wait(0.5);
  const std::string key = word.empty() ? key_of_option(task.options, task.part, scene_->specimen) : word;
  run_->choose(place_of(task.options, part_of(key)));
}

Vec3 ScriptedStudent::hand_m() const {
  return session_->conductor().hand(0, simulation_->time_s()).position_world_m;
}

void ScriptedStudent::begin(const scene::Action& action, double duration_s) {
  session_->conductor().begin({simulation_->time_s(), duration_s, action, 0});
}

void ScriptedStudent::let_go() {
  const bool busy =
      !frame_.tools.empty() && (frame_.tools.front().in_contact || frame_.tools.front().grabbed_line >= 0);
  if (!busy) return;
  constexpr double kRelease_s = 0.4;
  begin(scene::ReleaseHand{}, kRelease_s);
  wait(kRelease_s);
}

void ScriptedStudent::go_to_side(int muscle, const Reach& reach) {
  constexpr double kAside_m = 0.16;  // out of reach of every muscle of a limb
  constexpr double kArc_rad = 0.8;   // 45 degrees: the chord passes 0.15 m from the middle
  constexpr double kLeg_s = 0.35;    // 0.13 m: half of the speed at which the gate lets go
  const Vec3 target_m = scene::point_at_fraction(simulation_->line_world_m(muscle), reach.at);
  const Vec3 start_m = hand_m();
  const auto angle_of = [](const Vec3& v) { return std::atan2(v.y(), v.x()); };
  const double start_rad = angle_of(start_m - target_m);
  const double turn_rad = std::remainder(angle_of(reach.from) - start_rad, 2.0 * 3.14159265358979323846);
  const int legs = 1 + static_cast<int>(std::abs(turn_rad) / kArc_rad);
  for (int leg = 0; leg <= legs; ++leg) {
    const double angle_rad = start_rad + turn_rad * leg / legs;
    const Vec3 aside_m = target_m + kAside_m * Vec3(std::cos(angle_rad), std::sin(angle_rad), 0.0);
    begin(scene::MoveHand{aside_m}, kLeg_s);
    wait(kLeg_s);
  }
  from_ = reach.from;
}

bool ScriptedStudent::touch(int muscle) {
  const std::vector<Reach> reaches = reaches_of(muscle, scene_->specimen, *simulation_);
  for (std::size_t i = 0; i < std::min(kTries, reaches.size()); ++i) {
    let_go();
    go_to_side(muscle, reaches[i]);
    begin(scene::TouchMuscle{muscle, reaches[i].at, reaches[i].from, kDepth_m}, kApproach_s);
    wait(kApproach_s);
    const messages::ToolFrame& tool = frame_.tools.front();
    if (tool.in_contact && tool.touched_muscle == muscle) return true;
  }
  return false;
}

void ScriptedStudent::pull(int muscle) {
  constexpr double kDrag_m = 0.010, kPull_s = 3.0;
  const std::vector<Reach> reaches = reaches_of(muscle, scene_->specimen, *simulation_);
  for (std::size_t i = 0; i < std::min(kTries, reaches.size()) && !run_->state().done; ++i) {
    let_go();
    go_to_side(muscle, reaches[i]);
    begin(scene::GrabLine{muscle, reaches[i].at, reaches[i].from, kDrag_m * reaches[i].from}, kPull_s);
    for (double passed_s = 0.0; passed_s < kPull_s && !run_->state().done; passed_s += scene_->settings.dt_s) step();
  }
}

}  // namespace myotact::app
