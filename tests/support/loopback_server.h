#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <thread>
#include <vector>

#include "net/client.h"
#include "net/server.h"

namespace myotact::testing {

/// A server of hands on a free port of this machine, without a simulation behind it.
struct LoopbackServer {
  explicit LoopbackServer(net::ServerSettings settings = {}, std::size_t hand_count = 2, std::uint16_t port = 0) {
    std::vector<net::HandPlace> places;
    for (std::size_t i = 0; i < hand_count; ++i) {
      channels.push_back(std::make_unique<net::HandChannels>());
      places.push_back({channels.back().get(), i % 2 == 1});
    }
    hands = std::make_unique<net::HandTable>(places);
    settings.scene_json = R"({"scene": {}})";
    settings.step_ns = 10'000'000;
    server = std::make_unique<net::Server>(net::Endpoint{"127.0.0.1", port}, settings, *hands);
  }

  net::ClientSettings client(bool with_hand = true, net::Role role = net::Role::Student) const {
    net::ClientSettings settings;
    settings.server = {"127.0.0.1", server->port()};
    settings.hello.role = role;
    settings.hello.wants = {with_hand, true, true, false};
    settings.hello.name = "test";
    return settings;
  }

  std::vector<std::unique_ptr<net::HandChannels>> channels;
  std::unique_ptr<net::HandTable> hands;
  std::unique_ptr<net::Server> server;
};

/// Waits at most 10 s for something to become true.
template <typename Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace myotact::testing
