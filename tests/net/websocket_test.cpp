#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "net/small_frames.h"
#include "net/websocket_listener.h"
#include "support/loopback_server.h"

// The door for browsers, knocked at with bytes as RFC 6455 has them.

namespace myotact::net {
namespace {

using testing::comes_true;
using testing::LoopbackServer;

class Browser {
 public:
  explicit Browser(const WebSocketListener& listener)
      : socket_(connect_to({"127.0.0.1", listener.port()}, std::chrono::milliseconds(2000))) {
    set_patience(socket_, std::chrono::milliseconds(5000));
  }

  /// The answer to a request, up to its blank line.
  std::string ask(const std::string& host, const std::string& origin) {
    std::string request = "GET / HTTP/1.1\r\nHost: " + host + "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n";
    if (!origin.empty()) request += "Origin: " + origin + "\r\n";
    // The example of the standard, section 1.3.
    request += "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n";
    send_text(request);
    std::string answer;
    while (answer.find("\r\n\r\n") == std::string::npos) {
      const Bytes byte = take(1);
      if (byte.empty()) break;
      answer.push_back(static_cast<char>(byte[0]));
    }
    return answer;
  }
  void send_text(const std::string& text) {
    send(socket_, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, {}, false,
         std::chrono::milliseconds(1000));
  }
  /// One message of less than 126 bytes, masked as a client's must be (section 5.3). `first`: 0x82 for a binary one.
  void send_message(const Bytes& payload, std::uint8_t first = 0x82) {
    Bytes bytes = {first, static_cast<std::uint8_t>(0x80 | payload.size()), 0x37, 0xFA, 0x21, 0x3D};
    for (std::size_t i = 0; i < payload.size(); ++i) bytes.push_back(payload[i] ^ bytes[2 + i % 4]);
    send(socket_, bytes, {}, false, std::chrono::milliseconds(1000));
  }
  /// The payload of the next message of the server; of a close, nothing.
  Bytes message() {
    const Bytes head = take(2);
    if (head.size() < 2 || head[0] != 0x82) return {};
    std::size_t size = head[1];
    if (size == 126) {
      const Bytes longer = take(2);
      size = static_cast<std::size_t>(longer[0]) << 8 | longer[1];
    }
    return take(size);
  }
  /// True: the server ended the connection.
  bool is_closed() { return take(1u << 20).size() < (1u << 20); }

 private:
  Bytes take(std::size_t count) {
    Bytes bytes;
    while (bytes.size() < count) {
      std::array<std::uint8_t, 1024> room{};
      std::size_t got = 0;
      const auto wanted = std::span(room).first(std::min(room.size(), count - bytes.size()));
      if (receive(socket_, wanted, got) != Received::Some) break;
      bytes.insert(bytes.end(), room.begin(), room.begin() + static_cast<std::ptrdiff_t>(got));
    }
    return bytes;
  }

  Socket socket_;
};

Bytes frame_bytes(const SmallFrame& frame, std::uint32_t sequence) {
  FrameHeader header;
  header.type = frame.type;
  header.sequence = sequence;
  const auto payload = frame.payload();
  const HeaderBytes head = header_bytes(header, payload);
  Bytes bytes(head.size() + payload.size());
  std::copy(payload.begin(), payload.end(), std::copy(head.begin(), head.end(), bytes.begin()));
  return bytes;
}

TEST(WebSocket, AnswersTheHandshakeOfTheStandard) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  const std::string answer = Browser(listener).ask("127.0.0.1", "");
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 101")) << answer;
  EXPECT_NE(answer.find("Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo="), std::string::npos) << answer;
}

TEST(WebSocket, EveryFrameIsAMessage) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  Browser browser(listener);
  browser.ask("localhost:7481", "http://localhost:8000");
  browser.send_message(frame_bytes(encode(Hello{}), 0));
  const Bytes welcome = browser.message();
  ASSERT_GT(welcome.size(), kHeaderBytes);
  EXPECT_EQ(welcome[2], static_cast<std::uint8_t>(FrameType::Welcome));
  const Bytes scene = browser.message();
  ASSERT_GT(scene.size(), kHeaderBytes);
  EXPECT_EQ(std::string(scene.begin() + kHeaderBytes, scene.end()), R"({"scene": {}})");
  browser.send_message(frame_bytes(encode(Ping{77}), 1));
  const Bytes pong = browser.message();
  ASSERT_EQ(pong.size(), kHeaderBytes + 24);
  EXPECT_EQ(pong[kHeaderBytes], 77);
}

TEST(WebSocket, ABadFrameIsAnsweredAndClosed) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  Browser browser(listener);
  browser.ask("localhost", "");
  browser.send_message(Bytes(40, 0xEE));
  const Bytes bye = browser.message();
  ASSERT_GT(bye.size(), kHeaderBytes);
  EXPECT_EQ(bye[2], static_cast<std::uint8_t>(FrameType::Bye));
  EXPECT_TRUE(browser.is_closed());
}

TEST(WebSocket, FramesMayComeInPiecesAndSeveralAtOnce) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  Browser browser(listener);
  browser.ask("localhost", "");
  const Bytes hello = frame_bytes(encode(Hello{}), 0);
  browser.send_message({hello.begin(), hello.begin() + 5});
  browser.send_message({hello.begin() + 5, hello.end() - 1});
  browser.send_message({hello.end() - 1, hello.end()});
  EXPECT_GT(browser.message().size(), kHeaderBytes);  // Welcome
  browser.message();                                  // the scene
  Bytes pings;
  for (std::uint32_t i = 1; i <= 3; ++i) {
    const Bytes ping = frame_bytes(encode(Ping{100 + i}), i);
    pings.insert(pings.end(), ping.begin(), ping.end());
  }
  browser.send_message(pings);
  for (std::uint8_t i = 1; i <= 3; ++i) {
    const Bytes pong = browser.message();
    ASSERT_EQ(pong.size(), kHeaderBytes + 24);
    EXPECT_EQ(pong[kHeaderBytes], 100 + i);
  }
}

TEST(WebSocket, AMessageOfTextEndsIt) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  Browser browser(listener);
  browser.ask("localhost", "");
  browser.send_message({'h', 'i'}, 0x81);
  EXPECT_TRUE(browser.is_closed());
  EXPECT_TRUE(comes_true([&] { return host.server->client_count() == 0; }));
}

TEST(WebSocket, ABrowserThatIsClosedGivesItsHandBack) {
  LoopbackServer host({}, 1);
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  Hello hello;
  hello.role = Role::Student;
  hello.wants.hand = true;
  constexpr std::size_t kHandAt = kHeaderBytes + 12;  // in a Welcome
  {
    Browser browser(listener);
    browser.ask("localhost", "");
    browser.send_message(frame_bytes(encode(hello), 0));
    const Bytes welcome = browser.message();
    ASSERT_GT(welcome.size(), kHandAt);
    ASSERT_EQ(welcome[kHandAt], 0);
  }
  ASSERT_TRUE(comes_true([&] { return host.server->client_count() == 0; }));
  Browser next(listener);
  next.ask("localhost", "");
  next.send_message(frame_bytes(encode(hello), 0));
  const Bytes welcome = next.message();
  ASSERT_GT(welcome.size(), kHandAt);
  EXPECT_EQ(welcome[kHandAt], 0);
}

TEST(WebSocket, PagesOfOtherSitesStayOutside) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server, {"https://lab.example"});
  EXPECT_TRUE(Browser(listener).ask("localhost", "https://evil.example").starts_with("HTTP/1.1 403"));
  EXPECT_TRUE(Browser(listener).ask("evil.example", "http://evil.example").starts_with("HTTP/1.1 403"));
  EXPECT_TRUE(Browser(listener).ask("localhost", "null").starts_with("HTTP/1.1 403"));
  EXPECT_TRUE(Browser(listener).ask("localhost", "https://lab.example").starts_with("HTTP/1.1 101"));
}

TEST(WebSocket, KnowsItsOwnNames) {
  EXPECT_TRUE(may_open("127.0.0.1:7481", "http://127.0.0.1:7481", {}));
  EXPECT_TRUE(may_open("[::1]:7481", "http://[::1]", {}));
  EXPECT_TRUE(may_open("192.168.7.5:7481", "", {}));
  EXPECT_FALSE(may_open("rebound.example", "", {}));
  EXPECT_FALSE(may_open("", "", {}));
  EXPECT_FALSE(may_open("localhost", "http://localhost.evil.example", {}));
}

TEST(WebSocket, WhatIsNoRequestIsClosed) {
  LoopbackServer host;
  const WebSocketListener listener({"127.0.0.1", 0}, *host.server);
  for (const std::string& request : {std::string("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"),
                                     std::string("\x16\x03\x01\r\n\r\n"), "GET /" + std::string(20'000, 'a')}) {
    Browser browser(listener);
    browser.send_text(request);
    EXPECT_TRUE(browser.is_closed());
  }
  Client witness(host.client(false, Role::Viewer));
  EXPECT_NO_THROW(witness.start());
}

}  // namespace
}  // namespace myotact::net
