#include <chrono>
#include <cstring>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/loopback_server.h"

// Clients that break every rule; another client goes on working beside them.

namespace myotact::net {
namespace {

using testing::comes_true;
using testing::LoopbackServer;

/// A bare connection that sends whatever it likes.
class RoughClient {
 public:
  explicit RoughClient(const LoopbackServer& host)
      : socket_(connect_to({"127.0.0.1", host.server->port()}, std::chrono::milliseconds(2000))) {
    set_patience(socket_, std::chrono::milliseconds(5000));
  }

  void send_bytes(std::span<const std::uint8_t> bytes) {
    send(socket_, bytes, {}, false, std::chrono::milliseconds(1000));
  }
  void send_frame(FrameType type, std::span<const std::uint8_t> payload, std::uint32_t sequence) {
    FrameHeader header;
    header.type = type;
    header.sequence = sequence;
    send_bytes(header_bytes(header, payload));
    send_bytes(payload);
  }
  void hello() {
    Hello hello;
    hello.role = Role::Student;
    hello.wants.hand = true;
    send_frame(FrameType::Hello, encode(hello).payload(), 0);
  }
  /// True: the server ended the connection.
  bool is_closed() {
    std::array<std::uint8_t, 4096> bytes{};
    std::size_t count = 0;
    Received received = Received::Some;
    while (received == Received::Some) received = receive(socket_, bytes, count);
    return received == Received::Closed;
  }
  const Socket& socket() const { return socket_; }

 private:
  Socket socket_;
};

/// A well-behaved client to be left alone by all of it.
struct Witness {
  explicit Witness(const LoopbackServer& host) : client(host.client(false, Role::Viewer)) { client.start(); }
  bool is_well() const { return client.status().connected && client.status().connections == 1; }
  Client client;
};

std::size_t descriptor_count() {
  const auto all = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

/// Changes one byte of a Hello's header.
void send_spoilt_hello(RoughClient& client, std::size_t at, std::uint8_t value) {
  Hello hello;
  const SmallFrame frame = encode(hello);
  FrameHeader header;
  header.type = FrameType::Hello;
  HeaderBytes bytes = header_bytes(header, frame.payload());
  bytes[at] = value;
  client.send_bytes(bytes);
  client.send_bytes(frame.payload());
}

TEST(RoughClients, EveryKindOfBadHeaderIsCountedAndClosed) {
  LoopbackServer host;
  const Witness witness(host);
  struct Case {
    std::size_t at;
    std::uint8_t value;
    WireFault fault;
  };
  for (const Case& spoilt :
       {Case{0, 0x4E, WireFault::Magic}, Case{1, 2, WireFault::Version}, Case{2, 99, WireFault::Type},
        Case{7, 0xFF, WireFault::Length}, Case{20, 0, WireFault::Crc}, Case{8, 5, WireFault::Crc}}) {
    const auto before = host.server->counters().faults[static_cast<std::size_t>(spoilt.fault)];
    RoughClient client(host);
    send_spoilt_hello(client, spoilt.at, spoilt.value);
    EXPECT_TRUE(client.is_closed()) << describe(spoilt.fault);
    EXPECT_EQ(host.server->counters().faults[static_cast<std::size_t>(spoilt.fault)], before + 1)
        << describe(spoilt.fault);
  }
  EXPECT_TRUE(witness.is_well());
}

TEST(RoughClients, ASequenceNumberThatIsNotTheNextEndsIt) {
  LoopbackServer host;
  RoughClient client(host);
  client.hello();
  client.send_frame(FrameType::Ping, encode(Ping{1}).payload(), 7);
  EXPECT_TRUE(client.is_closed());
  EXPECT_EQ(host.server->counters().faults[static_cast<std::size_t>(WireFault::Sequence)], 1u);
}

TEST(RoughClients, TextThatIsNoTextEndsIt) {
  LoopbackServer host;
  RoughClient client(host);
  client.hello();
  const std::array<std::uint8_t, 4> text = {'a', 0xFF, 0xFE, 'b'};
  client.send_frame(FrameType::Control, text, 1);
  EXPECT_TRUE(client.is_closed());
  EXPECT_EQ(host.server->counters().faults[static_cast<std::size_t>(WireFault::Text)], 1u);
}

TEST(RoughClients, NothingButAHelloMayComeFirst) {
  LoopbackServer host;
  RoughClient client(host);
  client.send_frame(FrameType::Ping, encode(Ping{1}).payload(), 0);
  EXPECT_TRUE(client.is_closed());
}

TEST(RoughClients, WhoSaysNothingIsClosed) {
  ServerSettings settings;
  settings.hello_wait = std::chrono::milliseconds(100);
  settings.silence = std::chrono::milliseconds(150);
  LoopbackServer host(settings);
  RoughClient mute(host), soon_silent(host);
  soon_silent.hello();
  EXPECT_TRUE(mute.is_closed());
  EXPECT_TRUE(soon_silent.is_closed());
  EXPECT_TRUE(comes_true([&] { return host.server->counters().closed_silent == 2; }));
}

TEST(RoughClients, AWrongTokenAThousandTimesChangesNothing) {
  ServerSettings settings;
  settings.access_policy.token = new_token();
  LoopbackServer host(settings);
  ClientSettings given = host.client(false, Role::Viewer);
  given.hello.token = *settings.access_policy.token;
  Client witness(given);
  witness.start();
  for (int i = 0; i < 1000; ++i) {
    RoughClient client(host);
    client.hello();
    ASSERT_TRUE(client.is_closed());
  }
  EXPECT_EQ(host.server->counters().refused, 1000u);
  EXPECT_EQ(witness.status().connections, 1u);
}

TEST(RoughClients, TenThousandConnectionsLeaveTheOthersAlone) {
  ServerSettings settings;
  settings.most_waiting = 8;
  LoopbackServer host(settings);
  const Witness witness(host);
  const std::size_t before = descriptor_count();
  {
    std::vector<std::unique_ptr<RoughClient>> crowd;  // the last hundred stay open
    for (int i = 0; i < 10'000; ++i) {
      crowd.push_back(std::make_unique<RoughClient>(host));
      if (crowd.size() > 100) crowd.erase(crowd.begin());
    }
    EXPECT_TRUE(witness.is_well());
    ClientSettings patient = host.client(false, Role::Viewer);
    patient.silence = std::chrono::seconds(20);  // those before it in the queue come first, slowly under a sanitizer
    Client late(patient);
    EXPECT_NO_THROW(late.start()) << "who says Hello at once comes in beside a crowd that does not";
  }
  EXPECT_TRUE(comes_true([&] { return descriptor_count() <= before; })) << descriptor_count() << " of " << before;
  EXPECT_TRUE(witness.is_well());
}

TEST(RoughClients, WhoNeverReadsGetsTheNewestAndIsClosedInTheEnd) {
  ServerSettings settings;
  settings.slow_wait = std::chrono::milliseconds(300);
  LoopbackServer host(settings);
  const Witness witness(host);
  RoughClient lazy(host);
  Hello hello;
  hello.wants.frames = true;
  lazy.send_frame(FrameType::Hello, encode(hello).payload(), 0);
  ASSERT_TRUE(comes_true([&] { return host.server->client_count() == 2; }));
  messages::SceneFrame frame;
  frame.skins_world_m = {std::vector<std::array<float, 3>>(50'000)};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (host.server->counters().closed_slow == 0 && std::chrono::steady_clock::now() < end) {
    for (auto& vertex : frame.skins_world_m[0]) vertex[0] += 1e-4f;
    ++frame.sequence;
    host.server->show(frame);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(host.server->counters().closed_slow, 1u);
  EXPECT_TRUE(comes_true([&] { return host.server->client_count() == 1; }));
  EXPECT_TRUE(witness.is_well());
}

TEST(RoughClients, AThousandReconnectsLeaveNothingBehind) {
  LoopbackServer host;
  const std::size_t before = descriptor_count();
  for (int i = 0; i < 1000; ++i) {
    RoughClient client(host);
    client.hello();
    if (i % 3 == 0) continue;  // gone before it was welcomed
    std::array<std::uint8_t, 64> bytes{};
    std::size_t count = 0;
    ASSERT_EQ(receive(client.socket(), bytes, count), Received::Some);
  }
  EXPECT_TRUE(comes_true([&] { return descriptor_count() <= before && host.server->client_count() == 0; }));
  Client late(host.client());
  EXPECT_NO_THROW(late.start());
}

}  // namespace
}  // namespace myotact::net
