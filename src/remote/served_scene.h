#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "net/hand_table.h"
#include "net/server.h"
#include "remote/classroom.h"
#include "scene/free_session.h"
#include "scene/scene_file.h"

namespace myotact::remote {

/// Of one scene: a class. What each costs a step stands in the README's table of a class.
inline constexpr std::size_t kMostHands = 32;

struct ServeSettings {
  net::Endpoint endpoint;
  net::ServerSettings server;  // its scene and step are filled in here
  std::uint64_t seed = 1;
};

/// The scene with `hands` tools: those of the file, repeated, right and left hands alternating.
scene::Scene with_hands(scene::Scene scene, std::size_t hands);

/// A scene on the wall clock whose hands are clients of a server; nothing is felt here.
///
///   clients --ToolState--> FreeSession's simulation thread --LocalModel--> clients
///                               '--newest frame--> [encoder thread] --> all who watch
class ServedScene {
 public:
  /// Listens from now on. All references outlive it; `recorder` may be null. Throws Error.
  ServedScene(const scene::Scene& scene, simulation::Simulation& simulation, const ServeSettings& settings,
              scene::RecordingWriter* recorder);
  ~ServedScene();

  void start();
  /// Rethrows what ended the simulation, if anything did.
  scene::FreeTiming stop();
  bool running() const { return session_.running(); }

  /// One thread, many times a second: what instructors asked for goes to the simulation, what is of the class to all.
  void obey();

  /// The link by which students join, for instructors to hand on. By the thread that obeys.
  void invite(const std::string& link) { class_.invite(link); }

  net::Server& server() { return *server_; }
  double time_s() const { return time_s_; }  // simulated

 private:
  void encode_frames();
  void obey(const net::ControlRequest& request);
  void tell_class();

  std::vector<std::unique_ptr<net::HandChannels>> channels_;
  net::HandTable hands_;
  std::unique_ptr<net::Server> server_;
  scene::FreeSession session_;  // after the server, whose bell it rings to its end
  Classroom class_;
  std::chrono::steady_clock::time_point told_at_;
  std::atomic<double> time_s_{0.0};
  std::atomic<bool> closing_{false};
  std::thread encoder_;
};

}  // namespace myotact::remote
