#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "net/admission.h"
#include "net/frame_stream.h"
#include "net/scene_encoder.h"
#include "scene/conductor.h"
#include "scene/scene_file.h"
#include "simulation/simulation.h"

namespace myotact::remote {

/// Serves a scene on a virtual clock to one client at a time, for tests: the same states get the same bytes.
///
///   client: state of its hand --> server: one step --> model, force and scene frame of the step's end
///
/// The first state only reports where the hand is: it is answered by the scene at rest. Every client finds the scene at
/// its beginning. It has the scene's first tool; other tools have no hand.
class LockstepServer {
 public:
  /// Listens from now on. Throws Error.
  LockstepServer(const net::Endpoint& endpoint, scene::Scene scene, const net::AccessPolicy& access_policy,
                 std::uint64_t seed);

  std::uint16_t port() const { return net::port_of(listener_); }
  /// Client after client, until `stopped` or the simulation fails. Throws Error.
  void serve(const std::function<bool()>& stopped);

 private:
  /// The scene at its beginning.
  struct Run {
    explicit Run(const scene::Scene& scene);
    simulation::Simulation simulation;
    scene::Conductor conductor;
    scene::StepRecord input;
    net::SceneEncoder encoder;
    std::shared_ptr<const net::EncodedScene> shown;
    std::uint64_t clock_ns;
    std::uint64_t steps = 0;
    bool begun = false;
  };

  void serve_client(net::FrameStream& stream, Run& run);
  bool welcome(net::FrameStream& stream, net::Wants& wants);
  bool answer(net::FrameStream& stream, const net::Wants& wants, const messages::ToolState& state, Run& run);
  void step(const messages::ToolState& state, Run& run);
  bool show(net::FrameStream& stream, const net::Wants& wants, const messages::ToolState& state, Run& run);

  net::Socket listener_;
  scene::Scene scene_;
  net::AccessPolicy access_policy_;
  std::string message_;
  std::uint64_t step_ns_;
};

}  // namespace myotact::remote
