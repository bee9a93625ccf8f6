#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/recording.h"
#include "scene/scene_file.h"

namespace myotact::app {

/// Options that every subcommand knows, and those of single ones. Defaults are what --help shows.
struct Options {
  std::string scene = "elbow";
  std::vector<std::string> set;  // key=value
  std::vector<std::string> devices;
  std::optional<double> seconds;
  std::uint64_t seed = 1;
  std::filesystem::path out = "out";
  std::optional<std::filesystem::path> record;
  std::optional<std::filesystem::path> session;       // view: a saved work to begin with
  bool offers_start = false;                          // view: no scene was named, so it asks what for
  std::optional<std::string> camera;                  // view: the device that rotates it
  std::optional<std::filesystem::path> report_state;  // view: what the window shows, as JSON, kept up to date
  bool json = false;
  std::string log_level = "info";
  bool realtime = false;
  std::optional<std::filesystem::path> sheet;  // run, as the four below
  std::optional<std::filesystem::path> png;
  std::string view = "lateral";
  std::vector<std::string> show;
  std::string size = "900x1200";
  std::optional<std::string> export_size;  // export, as the four below; without: what suits the file
  std::optional<double> turn_s;            // of a film, once round the limb
  std::optional<int> frame_steps;          // of what moves: steps of the simulation from frame to frame
  std::optional<std::string> language;     // of what is written over pictures
  std::optional<std::string> muscle;       // the one that is written as finite elements
  int every = 1;
  int workers = 2;
  std::string angles;  // stiffness: a number list, degrees; empty: the scene's own
  std::string levels = "0:0.25:1";
  std::optional<std::string> joint;  // stiffness
  std::string shard;
  std::vector<std::filesystem::path> merge;
  std::filesystem::path file;                // replay, solve, probe, lesson, import; export: what is written
  std::optional<std::filesystem::path> vtk;  // solve
  std::string filter;                        // validate
  std::optional<std::filesystem::path> report;
  bool suite = false;                              // fidelity: every goal
  std::vector<int> goals;                          // fidelity: these goals
  bool brief = false;                              // fidelity: seconds instead of minutes
  bool map = false;                                // fidelity: touch all over the limb
  int places = 6;                                  // of it: of every muscle
  std::optional<std::filesystem::path> recording;  // to be played (view), or followed (fidelity)
  std::string truth = "steps";                     // fidelity
  std::string plant;                               // fidelity: faults to be found again; empty: none
  std::optional<std::filesystem::path> answers;    // lesson: what the scripted student answers
  bool automatic = false;                          // lesson: the student answers rightly
  std::filesystem::path path;                      // probe: where the device goes
  std::optional<std::filesystem::path> frames;     // probe: folder of a deforming surface
  double radius_m = 3e-3;                          // probe, as the three below
  double stiffness_N_m = 800.0;
  double friction = 0.3;
  double rate_hz = 1000.0;
  std::optional<std::string> test_device;       // devices: the one to be checked with a person's help
  std::optional<std::string> calibrate_device;  // devices: the one to be calibrated with a person's help
  std::string bind = "127.0.0.1";               // serve, as the eight below
  std::uint16_t port = 7480;
  std::uint16_t websocket_port = 7481;
  bool no_websocket = false;
  bool web = false;                  // a page for browsers, too
  std::vector<std::string> origins;  // of web pages elsewhere that may connect
  std::optional<std::size_t> hands;  // without: those of the scene
  bool lockstep = false;
  std::optional<std::string> connect;  // feel, view: HOST:PORT of a server
  std::string token;                   // as typed in the window, for that server; empty: MYOTACT_TOKEN
  std::string role;                    // view, at that server; empty: a student's with a hand, else a viewer's
};

/// --set. Throws Error Usage for one without "=".
Overrides overrides_of(const Options& options);
/// The same without what is about devices.
Overrides scene_overrides_of(const Options& options);

/// One of --device: NAME, or HAND=NAME.
struct NamedDevice {
  std::string hand;  // "left" or "right"; empty: not given
  std::string name;
};
/// Throws Error Usage: an unknown hand.
std::vector<NamedDevice> named_devices(const Options& options);

/// --device for the tools of a scene. Throws Error: Unavailable for one that is not known, Usage for too many.
void take_devices(const Options& options, scene::Scene& scene);

/// The scene of the command line with --set, --device and --workers applied.
scene::Scene scene_of(const Options& options);

/// --levels. Throws Error Usage for one outside 0 .. 1.
std::vector<double> levels_of(const Options& options);

/// A recorder on the file of --record, or null. `profiles`: of the devices, one a tool. Throws Error InputOutput.
std::unique_ptr<scene::RecordingWriter> open_recorder(const Options& options, const scene::Scene& scene,
                                                      const std::vector<device::DeviceProfile>& profiles);

// One function a subcommand, in the file of its name. Each returns the exit status of the program or throws Error.
int run(const Options& options);
int export_scene(const Options& options);
int import_model(const Options& options);
int view(const Options& options);
int stiffness(const Options& options);
int replay(const Options& options);
int solve(const Options& options);
int validate(const Options& options);
int calibrate(const Options& options);
int fidelity(const Options& options);
/// fidelity plane, fidelity plate: the force methods over the layer's engines. None: another scene.
std::optional<int> layer_fidelity(const Options& options);
/// fidelity --map
int touch_map(const Options& options);
int probe(const Options& options);
int devices(const Options& options);
int lesson(const Options& options);
int serve(const Options& options);
int feel(const Options& options);

}  // namespace myotact::app
