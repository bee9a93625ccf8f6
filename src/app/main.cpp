// The program myotact: reads the command line, calls one subcommand, reports every error as one line and a status.

#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <new>

#include <CLI/CLI.hpp>
#include <spdlog/spdlog.h>

#include "app/fit.h"
#include "app/options.h"
#include "app/sweep.h"
#include "core/error.h"
#include "core/log.h"
#include "remote/served_scene.h"

namespace {

using myotact::ExitStatus;
using myotact::app::Options;

void add_common(CLI::App& command, Options& options) {
  command
      .add_option("--device", options.devices,
                  "one device a tool: simulated, simulated:touch (another profile), mouse, or one of \"myotact "
                  "devices\"; two tools: "
                  "NAME,NAME; for a certain hand: left=NAME")
      ->delimiter(',');
  command.add_option("--set", options.set,
                     "override a key of the scene: key=value, e.g. dt_s=0.005 or tissue.default=line");
  command.add_option("--seconds", options.seconds, "simulated time to run [s]")->check(CLI::Range(0.0, 86400.0));
  command.add_option("--seed", options.seed, "seed of everything random")->capture_default_str();
  command.add_option("-o,--out", options.out, "folder for what the command leaves")->capture_default_str();
  command.add_option("--record", options.record, "write a recording to this file");
  command.add_flag("--json", options.json, "machine-readable standard output");
  command.add_option("--log-level", options.log_level, "trace, debug, info, warning, error, critical or off")
      ->capture_default_str();
  command.add_option("--workers", options.workers, "threads of a simulation step")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
}

CLI::App* add_scene_command(CLI::App& program, Options& options, const char* name, const char* what) {
  CLI::App* command = program.add_subcommand(name, what);
  command->add_option("scene", options.scene, "built-in scene or scene file")->capture_default_str();
  add_common(*command, options);
  return command;
}

void add_levels(CLI::App& command, Options& options, const std::string& or_else = "") {
  command
      .add_option("--levels", options.levels,
                  "co-contraction levels 0 .. 1 of the stiffness table: 0,1 or 0:0.1:1" + or_else)
      ->capture_default_str();
}

CLI::App* add_view(CLI::App& program, Options& options) {
  CLI::App* view = add_scene_command(program, options, "view", "the window (default)");
  view->add_option("--session", options.session, "begin with this saved work: its scene, view, settings, notes")
      ->excludes(view->get_option("scene"));
  view->add_option("--report-state", options.report_state,
                   "keep this JSON file up to date with what the window shows and where its controls are, for programs "
                   "that assist a person");
  view->add_option("--camera", options.camera, "a device that rotates the view instead of moving a tool: spacemouse");
  view->add_option("--replay", options.recording, "play this recording in the window; nothing goes to a device")
      ->excludes(view->get_option("--device"));
  auto* connect = view->add_option("--connect", options.connect,
                                   "show the scene of the server at HOST:PORT; with --device mouse one of its hands is "
                                   "here. Its token is in MYOTACT_TOKEN, an instructor's in MYOTACT_INSTRUCTOR_TOKEN");
  connect->excludes(view->get_option("scene"))->excludes(view->get_option("--session"));
  connect->excludes(view->get_option("--replay"))->excludes(view->get_option("--record"));
  view->add_option("--role", options.role, "at the server: a viewer looks on, an instructor changes the scene")
      ->check(CLI::IsMember({"viewer", "student", "instructor"}))
      ->needs(connect);
  return view;
}

void add_look(CLI::App& command, Options& options) {
  command
      .add_option("--view", options.view,
                  "from where pictures look: lateral, medial, cranial, caudal, dorsal, palmar, or azimuth,elevation "
                  "[degrees]")
      ->capture_default_str();
  command.add_option(
      "--show", options.show,
      "what pictures show: muscles=KEYS bones=KEYS faded=KEYS select=KEY layers=deep,bones colour=tension "
      "names=latin section=cranial:0.5 labels=on lines=off fibres=on attachments=on");
}

CLI::App* add_run(CLI::App& program, Options& options) {
  CLI::App* run =
      add_scene_command(program, options, "run", "no window: a scripted hand acts, tables and a picture come out");
  run->add_flag("--realtime", options.realtime,
                "run free on the wall clock, as the window does, and report the timing");
  run->add_option("--png", options.png, "write a picture of the scene at the end to this file");
  run->add_option("--sheet", options.sheet,
                  "write small pictures from four sides, with each joint at both ends of its range, to this file");
  add_look(*run, options);
  run->add_option("--size", options.size, "of pictures [pixels]")->capture_default_str();
  run->add_option("--every", options.every, "keep every n-th tick in samples.csv")->check(CLI::Range(1, 1000000));
  add_levels(*run, options, "; none: no table");
  return run;
}

CLI::App* add_export(CLI::App& program, Options& options) {
  CLI::App* command =
      program.add_subcommand("export", "the limb to print and to share: a poster, a film once round it, a 3D model");
  command->add_option("scene", options.scene, "built-in scene or scene file; for a .feb a case of solve, too")
      ->capture_default_str();
  command
      ->add_option(
          "-o,--out", options.file,
          "file to be written: .png (a poster with names), .mp4 (a film once round the limb, which begins "
          "again where it ends; needs ffmpeg), .glb (3D model, glTF 2.0: every bone and muscle by name; with "
          "--seconds it moves), .vtu (the muscles' tetrahedra for ParaView), .vtp (skins and bones), .pvd "
          "(both at every frame of the script), .feb (muscles at their pose, or a case, for FEBio) or .osim (bones, "
          "joints and muscle lines for OpenSim 4)")
      ->required();
  add_look(*command, options);
  command->add_option("--size", options.export_size,
                      "of poster and film [pixels]; default: 3840x2160 of a poster, 1920x1080 of a film");
  command->add_option("--turn", options.turn_s, "of a film: once round in this time [s]; default: 12")
      ->check(CLI::Range(1.0, 600.0));
  command->add_option("--language", options.language,
                      "of what is written over a poster: en, de; parts have their Latin names in all but en, unless "
                      "--show names= says otherwise");
  command
      ->add_option("--seconds", options.seconds,
                   "play the scene's script so long first [s]; without: the limb as it is balanced at the start")
      ->check(CLI::Range(0.0, 86400.0));
  command
      ->add_option("--every", options.frame_steps,
                   "of what moves: a frame every so many steps of the simulation; default: 20 frames a second")
      ->check(CLI::Range(1, 100000));
  command->add_option("--muscle", options.muscle, "of a .feb: this muscle alone, by its key; without: all");
  command->add_option("--set", options.set, "override a key of the scene: key=value");
  command->add_option("--log-level", options.log_level, "trace, debug, info, warning, error, critical or off")
      ->capture_default_str();
  command->add_option("--workers", options.workers, "threads of a simulation step")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  return command;
}

CLI::App* add_import(CLI::App& program, Options& options) {
  CLI::App* command = program.add_subcommand(
      "import",
      "a model of OpenSim 4 (.osim) as a specimen of muscle lines, and a scene of it; tells what is not taken");
  command->add_option("model", options.file, "model of OpenSim 4: .osim")->required();
  command->add_option("-o,--out", options.out, "folder of the specimen, with scene.json in it")->required();
  command->add_flag("--json", options.json, "machine-readable standard output");
  command->add_option("--log-level", options.log_level, "trace, debug, info, warning, error, critical or off")
      ->capture_default_str();
  return command;
}

CLI::App* add_stiffness(CLI::App& program, Options& options) {
  CLI::App* stiffness = add_scene_command(program, options, "stiffness", "joint stiffness against co-contraction");
  stiffness
      ->add_option("--angles", options.angles,
                   "joint angles q [degrees]: 0,10 or first:step:last; default: the scene's own")
      ->capture_default_str();
  stiffness->add_option("--joint", options.joint,
                        "joint of the specimen; without: the one that the scene co-contracts");
  stiffness->add_option("--shard", options.shard, "measure one part of the table: 2/8 is the second of eight");
  stiffness->add_option("--merge", options.merge, "join the parts of a table instead of measuring: their files");
  add_levels(*stiffness, options);
  return stiffness;
}

CLI::App* add_probe(CLI::App& program, Options& options) {
  CLI::App* probe = program.add_subcommand(
      "probe", "drive the proxy along a path over any surface mesh; out/probe.csv: proxy and force, one row a tick");
  probe->add_option("surface", options.file, "surface [metres]: .ply, .stl, .obj or .off")->required();
  probe->add_option("--path", options.path, "CSV of the device: t_s, x_m, y_m, z_m [seconds, metres]")->required();
  probe->add_option("--frames", options.frames,
                    "folder of a deforming surface: times.csv (file, t_s) and the frames it names");
  probe->add_option("--radius", options.radius_m, "of the proxy sphere [m], 0 .. 0.005")->capture_default_str();
  probe->add_option("--stiffness", options.stiffness_N_m, "of the coupling [N/m], 1 .. 10000")->capture_default_str();
  probe->add_option("--mu", options.friction, "coefficient of friction, 0 .. 2")->capture_default_str();
  probe->add_option("--rate", options.rate_hz, "ticks a second [Hz], 10 .. 100000")->capture_default_str();
  probe->add_option("-o,--out", options.out, "folder for probe.csv")->capture_default_str();
  probe->add_flag("--json", options.json, "machine-readable summary on standard output");
  probe->add_option("--log-level", options.log_level, "trace, debug, info, warning, error, critical or off")
      ->capture_default_str();
  return probe;
}

CLI::App* add_fidelity(CLI::App& program, Options& options) {
  CLI::App* fidelity = add_scene_command(
      program, options, "fidelity",
      "how truly the rendered force follows the simulated one in a scene; with --suite every goal of the rendering");
  fidelity->add_option("--recording", options.recording, "take the hand's path from this recording, not the script");
  fidelity
      ->add_option(
          "--truth", options.truth,
          "what is true: steps (what the scene's own steps gave) or ticks (the path again, simulated with a step of "
          "1 ms: five times slower, and also shows what the scene's step leaves out)")
      ->check(CLI::IsMember({"ticks", "steps"}))
      ->capture_default_str();
  fidelity->add_option("--plant", options.plant,
                       "self-check: put faults into the recorded force and see what is found of them: "
                       "delay_ms=5,scale=0.9,rotate_deg=5,noise_mN=20");
  auto* map =
      fidelity->add_flag("--map", options.map,
                         "touch all over the limb, at random places (--seed) of every muscle: table, pictures, page");
  fidelity->add_option("--places", options.places, "of every muscle that --map touches")
      ->check(CLI::Range(1, 1000))
      ->needs(map)
      ->capture_default_str();
  map->excludes("--recording")->excludes("--plant")->excludes("--truth")->excludes("--seconds");
  fidelity->add_flag("--suite", options.suite, "every goal; minutes")->excludes(map);
  fidelity->add_option("--goal", options.goals, "only these goals, by number: 6,8")->delimiter(',')->excludes(map);
  fidelity->add_flag("--brief", options.brief, "goals: shorter runs, as the tests make them");
  return fidelity;
}

CLI::App* add_lesson(CLI::App& program, Options& options) {
  CLI::App* lesson = program.add_subcommand(
      "lesson",
      "check a lesson and print its steps, or play it with a scripted student; without a name: list them all");
  lesson->add_option("lesson", options.file, "lesson file, or the key of a shipped one or one of your own");
  auto* check = lesson->add_flag("--check")->description("read and check it, print its steps (the default)");
  auto* automatic = lesson->add_flag("--auto", options.automatic,
                                     "play it rightly, without a window; the results as CSV on standard output");
  lesson->add_option("--answers", options.answers, "play it with the answers of this file (assets/lessons/README.md)")
      ->excludes(automatic)
      ->excludes(check);
  automatic->excludes(check);
  add_common(*lesson, options);
  return lesson;
}

CLI::App* add_serve(CLI::App& program, Options& options) {
  CLI::App* serve =
      add_scene_command(program, options, "serve", "simulation server: hands and viewers join over the network");
  serve->add_option("--bind", options.bind, "address to listen at; beyond this machine a token is asked for")
      ->capture_default_str();
  serve->add_option("--port", options.port, "TCP port; 0: a free one")->capture_default_str();
  auto* websocket = serve->add_option("--websocket-port", options.websocket_port, "for browsers; 0: a free one");
  websocket->capture_default_str();
  auto* without_websocket = serve->add_flag("--no-websocket", options.no_websocket, "TCP alone")->excludes(websocket);
  serve
      ->add_flag(
          "--web", options.web,
          "also serve a page for a class: students touch the limb in their browsers; prints its link and QR code")
      ->excludes(without_websocket);
  serve->add_option("--allow-origin", options.origins, "web pages of this origin may connect, as https://lab.example");
  serve
      ->add_option(
          "--hands", options.hands,
          "how many hands the scene has; without: those of the scene, and with --web as many as this machine bears")
      ->check(CLI::Range(std::size_t{1}, myotact::remote::kMostHands));
  serve
      ->add_flag("--lockstep", options.lockstep,
                 "virtual clock, one client at a time: a step whenever its hand has sent its state; for tests")
      ->excludes("--web");
  return serve;
}

CLI::App* add_feel(CLI::App& program, Options& options) {
  CLI::App* feel = program.add_subcommand(
      "feel", "haptic client: owns the device and closes the loop here; the scene is the server's");
  feel->add_option("--connect", options.connect, "HOST:PORT of the server; its token is in MYOTACT_TOKEN")->required();
  feel->add_option("--every", options.every, "keep every n-th tick in samples.csv")->check(CLI::Range(1, 1000000));
  add_common(*feel, options);
  return feel;
}

CLI::App* add_sweep(CLI::App& program, Options& options, myotact::app::SweepWish& wish) {
  CLI::App* sweep = program.add_subcommand(
      "sweep", "any quantities of a scene over any of its keys, point by point, in shards, restartable; one table");
  sweep->add_option("sweep", options.file, "sweep file (docs/sweeps.md)")->required();
  sweep->add_option("--shard", wish.shard, "measure one part of the points: 2/8 is the second of eight");
  sweep->add_flag("--merge", wish.merge, "only join the points in --out to sweep.csv");
  sweep->add_flag("--plan", wish.plan, "only count the points, and measure what one costs here");
  add_common(*sweep, options);
  return sweep;
}

/// Declares all subcommands; returns what the one that was given does.
void declare(CLI::App& program, Options& options, std::function<int(const Options&)>& action) {
  program.set_version_flag("--version", MYOTACT_VERSION);
  program.require_subcommand(0, 1);
  const auto bind = [&](CLI::App* command, int (*function)(const Options&)) {
    command->callback([&action, function] { action = function; });
  };
  bind(add_view(program, options), myotact::app::view);
  bind(add_run(program, options), myotact::app::run);
  bind(add_export(program, options), myotact::app::export_scene);
  bind(add_import(program, options), myotact::app::import_model);
  bind(add_stiffness(program, options), myotact::app::stiffness);
  CLI::App* replay = program.add_subcommand("replay", "run a recording again and compare the states");
  replay->add_option("file", options.file, "recording")->required();
  add_common(*replay, options);
  bind(replay, myotact::app::replay);
  CLI::App* solve = program.add_subcommand("solve", "one finite-element case, its answer as JSON");
  solve->add_option("case", options.file, "case file, or a model of FEBio 4.0 (.feb)")->required();
  solve->add_option("--vtk", options.vtk, "write the deformed mesh to this file, for ParaView");
  add_common(*solve, options);
  bind(solve, myotact::app::solve);
  CLI::App* fit = program.add_subcommand(
      "fit", "material and muscle parameters from measured curves, with confidence intervals and a plot");
  fit->add_option("fit", options.file, "fit file (assets/cases/README.md, Fits)")->required();
  add_common(*fit, options);
  bind(fit, myotact::app::fit);
  const auto wish = std::make_shared<myotact::app::SweepWish>();
  add_sweep(program, options, *wish)->callback([&action, wish] {
    action = [wish](const Options& o) { return myotact::app::sweep(o, *wish); };
  });
  CLI::App* calibrate = program.add_subcommand(
      "calibrate",
      "fit the fibres of a specimen's muscles to their lines, and keep it beside them: it then opens faster");
  calibrate->add_option("specimen", options.file, "specimen folder; calibration.json is written there")->required();
  add_common(*calibrate, options);
  bind(calibrate, myotact::app::calibrate);
  CLI::App* validate =
      program.add_subcommand("validate", "every analytic and published case, expected against obtained");
  validate->add_option("--filter", options.filter, "only the case of this name, or all that have it in their names");
  validate->add_option("--report", options.report, "write a page with the table and plots to this file");
  add_common(*validate, options);
  bind(validate, myotact::app::validate);
  bind(add_fidelity(program, options), myotact::app::fidelity);
  bind(add_probe(program, options), myotact::app::probe);
  bind(add_lesson(program, options), myotact::app::lesson);
  bind(add_serve(program, options), myotact::app::serve);
  bind(add_feel(program, options), myotact::app::feel);
  CLI::App* devices = program.add_subcommand("devices", "which devices there are, and why one does not open");
  auto* test = devices->add_option("--test", options.test_device,
                                   "check one with you: reach, buttons, a gentle push along each axis, rate");
  devices
      ->add_option("--calibrate", options.calibrate_device,
                   "calibrate one with you: what it asks for, and its force scale where that is a setting")
      ->excludes(test);
  add_common(*devices, options);
  bind(devices, myotact::app::devices);
}

/// Whoever names nothing to be shown, nor how long, is a person who has just started it.
bool names_nothing(const CLI::App& program, const Options& options) {
  const bool names_scene = program.get_subcommand("view")->get_option("scene")->count() > 0;
  return !names_scene && !options.session && !options.connect && !options.recording && !options.seconds;
}

int report(ExitStatus status, const std::string& text) {
  spdlog::error("{}", text);
  return static_cast<int>(status);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Feel the muscles of a dog's limb. Not a medical device.", "myotact");
  Options options;
  std::function<int(const Options&)> action = myotact::app::view;
  declare(program, options, action);
  try {
    program.parse(argc, argv);
    myotact::start_log(options.log_level);
    options.offers_start = names_nothing(program, options);
    return action(options);
  } catch (const CLI::ParseError& failure) {
    return program.exit(failure) == 0 ? 0 : static_cast<int>(ExitStatus::Usage);
  } catch (const myotact::Error& failure) {
    return report(failure.status(), failure.what());
  } catch (const std::bad_alloc&) {
    return report(ExitStatus::Internal, "out of memory; use a smaller specimen");
  } catch (const std::exception& failure) {
    return report(ExitStatus::Internal, failure.what());
  }
}
