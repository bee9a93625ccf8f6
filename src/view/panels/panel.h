#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "anatomy/part_facts.h"
#include "anatomy/specimen.h"
#include "messages/device_report.h"
#include "messages/moment.h"
#include "messages/scene_frame.h"
#include "view/look/part.h"
#include "view/look/view_state.h"
#include "view/session/saved_work.h"
#include "view/state/joint_readings.h"
#include "view/state/scene_controls.h"
#include "view/state/view_controls.h"

namespace myotact::view {

/// A ready state of co-contraction.
struct Preset {
  std::string name;  // of its text demonstrate.preset.NAME; shown itself where there is none
  double common = 0.0, difference = 0.0;
};

/// What does not change while a scene is open.
struct SceneFacts {
  std::string name, title;
  std::string file;                         // by which it is opened: a name or a path
  std::string tissue;                       // of all muscles, as asked for; empty: as the scene says
  std::string note;                         // what a person should know about its settings
  std::vector<double> device_peaks_N{3.3};  // of the tools' devices
  std::vector<bool> shows_force_only;       // of the tools' devices, as of a mouse; none: all move the hand
  double replay_s = 0.0;                    // length of the recording that is played; 0: the scene is simulated
  bool is_served = false;                   // another machine simulates it, with hands of others in it
  int joint = 0;                            // that is watched: co-contracted, or the first
  std::vector<Preset> presets;
  std::vector<std::string> scenes;  // that can be opened by name
};

/// Of one device on the table.
struct DeviceNews {
  std::string name;   // as --device takes it
  bool left = false;  // hand
  messages::DeviceReport report;
  bool clutched = false;  // its clutch is held, here or on the device
};

/// A class that joins the scene in browsers.
struct ClassNews {
  std::string join_link;  // that students open
  std::size_t students = 0, hands_up = 0;
};

/// What the session is about.
struct SessionNews {
  bool opening = false;                  // another scene is being built
  double silence_s = 0.0;                // since the simulation reported anything: a step that does not end
  std::vector<DeviceNews> devices = {};  // on the table: neither mouse nor simulated ones
  std::optional<ClassNews> class_in = {};
};

/// A class that another machine serves.
struct ClassToJoin {
  std::string address;  // HOST:PORT
  std::string token;    // 32 hexadecimal digits; empty: none is needed
};

/// A scene to be opened.
struct SceneWish {
  std::string scene;                                 // name or path
  std::string tissue;                                // "fem", "line" ...; empty: as the scene says
  std::optional<std::filesystem::path> recording;    // file to record it to
  std::optional<SavedWork> work = {};                // that it is to begin with
  std::optional<std::filesystem::path> replay = {};  // recording to be played in place of the scene
  std::optional<ClassToJoin> to_join = {};           // in place of a scene that is simulated here
};

/// What the mouse is over the scene.
enum class PointerMode { Look, Touch, Pull };

/// What the person wrote about a part, kLongestNote characters at most; an empty text is no note.
struct PartNote {
  std::string part, text;  // key of the muscle or bone
};

/// One press of a key or button changes the common level of co-contraction by this.
inline constexpr double kCoContractionStep = 0.05;

/// What a panel asks of the window itself, once.
struct WindowAsks {
  std::optional<PointerMode> pointer_mode;
  const char* standard_view = nullptr;  // to look from; null: none
  bool frame_selection = false;         // to come near what is selected; all when nothing is
  bool undo = false, redo = false;
  bool help = false;                               // to be shown or hidden
  bool start = false;                              // the page of what the program is for
  bool big_type = false;                           // for a class, to begin or to end
  double co_contraction_step = 0.0;                // to be added to the common level
  std::optional<bool> free_orbit;                  // was switched on or off
  bool record = false, film = false;               // to begin, or to end
  std::optional<SceneWish> wish;                   // a scene to be opened
  std::optional<PartNote> note;                    // to be kept
  bool write_note = false;                         // about the selected part
  std::optional<std::vector<Bookmark>> bookmarks;  // from now on
  std::optional<Camera> turn_to;                   // the view to rotate to
  std::optional<std::string> save_work;            // under this name; empty: the scene's
  std::optional<std::filesystem::path> open_work;  // a saved work
  std::optional<messages::Moment> go_on;           // from this earlier moment
  bool recordings = false;                         // their list to be shown or hidden
  bool works = false;                              // their list to be shown or hidden
  std::string message;                             // a sentence for the person to read
  Part menu_of;                                    // the menu of this part is to open under the pointer
};

/// What every panel gets to read and to change, each picture anew. Panels draw with ImGui between its NewFrame and
/// Render, and keep to themselves what only they need.
struct PanelContext {
  const anatomy::Specimen& specimen;
  const messages::SceneFrame& frame;
  const SceneFacts& facts;
  const JointReadings& readings;
  const SessionNews& news;
  const anatomy::FactsByKey& part_facts;
  const Marks& marks;      // of the person, about this specimen
  Part hovered;            // under the pointer, in the scene or in a list
  bool filming;            // a film is being taken
  ViewState& view;         // how it is looked at
  ViewControls& controls;  // what the person holds and moves
  SceneControls& scene;    // what is in force, and what is asked for
  WindowAsks& asks;
};

}  // namespace myotact::view
