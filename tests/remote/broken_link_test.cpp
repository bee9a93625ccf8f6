#include <cstdlib>
#include <fstream>
#include <iostream>

#include <gtest/gtest.h>

#include "device/simulated_device.h"
#include "realtime/periodic_loop.h"
#include "remote/free_hand.h"
#include "scene/scene_file.h"
#include "support/cable.h"
#include "support/child.h"
#include "support/loopback_server.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

// Servers and clients that die, hang and come back, each in a process of its own; the hand here must be safe.

namespace myotact::remote {
namespace {

using testing::Child;
using testing::comes_true;
using testing::TemporaryFolder;

std::unique_ptr<Child> serve(const TemporaryFolder& folder, const std::string& port = "0") {
  return std::make_unique<Child>(
      std::vector<std::string>{MYOTACT_PROGRAM, "serve", "spring", "--port", port, "--no-websocket"},
      folder / "served.txt");
}

net::Endpoint endpoint_of(const Child& server) {
  return net::parse_endpoint(server.told("tcp"), 0);
}

/// A hand that is pulled by the spring of 30 N/m, with a look at every tick.
class PulledHand {
 public:
  explicit PulledHand(const net::Endpoint& server)
      : device_("simulated", Vec3::Zero()),
        hand_(settings(server), device_, scene::load_scene("spring").tools[0], nullptr) {
    hand_.start();
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));  // the gate's ramp
    device_.set_hand_target({{0.03, 0.0, 0.0}, {}, 0, {}});
  }

  /// Looks at the ticks until now; true when the newest force is as wanted.
  template <typename Wanted>
  bool reaches(const Wanted& wanted) {
    return comes_true([&] {
      look();
      return wanted(force_N_);
    });
  }
  void look() {
    for (haptics::HapticTick tick; hand_.loop().ticks().pop(tick);) {
      const double now_N = to_vec3(tick.tool.force_world_N).norm();
      largest_rise_N_ = std::max(largest_rise_N_, now_N - force_N_);
      force_N_ = now_N;
      newest_ns_ = tick.tool.time_ns;
    }
  }
  double force_N() const { return force_N_; }
  std::uint64_t newest_ns() const { return newest_ns_; }  // time of the tick that had it
  double take_largest_rise_N() { return std::exchange(largest_rise_N_, 0.0); }
  net::Client& client() { return hand_.client(); }

 private:
  static net::ClientSettings settings(const net::Endpoint& server) {
    net::ClientSettings settings;
    settings.server = server;
    settings.hello.role = net::Role::Student;
    settings.hello.wants.hand = true;
    if (const char* token = std::getenv("MYOTACT_TOKEN")) settings.hello.token = net::parse_token(token).value();
    return settings;
  }

  device::SimulatedDevice device_;
  FreeHand hand_;
  double force_N_ = 0.0, largest_rise_N_ = 0.0;
  std::uint64_t newest_ns_ = 0;
};

constexpr double kPulse_N = 0.03;  // a step of more in one tick is felt as a knock

/// The force goes to zero in time, and comes back without a pulse after `mend`.
template <typename Break, typename Mend>
void break_and_mend(PulledHand& hand, const Break& break_link, const Mend& mend) {
  ASSERT_TRUE(hand.reaches([](double force_N) { return force_N > 0.7; }));
  const std::uint64_t broken_ns = realtime::steady_now_ns();
  break_link();
  ASSERT_TRUE(hand.reaches([](double force_N) { return force_N == 0.0; }));
  const double zero_ms = 1e-6 * static_cast<double>(hand.newest_ns() - broken_ns);
  std::cout << "force zero after " << zero_ms << " ms: " << (zero_ms <= 101.0 ? "met" : "missed")
            << " (at most 100 wanted; the clock of a busy machine)\n";
  EXPECT_LT(zero_ms, 400.0);
  hand.take_largest_rise_N();
  mend();
  ASSERT_TRUE(hand.reaches([](double force_N) { return force_N > 0.7; }));
  EXPECT_LT(hand.take_largest_rise_N(), kPulse_N);
}

TEST(BrokenLink, AServerThatIsKilledAndStartedAgain) {
  const TemporaryFolder folder;
  auto server = serve(folder);
  const net::Endpoint endpoint = endpoint_of(*server);
  PulledHand hand(endpoint);
  break_and_mend(
      hand, [&] { EXPECT_EQ(server->end(SIGKILL), -SIGKILL); },
      [&] { server = serve(folder, std::to_string(endpoint.port)); });
  EXPECT_EQ(hand.client().status().connections, 2u);
}

TEST(BrokenLink, AServerThatHangs) {
  const TemporaryFolder folder;
  const auto server = serve(folder);
  PulledHand hand(endpoint_of(*server));
  break_and_mend(
      hand, [&] { server->send(SIGSTOP); },
      [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // the client gives the connection up
        server->send(SIGCONT);
      });
}

TEST(BrokenLink, ACableThatIsPulledAndPluggedInAgain) {
  const testing::Cable cable;
  if (!cable.works()) GTEST_SKIP() << "no network namespaces here: they need root and iproute2";
  const TemporaryFolder folder;
  setenv("MYOTACT_TOKEN", "000102030405060708090a0b0c0d0e0f", 1);
  const Child server({"/sbin/ip", "netns", "exec", cable.far_host(), MYOTACT_PROGRAM, "serve", "spring", "--bind",
                      testing::Cable::far_address(), "--port", "0", "--no-websocket"},
                     folder / "served.txt");
  PulledHand hand(endpoint_of(server));
  break_and_mend(
      hand, [&] { cable.pull(); },
      [&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1200));  // the client gives the connection up
        cable.plug_in();
      });
  EXPECT_EQ(hand.client().status().connections, 2u);
  EXPECT_EQ(hand.client().status().welcome.hand, 0) << "its hand, which the dead connection still had";
  unsetenv("MYOTACT_TOKEN");
}

std::size_t resident_kB(int pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stoul(line.substr(6));
  }
  return 0;
}

std::size_t descriptors(int pid) {
  const auto all = std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

TEST(BrokenLink, AClientThatIsKilledGivesItsHandBack) {
  const TemporaryFolder folder;
  const auto server = serve(folder);
  const std::string address = server->told("tcp");
  for (int i = 0; i < 2; ++i) {
    Child feeler({MYOTACT_PROGRAM, "feel", "--connect", address, "--seconds", "60", "--out", folder / "felt"},
                 folder / "felt.txt");
    net::ClientSettings settings;
    settings.server = endpoint_of(*server);
    settings.hello.wants = {false, true, true, false};
    net::Client watcher(settings);
    watcher.start();
    messages::SceneFrame frame;
    EXPECT_TRUE(comes_true([&] { return watcher.fetch_frame(frame) && frame.tools.size() == 1; })) << "round " << i;
    feeler.end(SIGKILL);
    EXPECT_TRUE(comes_true([&] { return watcher.fetch_frame(frame) && frame.tools.empty(); })) << "round " << i;
  }
}

TEST(BrokenLink, AThousandClientsThatComeAndGoLeaveNothingBehind) {
  const TemporaryFolder folder;
  const auto server = serve(folder);
  const net::Endpoint endpoint = endpoint_of(*server);
  const auto come_and_go = [&](int times) {
    for (int i = 0; i < times; ++i) {
      net::ClientSettings settings;
      settings.server = endpoint;
      settings.hello.role = net::Role::Student;
      settings.hello.wants.hand = true;
      net::Client client(settings);
      client.start();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
  };
  come_and_go(200);
  const std::size_t memory_kB = resident_kB(server->pid()), files = descriptors(server->pid());
  come_and_go(1000);
  std::cout << "resident " << memory_kB << " kB, after 1000 more " << resident_kB(server->pid()) << " kB\n";
  EXPECT_LE(descriptors(server->pid()), files);
  if (!testing::kAddressSanitizer) {  // it keeps what is freed
    EXPECT_LT(resident_kB(server->pid()), memory_kB + 4096);
  }
}

}  // namespace
}  // namespace myotact::remote
