#include "remote/lockstep_server.h"

#include <cmath>
#include <utility>

#include <spdlog/spdlog.h>

#include "haptics/haptic_loop.h"
#include "layer/simulation_engine.h"
#include "net/local_model_codec.h"
#include "net/tool_state_frames.h"
#include "remote/mesh_frames.h"
#include "remote/scene_message.h"
#include "scene/model_writer.h"
#include "scene/remote_hand.h"
#include "scene/tool_choice.h"
#include "scene/tool_frame.h"

namespace myotact::remote {

namespace {

constexpr std::chrono::milliseconds kHelloWait(3000);   // as long as the others who want to join have to wait, too
constexpr std::chrono::milliseconds kPatience(60'000);  // with a client that thinks, or is looked at in a debugger

}  // namespace

LockstepServer::Run::Run(const scene::Scene& scene)
    : simulation(scene.specimen, scene.settings),
      conductor(scene, simulation),
      clock_ns(haptics::kTickPeriod_ns) {}  // as LockstepSession's: time 0 means "never" to a device

LockstepServer::LockstepServer(const net::Endpoint& endpoint, scene::Scene scene,
                               const net::AccessPolicy& access_policy, std::uint64_t seed)
    : listener_(net::listen_at(endpoint)),
      scene_(std::move(scene)),
      access_policy_(access_policy),
      message_(scene_message(scene_, seed)),
      step_ns_(static_cast<std::uint64_t>(std::llround(scene_.settings.dt_s * 1e9))) {}

void LockstepServer::serve(const std::function<bool()>& stopped) {
  constexpr std::chrono::milliseconds kLook(100);
  auto run = std::make_unique<Run>(scene_);
  spdlog::info("Listening for incoming connections...");
  while (!stopped()) {
    std::string peer;
    net::Socket socket = net::accept_from(listener_, kLook, peer);
    if (!socket) continue;
    // Now, and not when a client leaves: a scene settles for seconds, and who stops the server would wait for it.
    if (run->begun) run = std::make_unique<Run>(scene_);
    net::FrameStream stream(std::move(socket), kHelloWait, stopped);
    spdlog::info("Client connected! {}", peer);
    serve_client(stream, *run);
    spdlog::info("Client left: {}", stream.why());
  }
}

void LockstepServer::serve_client(net::FrameStream& stream, Run& run) {
  net::Wants wants;
  if (!welcome(stream, wants)) return;
  stream.set_patience(kPatience);
  net::ToolStateJoiner joiner;
  while (const auto frame = stream.read()) {
    if (frame->header.type == net::FrameType::Bye) return;
    if (!joiner.take(*frame)) {
      stream.write(net::encode(net::Bye{net::ByeReason::BadFrame, "in lockstep a sound state of the hand is due"}), 0);
      return;
    }
    if (frame->header.type != net::FrameType::ToolState) continue;
    if (!wants.hand) {
      stream.write(net::encode(net::Bye{net::ByeReason::NoHand, "a viewer, or who asked for no hand, moves none"}), 0);
      return;
    }
    if (!answer(stream, wants, joiner.state(), run)) return;
  }
}

bool LockstepServer::welcome(net::FrameStream& stream, net::Wants& wants) {
  const auto first = stream.read();
  if (!first) return false;
  net::Hello hello;
  if (const auto refusal = net::refusal_of(*first, access_policy_, hello)) {
    stream.write(net::encode(*refusal), 0);
    return false;
  }
  wants = hello.wants;
  wants.hand = wants.hand && hello.role != net::Role::Viewer;
  net::Welcome welcome;
  welcome.client = 1;
  welcome.hand = wants.hand ? std::int8_t{0} : std::int8_t{-1};
  welcome.role = hello.role;
  welcome.lockstep = true;
  welcome.step_ns = step_ns_;
  bool sent = stream.write(net::encode(welcome), 0) && stream.write_text(message_, 0);
  if (!wants.meshes) return sent;
  for (const net::Bytes& mesh : mesh_frames(scene_.specimen)) {
    sent = sent && stream.write(net::FrameType::Mesh, 0, mesh, 0);
  }
  return sent;
}

bool LockstepServer::answer(net::FrameStream& stream, const net::Wants& wants, const messages::ToolState& said,
                            Run& run) {
  const messages::ToolState state = scene::heeded(said, scene_.specimen);
  if (run.begun) step(state, run);
  if (!run.begun) run.conductor.prepare_step(run.simulation.time_s(), run.input);
  run.begun = true;
  return show(stream, wants, state, run);
}

void LockstepServer::step(const messages::ToolState& state, Run& run) {
  run.input.tools.assign(scene_.tools.size(), {});
  run.input.tools[0] = state;
  layer::name_touched_triangle(run.simulation, run.input.tools[0]);
  scene::apply(run.input, run.simulation);
  run.simulation.step(run.input.tools);
  run.clock_ns += step_ns_;
  ++run.steps;
  run.conductor.prepare_step(run.simulation.time_s(), run.input);
}

bool LockstepServer::show(net::FrameStream& stream, const net::Wants& wants, const messages::ToolState& state,
                          Run& run) {
  const scene::ModelRecord record{run.steps + 1, run.clock_ns, false, state.tool_position_world_m, run.steps};
  messages::LocalModel model;
  scene::write_model(run.simulation, {state, 0, record, step_ns_, scene::report_radius_m(scene_.tools[0])}, model);
  const net::ForceAnswer force{state.sequence, run.steps, scene::force_on_hand_N(model, state)};
  spdlog::debug("force send: {} {} {}", force.force_world_N[0], force.force_world_N[1], force.force_world_N[2]);
  bool sent = stream.write(net::encode(force), run.clock_ns);
  if (wants.frames) {
    messages::SceneFrame frame;
    run.simulation.write_frame(frame);
    frame.control = run.conductor.control();
    frame.sequence = run.steps + 1;
    messages::FeltTool felt;
    felt.tool = state;
    felt.parts.contact = state.force_world_N;
    felt.held = scene::tool_in_hand(scene_.tools[0], std::nullopt);
    frame.tools = {scene::tool_frame(felt, scene_, 0, run.simulation)};
    const auto scene = run.encoder.encode(frame);
    const auto frames = net::frames_to_send(*scene, run.shown.get(), wants);
    for (const net::EncodedFrame* part : frames) {
      const std::uint8_t flags = part == frames.back() ? net::kLastOfScene : std::uint8_t{0};
      sent = sent && stream.write(part->type, flags, part->payload, run.clock_ns);
    }
    run.shown = scene;
  }
  net::Bytes bytes;
  net::encode(model, bytes);
  return sent && (!wants.hand || stream.write(net::FrameType::LocalModel, 0, bytes, run.clock_ns));
}

}  // namespace myotact::remote
