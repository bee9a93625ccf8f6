#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "net/admission.h"
#include "net/doorbell.h"
#include "net/hand_table.h"
#include "net/picture_encoder.h"
#include "net/scene_encoder.h"
#include "net/small_frames.h"

namespace myotact::net {

struct ServerSettings {
  std::string scene_json;     // sent to every client after its Welcome
  std::vector<Bytes> meshes;  // payloads of Mesh frames, sent after it to clients that want them
  std::uint64_t step_ns = 0;  // of the simulation
  AccessPolicy access_policy;
  std::size_t most_connections = 64;  // a class, its instructors and some mirrors
  std::size_t most_waiting = 40;      // that have not said Hello yet; a new one takes the place of the oldest
  std::chrono::milliseconds hello_wait{3000};
  std::chrono::milliseconds silence{3000};    // clients ping ten times a second; one that is silent so long is gone
  std::chrono::milliseconds slow_wait{2000};  // a reader that takes nothing for so long is closed
  double most_frames_per_s = 100e3;           // of one client; what comes faster waits in its own socket
  double most_controls_per_s = 50.0;          // of an instructor
  double most_student_controls_per_s = 20.0;  // who raises a hand, answers, is through with a step
};

/// What a client asked for by a Control frame.
struct ControlRequest {
  std::uint32_t client = 0;
  Role role = Role::Viewer;
  std::string text;  // UTF-8
};

/// One who has joined.
struct ClientFacts {
  std::uint32_t id = 0;
  Role role = Role::Viewer;
  int hand = -1;  // of the scene's tools, -1: none
  std::string name;

  bool operator==(const ClientFacts&) const = default;
};

/// What is said to all clients that want announcements, as Control frames: JSON of at most kMostControl bytes.
struct Announcement {
  std::string to_all;          // but instructors
  std::string to_instructors;  // who are told more
};

struct ServerCounters {
  std::uint64_t accepted = 0, refused = 0, failed = 0, closed_slow = 0, closed_silent = 0, dropped_controls = 0;
  std::array<std::uint64_t, kWireFaults> faults{};  // bad frames by kind
};

/// What the connections of a server share. Any thread but a haptic one.
class ServerState {
 public:
  ServerState(const ServerSettings& settings, HandTable& hands) : settings(settings), hands(hands) {}

  const ServerSettings settings;
  HandTable& hands;
  Doorbell bell;  // models, scene frames or a stop are new
  std::atomic<std::uint32_t> stops{0};
  std::atomic<std::uint32_t> next_client{1};
  std::atomic<int> watchers{0};          // clients that want scene frames
  std::atomic<int> picture_watchers{0};  // clients that want pictures
  std::atomic<std::size_t> admitted{0};  // clients after their Hello
  std::atomic<bool> rests{false};        // all hands but instructors' touch and hold nothing

  void show(std::shared_ptr<const EncodedScene> scene);
  std::shared_ptr<const EncodedScene> scene() const;
  void show(std::shared_ptr<const ScenePicture> picture);
  std::shared_ptr<const ScenePicture> picture() const;
  void announce(std::shared_ptr<const Announcement> announcement);
  std::shared_ptr<const Announcement> announcement() const;

  /// False: too many wait to be obeyed.
  bool ask(ControlRequest request);
  std::optional<ControlRequest> take_request();

  void count(std::uint64_t ServerCounters::*counter);
  void count(WireFault fault);
  ServerCounters counters() const;
  /// True the first time that it is asked for this text: a log that thousands of bad clients cannot fill.
  bool is_new_complaint(const std::string& text);

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const EncodedScene> scene_;
  std::shared_ptr<const ScenePicture> picture_;
  std::shared_ptr<const Announcement> announcement_;
  std::deque<ControlRequest> requests_;
  ServerCounters counters_;
  std::set<std::string> complaints_;
};

}  // namespace myotact::net
