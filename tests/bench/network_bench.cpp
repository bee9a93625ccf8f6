// Round trips of hand and simulation over loopback beside a bare ping-pong of 24 bytes, both between two processes on a
// core each, and what a server costs with many clients. Run by hand: results/ says on which machine, when and what.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

#include <sched.h>
#include <signal.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "net/frame_stream.h"
#include "net/scene_inquiry.h"
#include "net/tool_state_frames.h"
#include "realtime/periodic_loop.h"
#include "realtime/real_time_thread.h"
#include "support/loopback_server.h"

namespace {

using namespace myotact;

constexpr double kSeconds = 5.0;
constexpr std::size_t kPing = 24;

void stay_on_core(int core) {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(core, &cores);
  sched_setaffinity(0, sizeof cores, &cores);
}

/// Runs `serve` in another process on that core, which reports its port through a pipe.
class Peer {
 public:
  Peer(int core, const std::function<void(int pipe)>& serve) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) std::exit(1);
    pid_ = fork();
    if (pid_ == 0) {
      spdlog::set_level(spdlog::level::off);
      stay_on_core(core);
      realtime::make_this_thread_real_time();  // and the threads that it starts
      serve(ends[1]);
      _exit(0);
    }
    if (read(ends[0], &port_, sizeof port_) != sizeof port_) std::exit(1);
  }
  ~Peer() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  net::Endpoint endpoint() const { return {"127.0.0.1", port_}; }
  /// Processor time so far [s].
  double cpu_s() const {
    clockid_t clock = 0;
    clock_getcpuclockid(pid_, &clock);
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

 private:
  pid_t pid_ = -1;
  std::uint16_t port_ = 0;
};

void tell_port(int pipe, std::uint16_t port) {
  if (write(pipe, &port, sizeof port) != sizeof port) _exit(1);
}

bool take(const net::Socket& socket, std::span<std::uint8_t> room) {
  while (!room.empty()) {
    std::size_t count = 0;
    if (net::receive(socket, room, count) != net::Received::Some) return false;
    room = room.subspan(count);
  }
  return true;
}

void echo(int pipe) {
  const net::Socket listener = net::listen_at({"127.0.0.1", 0});
  tell_port(pipe, net::port_of(listener));
  std::string peer;
  const net::Socket socket = net::accept_from(listener, std::chrono::seconds(10), peer);
  std::array<std::uint8_t, kPing> bytes{};
  while (take(socket, bytes)) net::send(socket, bytes, {}, false, std::chrono::seconds(1));
}

void serve_hands(int pipe, std::size_t hands) {
  net::ServerSettings settings;
  const testing::LoopbackServer host(settings, hands);
  tell_port(pipe, host.server->port());
  for (std::uint64_t step = 0;; ++step) {  // what a simulation of 100 Hz does to it
    for (const auto& channels : host.channels) {
      channels->states.update();
      channels->forces.publish({step, {0.1, 0.2, 0.3}});
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

struct Result {
  double per_s = 0.0;
  std::vector<double> times_us;

  double quantile_us(double share) {
    std::sort(times_us.begin(), times_us.end());
    return times_us[static_cast<std::size_t>(share * static_cast<double>(times_us.size() - 1))];
  }
};

Result measure(bool paced, const std::function<void()>& round_trip) {
  Result result;
  realtime::PeriodicLoop loop(1'000'000);
  loop.start();
  const std::uint64_t begin_ns = realtime::steady_now_ns();
  std::uint64_t now_ns = begin_ns;
  while (1e-9 * static_cast<double>(now_ns - begin_ns) < kSeconds) {
    if (paced) loop.wait();
    const std::uint64_t left_ns = realtime::steady_now_ns();
    round_trip();
    now_ns = realtime::steady_now_ns();
    result.times_us.push_back(1e-3 * static_cast<double>(now_ns - left_ns));
  }
  result.per_s = static_cast<double>(result.times_us.size()) / (1e-9 * static_cast<double>(now_ns - begin_ns));
  return result;
}

Result bare(int core, bool paced) {
  const Peer peer(core, echo);
  const net::Socket socket = net::connect_to(peer.endpoint(), std::chrono::seconds(5));
  std::array<std::uint8_t, kPing> bytes{};
  return measure(paced, [&] {
    net::send(socket, bytes, {}, false, std::chrono::seconds(1));
    take(socket, bytes);
  });
}

/// A hand's stream, welcomed.
struct HandStream {
  explicit HandStream(const net::Endpoint& server)
      : stream(net::connect_to(server, std::chrono::seconds(5)), std::chrono::seconds(5)) {
    net::Hello hello;
    hello.role = net::Role::Student;
    hello.wants.hand = true;
    stream.write(net::encode(hello), 0);
    net::read_scene(stream, server);
  }
  void tell() {
    ++state.sequence;
    const net::ToolStateFrames frames = net::encode(state);
    for (const net::SmallFrame& frame : frames.used()) stream.write(frame, realtime::steady_now_ns());
  }
  void round_trip() {
    tell();
    for (auto frame = stream.read(); frame && frame->header.type != net::FrameType::Force;) frame = stream.read();
  }

  net::FrameStream stream;
  messages::ToolState state;
};

Result ours(int core, bool paced) {
  const Peer peer(core, [](int pipe) { serve_hands(pipe, 1); });
  HandStream hand(peer.endpoint());
  return measure(paced, [&] { hand.round_trip(); });
}

void print(const char* name, Result result) {
  std::printf("| %s | %.0f | %.1f | %.1f | %.1f |\n", name, result.per_s, result.quantile_us(0.5),
              result.quantile_us(0.99), result.quantile_us(0.999));
}

/// Share of one core that a server takes while so many clients each tell 1000 states a second and get their forces.
void print_load(std::size_t clients) {
  const Peer peer(1, [clients](int pipe) { serve_hands(pipe, clients); });
  std::vector<std::unique_ptr<HandStream>> hands;
  for (std::size_t i = 0; i < clients; ++i) hands.push_back(std::make_unique<HandStream>(peer.endpoint()));
  realtime::PeriodicLoop loop(1'000'000);
  loop.start();
  const double before_s = peer.cpu_s();
  const std::uint64_t begin_ns = realtime::steady_now_ns();
  std::uint64_t rounds = 0, missed = 0;
  double wall_s = 0.0;
  for (; wall_s < kSeconds; ++rounds) {
    missed += loop.wait().missed;
    for (const auto& hand : hands) hand->round_trip();
    wall_s = 1e-9 * static_cast<double>(realtime::steady_now_ns() - begin_ns);
  }
  std::printf("| %zu clients | %.0f states/s | %.1f %% of a core | %llu of %llu deadlines missed by the one sender |\n",
              clients, static_cast<double>(rounds * clients) / wall_s, 100.0 * (peer.cpu_s() - before_s) / wall_s,
              static_cast<unsigned long long>(missed), static_cast<unsigned long long>(rounds));
}

}  // namespace

int main() {
  spdlog::set_level(spdlog::level::warn);
  stay_on_core(0);
  if (!realtime::make_this_thread_real_time().granted) std::printf("without real-time priority\n");
  std::printf("| round trips | a second | p50 us | p99 us | p99.9 us |\n|---|---|---|---|---|\n");
  double ratio = 0.0, per_s = 0.0;
  for (const int core : {0, 1}) {  // the same one shows what the program costs, another one what a wake-up does
    const Result raw = bare(core, false), own = ours(core, false);
    print(core == 0 ? "bare, 24 bytes, same core" : "bare, 24 bytes", raw);
    print(core == 0 ? "state and force, same core" : "state and force", own);
    std::printf("ratio %.2f\n", own.per_s / raw.per_s);
    ratio = own.per_s / raw.per_s;
    per_s = own.per_s;
  }
  print("bare, paced at 1 kHz", bare(1, true));
  print("state and force, paced at 1 kHz", ours(1, true));
  std::printf("ratio %.2f: goal 0.8 %s, floor 0.5 %s; 16000 a second %s\n", ratio, ratio >= 0.8 ? "met" : "missed",
              ratio >= 0.5 ? "met" : "missed", per_s >= 16000.0 ? "met" : "missed");
  for (const std::size_t clients : {1u, 8u, 32u}) print_load(clients);
  return 0;
}
