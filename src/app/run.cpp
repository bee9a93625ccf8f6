#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include "app/hands.h"
#include "app/interruption.h"
#include "app/options.h"
#include "app/picture.h"
#include "app/stiffness_chart.h"
#include "app/timing_report.h"
#include "core/error.h"
#include "core/file.h"
#include "device/profile_file.h"
#include "device/simulated_device.h"
#include "haptics/faults.h"
#include "measure/shove_report.h"
#include "measure/stiffness_sweep.h"
#include "scene/extremes.h"
#include "scene/free_session.h"
#include "scene/lockstep_session.h"
#include "scene/recording.h"
#include "scene/samples.h"

namespace myotact::app {

namespace {

constexpr double kForever_s = 1e12;
constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// What is written at the end of a run, whichever way it ran.
struct RunSummary {
  double simulated_s = 0.0, wall_s = 0.0;
  std::uint64_t steps = 0;
  scene::Extremes extremes;
  scene::ShoveRecord shove;  // joint -1: none was asked for
  std::string notice;        // what the device does not support of the scene's settings
  nlohmann::json realtime;   // timing of a run on the wall clock
};

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<device::DeviceProfile> simulated_profiles(const scene::Scene& scene) {
  std::vector<device::DeviceProfile> profiles;
  for (const scene::ToolSettings& tool : scene.tools) profiles.push_back(device::simulated_profile(tool.device));
  return profiles;
}

PictureWish picture_of(const Options& options) {
  return {options.view, options.show, view::picture_size_of(options.size)};
}

/// A picture that was not asked for is left out without OpenGL.
void write_scene_picture(const Options& options, const scene::Scene& scene, const simulation::Simulation& simulation,
                         const std::vector<messages::ToolFrame>& tools, const PictureWish& wish) {
  try {
    write_picture(scene, simulation, tools, wish, options.out / "scene.png");
  } catch (const Error& failure) {
    if (failure.status() != ExitStatus::Unavailable) throw;
    spdlog::warn("{}", failure.what());
  }
}

/// The picture of --png, else scene.png unless the script had one taken.
void write_last_picture(const Options& options, const scene::Scene& scene, const simulation::Simulation& simulation,
                        const std::vector<messages::ToolFrame>& tools, bool pictured) {
  const PictureWish wish = picture_of(options);
  if (options.png) {
    write_picture(scene, simulation, tools, wish, *options.png);
  } else if (!pictured) {
    write_scene_picture(options, scene, simulation, tools, wish);
  }
}

RunSummary run_lockstep(const Options& options, const scene::Scene& scene, simulation::Simulation& simulation) {
  const auto recorder = open_recorder(options, scene, simulated_profiles(scene));
  scene::SampleTable samples(scene.specimen, scene::hands_of(scene), options.every);
  scene::LockstepSession session(scene, simulation, samples, recorder.get());
  const double end_s = options.seconds.value_or(session.conductor().script_end_s());
  const auto steps = static_cast<std::uint64_t>(std::llround(end_s / scene.settings.dt_s));
  RunSummary summary;
  Stopwatch stopwatch;
  bool pictured = false;
  std::string notice;
  for (; summary.steps < steps && interruption() == 0; ++summary.steps) {
    session.step();
    if (const std::string now = session.conductor().notice(); now != notice) {
      if (!now.empty()) spdlog::warn("at {} s: {}", simulation.time_s(), now);
      notice = now;
    }
    if (const auto wanted = session.conductor().take_picture()) {
      PictureWish wish = picture_of(options);
      wish.view = wanted->view;
      write_scene_picture(options, scene, simulation, session.tool_frames(), wish);
      pictured = true;
    }
  }
  summary.wall_s = stopwatch.seconds();
  summary.simulated_s = simulation.time_s();
  summary.extremes = session.extremes();
  summary.notice = session.notice();
  summary.shove = session.conductor().shove_test().record();
  write_last_picture(options, scene, simulation, session.tool_frames(), pictured);
  if (recorder) recorder->close();
  write_file(options.out / "samples.csv", samples.csv());
  return summary;
}

RunSummary run_free(const Options& options, const scene::Scene& scene, simulation::Simulation& simulation,
                    GuardedMotors& guarded, const Equipment& equipment) {
  RunSummary summary;
  const Hands hands(scene, scene.tools.size(), guarded, equipment);
  const auto recorder = open_recorder(options, scene, hands.profiles());
  scene::FreeSession session(scene, simulation, hands.devices(), recorder.get(), hands.ticking());
  summary.notice = session.notice();
  // A person's hand has no end; a signal ends it.
  const double end_s = options.seconds.value_or(equipment.empty() ? session.script_end_s() : kForever_s);
  session.start();
  messages::SceneFrame frame;
  HintLog hints(equipment);
  while (session.running() && interruption() == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    hints.look();
    session.fetch_frame(frame);
    if (frame.time_s >= end_s) break;
  }
  session.stop();
  const scene::FreeTiming timing = session.timing();
  if (!session.recording_fault().empty()) throw Error(ExitStatus::InputOutput, session.recording_fault());
  summary.simulated_s = timing.simulated_s;
  summary.wall_s = timing.wall_s;
  summary.steps = timing.steps;
  summary.extremes = timing.extremes;
  write_last_picture(options, scene, simulation, frame.tools, false);
  summary.realtime = timing_json(timing, scene);
  return summary;
}

/// Of one tool, or over all of them.
nlohmann::json touch_json(const scene::ToolExtremes& reached) {
  return {{"largest_force_N", reached.force_N},
          {"largest_line_tension_N", reached.line_tension_N},
          {"contact_s", reached.contact_s},
          {"bone_in_hand_s", reached.bone_s},
          {"fault_bits", reached.faults},
          {"faults", haptics::describe_faults(static_cast<std::uint32_t>(reached.faults))}};
}

nlohmann::json summary_json(const scene::Scene& scene, const RunSummary& summary) {
  scene::ToolExtremes all;
  for (const scene::ToolExtremes& tool : summary.extremes.tools) {
    all.force_N = std::max(all.force_N, tool.force_N);
    all.line_tension_N = std::max(all.line_tension_N, tool.line_tension_N);
    all.contact_s += tool.contact_s;
    all.bone_s += tool.bone_s;
    all.faults |= tool.faults;
  }
  nlohmann::json json = touch_json(all);
  for (std::size_t t = 0; t < scene.tools.size() && scene.tools.size() > 1; ++t) {
    json[scene.tools[t].hand] = touch_json(summary.extremes.tools[t]);
  }
  json.update(
      {{"scene", scene.name},
       {"specimen", scene.specimen.name},
       {"muscles", scene.specimen.muscles.size()},
       {"simulated_s", summary.simulated_s},
       {"wall_s", summary.wall_s},
       {"steps", summary.steps},
       {"steps_per_s", summary.wall_s > 0.0 ? static_cast<double>(summary.steps) / summary.wall_s : 0.0},
       {"largest_drift_deg", summary.extremes.drift_rad * kDegrees},
       {"largest_residual_share", summary.extremes.residual_share},
       {"largest_volume_error", summary.extremes.volume_error},
       {"smallest_J", summary.extremes.smallest_J},
       {"mean_muscles_asleep",
        summary.steps > 0 ? static_cast<double>(summary.extremes.asleep) / static_cast<double>(summary.steps) : 0.0},
       {"notice", summary.notice}});
  return json;
}

nlohmann::json shove_json(const scene::ShoveRecord& record) {
  const measure::ShoveReport report = measure::report_shove(record);
  return {{"K_pushed_Nm_rad", report.pushed_stiffness_Nm_rad},
          {"K_read_Nm_rad", report.read_stiffness_Nm_rad},
          {"frequency_sqrt_K_I_hz", report.undamped_frequency_hz},
          {"frequency_linear_hz", report.mode.frequency_hz},
          {"damping_ratio_linear", report.mode.damping_ratio},
          {"frequency_measured_hz", report.measured_frequency_hz},
          {"swing_error", report.swing_error},
          {"why", report.why}};
}

/// Sweep and chart at the scene's own angle, on fresh simulations: the run's end does not matter to it. Null when
/// interrupted.
nlohmann::json measure_stiffness(const Options& options, const scene::Scene& scene, std::vector<double> levels) {
  const double q_rad = scene.joints[static_cast<std::size_t>(scene.co_contraction->joint)].angle_rad;
  measure::SweepWatch watch;
  watch.stopped = [] { return interruption() != 0; };
  const auto rows = measure::sweep_stiffness(scene, {{q_rad}, std::move(levels)}, watch);
  if (interruption() != 0) return nullptr;
  write_file(options.out / "stiffness.csv", measure::stiffness_csv(rows));
  write_stiffness_chart(rows, scene.title, options.out / "stiffness.svg");
  return measure::stiffness_json(rows);
}

}  // namespace

int run(const Options& options) {
  std::optional<GuardedMotors> guarded;
  if (options.realtime) guarded.emplace();  // first: the watchdog is forked off before there are threads
  scene::Scene scene = scene_of(options);
  if (!options.realtime) {
    refuse_equipment(options, "a hand moves on the wall clock; add --realtime, or use \"myotact view\"");
  }
  const Equipment equipment(options);
  leave_hands_to_people(scene, scene.tools.size());
  const std::vector<double> levels = options.levels == "none" ? std::vector<double>{} : levels_of(options);
  check_picture(scene, picture_of(options));
  make_writable_folder(options.out);
  if (!scene.note.empty()) spdlog::info("{}: {}", scene.name, scene.note);
  watch_for_interruption();
  if (options.sheet) write_sheet(scene, options.show, *options.sheet);
  RunSummary summary;
  {
    simulation::Simulation simulation(scene.specimen, scene.settings);
    summary = options.realtime ? run_free(options, scene, simulation, *guarded, equipment)
                               : run_lockstep(options, scene, simulation);
  }
  if (!summary.notice.empty()) spdlog::warn("{}", summary.notice);
  nlohmann::json report = summary_json(scene, summary);
  if (options.realtime) report["realtime"] = summary.realtime;
  if (summary.shove.joint >= 0) report["shove"] = shove_json(summary.shove);
  if (scene.co_contraction && !levels.empty() && interruption() == 0) {
    report["stiffness"] = measure_stiffness(options, scene, levels);
  }
  write_file(options.out / "summary.json", report.dump(2) + "\n");
  if (options.json) {
    std::cout << report.dump(2) << std::endl;
  } else {
    print_summary(report, std::cout);
  }
  return interruption();
}

}  // namespace myotact::app
