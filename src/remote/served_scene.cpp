#include "remote/served_scene.h"

#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "core/error.h"
#include "realtime/real_time_thread.h"
#include "remote/controls.h"
#include "remote/mesh_frames.h"
#include "remote/scene_message.h"

namespace myotact::remote {

namespace {

std::vector<std::unique_ptr<net::HandChannels>> make_channels(std::size_t count) {
  std::vector<std::unique_ptr<net::HandChannels>> channels;
  for (std::size_t i = 0; i < count; ++i) channels.push_back(std::make_unique<net::HandChannels>());
  return channels;
}

std::vector<net::HandPlace> places_of(const std::vector<std::unique_ptr<net::HandChannels>>& channels,
                                      const scene::Scene& scene) {
  std::vector<net::HandPlace> places;
  for (std::size_t t = 0; t < channels.size(); ++t)
    places.push_back({channels[t].get(), scene.tools[t].hand == "left"});
  return places;
}

std::vector<scene::ToolDevice> remote_tools(const std::vector<std::unique_ptr<net::HandChannels>>& channels) {
  std::vector<scene::ToolDevice> tools;
  for (const auto& hand : channels) tools.push_back({nullptr, nullptr, {&hand->states, &hand->models, &hand->forces}});
  return tools;
}

/// A skin that fits into no frame would never be seen.
void check_skins(const anatomy::Specimen& specimen) {
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    const std::size_t count = muscle.skin.positions_m.size();
    if (count <= net::kMostSkinVertices) continue;
    throw Error(ExitStatus::BadData, fmt::format("{}: its skin has {} vertices; a server shows at most {}; simplify it",
                                                 muscle.key, count, net::kMostSkinVertices));
  }
}

net::ServerSettings server_settings(const scene::Scene& scene, const ServeSettings& given) {
  check_skins(scene.specimen);
  net::ServerSettings settings = given.server;
  settings.scene_json = scene_message(scene, given.seed);
  settings.meshes = mesh_frames(scene.specimen);
  settings.step_ns = static_cast<std::uint64_t>(std::llround(scene.settings.dt_s * 1e9));
  return settings;
}

}  // namespace

scene::Scene with_hands(scene::Scene scene, std::size_t hands) {
  const std::vector<scene::ToolSettings> given = scene.tools;
  scene.tools.resize(std::min(given.size(), hands));
  while (scene.tools.size() < hands) {
    scene::ToolSettings tool = given[scene.tools.size() % given.size()];
    tool.hand = scene.tools.back().hand == "right" ? "left" : "right";
    scene.tools.push_back(tool);
  }
  return scene;
}

ServedScene::ServedScene(const scene::Scene& scene, simulation::Simulation& simulation, const ServeSettings& settings,
                         scene::RecordingWriter* recorder)
    : channels_(make_channels(scene.tools.size())),
      hands_(places_of(channels_, scene)),
      server_(std::make_unique<net::Server>(settings.endpoint, server_settings(scene, settings), hands_)),
      session_(scene, simulation, remote_tools(channels_), recorder) {
  session_.on_models([this] { server_->ring(); });
}

ServedScene::~ServedScene() {
  closing_ = true;
  if (encoder_.joinable()) encoder_.join();
}

void ServedScene::start() {
  session_.start();
  encoder_ = std::thread([this] { encode_frames(); });
}

scene::FreeTiming ServedScene::stop() {
  closing_ = true;
  if (encoder_.joinable()) encoder_.join();
  session_.stop();
  return session_.timing();
}

/// As often as a screen shows them; what is between two is never encoded.
void ServedScene::encode_frames() {
  realtime::name_this_thread("frame encoder");
  constexpr std::chrono::milliseconds kPeriod(33);
  messages::SceneFrame frame;
  while (!closing_) {
    std::this_thread::sleep_for(kPeriod);
    if (!session_.fetch_frame(frame)) continue;
    time_s_ = frame.time_s;
    if (server_->is_watched()) server_->show(frame);
  }
}

void ServedScene::obey() {
  constexpr int kMostAtOnce = 64;  // that nobody's flood keeps the rest from being done
  for (int i = 0; i < kMostAtOnce; ++i) {
    const auto request = server_->take_request();
    if (!request) break;
    try {
      obey(*request);
    } catch (const RefusedWish& refusal) {
      server_->refuse(request->client, refusal.what(), refusal.kind());
    } catch (const Error& failure) {
      const bool leads = request->role == net::Role::Instructor;
      server_->refuse(request->client, failure.what(), leads ? net::Refusal::Other : net::Refusal::NotUnderstood);
    }
  }
  tell_class();
}

void ServedScene::obey(const net::ControlRequest& request) {
  if (Classroom::is_for_class(request.text)) return class_.obey(request);
  if (request.role != net::Role::Instructor) {
    throw RefusedWish(net::Refusal::NotInstructor, "only an instructor may change the scene");
  }
  const std::optional<messages::Order> order = order_of(request.text);
  if (!order) return server_->stop_forces();
  if (const std::string why = session_.push({*order, messages::Commander::Network}); !why.empty()) {
    server_->refuse(request.client, why);
  }
}

/// Ten times a second at most: a class of thirty that all answer at once is one piece of news.
void ServedScene::tell_class() {
  constexpr std::chrono::milliseconds kPeriod(100);
  const auto now = std::chrono::steady_clock::now();
  if (now - told_at_ < kPeriod) return;
  told_at_ = now;
  class_.set_members(server_->clients(), now);
  server_->let_hands_rest(class_.frozen());
  if (class_.has_news()) server_->announce(class_.announcement());
}

}  // namespace myotact::remote
