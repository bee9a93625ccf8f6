#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include "app/class_link.h"
#include "app/class_page.h"
#include "app/equipment.h"
#include "app/interruption.h"
#include "app/network_options.h"
#include "app/options.h"
#include "core/error.h"
#include "net/websocket_listener.h"
#include "remote/capacity.h"
#include "remote/lockstep_server.h"
#include "remote/served_scene.h"

namespace myotact::app {

namespace {

/// On this machine alone everybody may join; from elsewhere only who was given a token.
net::AccessPolicy access_policy_of(const Options& options) {
  net::AccessPolicy access_policy = {token_of("MYOTACT_TOKEN"), token_of("MYOTACT_INSTRUCTOR_TOKEN")};
  if (net::is_loopback(options.bind)) return access_policy;
  if (!access_policy.token) access_policy.token = net::new_token();
  if (!access_policy.instructor_token) access_policy.instructor_token = net::new_token();
  return access_policy;
}

/// What clients need to know, one line each on standard output, where no log keeps it.
void print_access(const Options& options, std::uint16_t port, const net::AccessPolicy& access_policy) {
  std::cout << "tcp " << options.bind << ':' << port << '\n';
  if (access_policy.token) std::cout << "token " << net::to_text(*access_policy.token) << '\n';
  if (access_policy.instructor_token)
    std::cout << "instructor_token " << net::to_text(*access_policy.instructor_token) << '\n';
  std::cout.flush();
}

/// How a class joins, and a picture of that for telephones where somebody looks at a terminal.
void invite_class(const net::Endpoint& page, const net::AccessPolicy& access_policy, remote::ServedScene& served) {
  const std::string link = class_link(page, access_policy.token, "student");
  served.invite(link);
  std::cout << "page " << link << '\n'
            << "instructor_page "
            << class_link(page, access_policy.instructor_token ? access_policy.instructor_token : access_policy.token,
                          "instructor")
            << '\n';
  if (net::is_loopback(page.host)) {
    spdlog::info("The page is for browsers on this machine; --bind 0.0.0.0 lets those on others in.");
  } else if (isatty(STDOUT_FILENO) != 0) {
    std::cout << '\n' << qr_for_terminal(link);
  }
  std::cout.flush();
}

/// A class gets as many hands as this machine bears, and is told how many these are. What is sent to those that look on
/// is not reckoned with: in the measurement all hands press at once, which a class hardly does.
scene::Scene with_hands_of_class(scene::Scene scene) {
  const double allowed_s = scene.settings.dt_s;
  const auto load = remote::measure_load(scene, allowed_s, remote::kMostHands);
  const std::size_t borne = remote::hands_borne(load, allowed_s, remote::kMostHands);
  const std::size_t hands = std::max(borne, scene.tools.size());
  std::cout << "hands " << hands << '\n';
  if (borne < hands) {
    spdlog::warn("On this machine \"{}\" runs slower than real time while {}.", scene.name,
                 hands == 1 ? "a hand presses" : fmt::format("{} hands press", hands));
  } else {
    spdlog::info(
        "This machine bears about {} hands that press at once; a class gets as many. Who comes after them "
        "watches; --hands N gives more or fewer.",
        hands);
  }
  return remote::with_hands(std::move(scene), hands);
}

nlohmann::json counters_json(const net::ServerCounters& counters) {
  nlohmann::json faults = nlohmann::json::object();
  for (std::size_t i = 1; i < net::kWireFaults; ++i) {
    if (counters.faults[i] > 0) faults[net::describe(static_cast<net::WireFault>(i))] = counters.faults[i];
  }
  return {{"accepted", counters.accepted},
          {"refused", counters.refused},
          {"failed", counters.failed},
          {"closed_slow", counters.closed_slow},
          {"closed_silent", counters.closed_silent},
          {"bad_frames", faults},
          {"dropped_controls", counters.dropped_controls}};
}

int serve_lockstep(const Options& options, const scene::Scene& scene, const net::AccessPolicy& access_policy) {
  remote::LockstepServer server({options.bind, options.port}, scene, access_policy, options.seed);
  print_access(options, server.port(), access_policy);
  server.serve([] { return interruption() != 0; });
  return interruption();
}

int serve_free(const Options& options, const scene::Scene& scene, const net::AccessPolicy& access_policy) {
  const auto recorder = open_recorder(options, scene, std::vector<device::DeviceProfile>(scene.tools.size()));
  const net::WebFiles page = options.web ? class_page(scene) : net::WebFiles{};
  simulation::Simulation simulation(scene.specimen, scene.settings);
  remote::ServeSettings settings;
  settings.endpoint = {options.bind, options.port};
  settings.server.access_policy = access_policy;
  settings.seed = options.seed;
  remote::ServedScene served(scene, simulation, settings, recorder.get());
  std::optional<net::WebSocketListener> websocket;
  if (!options.no_websocket) {
    websocket.emplace(net::Endpoint{options.bind, options.websocket_port}, served.server(), options.origins, page);
    std::cout << "websocket " << options.bind << ':' << websocket->port() << '\n';
  }
  served.start();
  print_access(options, served.server().port(), access_policy);
  if (options.web) invite_class({reachable_address(options.bind), websocket->port()}, access_policy, served);
  while (interruption() == 0 && served.running() && served.time_s() < options.seconds.value_or(1e12)) {
    served.obey();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  served.server().say_goodbye();
  constexpr std::chrono::milliseconds kPassedOn(100);  // by the listener, before it ends
  if (websocket) std::this_thread::sleep_for(kPassedOn);
  const scene::FreeTiming timing = served.stop();
  const nlohmann::json report = {{"simulated_s", timing.simulated_s},
                                 {"wall_s", timing.wall_s},
                                 {"steps", timing.steps},
                                 {"clients", counters_json(served.server().counters())}};
  if (options.json) std::cout << report.dump(2) << std::endl;
  return interruption();
}

}  // namespace

int serve(const Options& options) {
  refuse_equipment(options, "hands come from the clients here; connect one with \"myotact feel\" and this --device");
  scene::Scene scene = scene_of(options);
  if (options.hands && options.record && *options.hands != scene.tools.size()) {
    throw Error(
        ExitStatus::Usage,
        fmt::format("--record: a recording is of the scene's own {} hands; leave --hands out", scene.tools.size()));
  }
  if (options.hands) {
    scene = remote::with_hands(std::move(scene), *options.hands);
  } else if (options.web && !options.record) {  // a recording is of the scene's own hands
    scene = with_hands_of_class(std::move(scene));
  }
  const net::AccessPolicy access_policy = access_policy_of(options);
  watch_for_interruption();
  return options.lockstep ? serve_lockstep(options, scene, access_policy) : serve_free(options, scene, access_policy);
}

}  // namespace myotact::app
