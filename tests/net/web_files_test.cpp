#include <array>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "net/websocket_listener.h"
#include "support/loopback_server.h"

// Files over HTTP beside the WebSocket, asked for with bytes as RFC 9112 has them.

namespace myotact::net {
namespace {

using testing::LoopbackServer;

const std::string kPage = "<!doctype html><title>A limb</title>" + std::string(2000, ' ');

struct Answer {
  std::string head, body;
  bool has(const std::string& line) const { return head.find(line) != std::string::npos; }
};

class WebFilesTest : public ::testing::Test {
 protected:
  /// All that comes until the connection ends.
  Answer ask(const std::string& request) const {
    const Socket socket = connect_to({"127.0.0.1", listener_.port()}, std::chrono::milliseconds(2000));
    set_patience(socket, std::chrono::milliseconds(5000));
    send(socket, {reinterpret_cast<const std::uint8_t*>(request.data()), request.size()}, {}, false,
         std::chrono::milliseconds(1000));
    std::string all;
    std::array<std::uint8_t, 4096> room{};
    for (std::size_t count = 0; receive(socket, room, count) == Received::Some;)
      all.append(room.begin(), room.begin() + static_cast<std::ptrdiff_t>(count));
    const std::size_t end = all.find("\r\n\r\n");
    return end == std::string::npos ? Answer{all, ""} : Answer{all.substr(0, end), all.substr(end + 4)};
  }
  Answer get(const std::string& path, const std::string& more = "", const std::string& host = "127.0.0.1:7481") const {
    return ask("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + more + "\r\n");
  }

  LoopbackServer host_;
  WebSocketListener listener_{
      {"127.0.0.1", 0}, *host_.server, {}, {{"/", web_file("text/html; charset=utf-8", kPage)}}};
};

TEST_F(WebFilesTest, APageComesWholeAndMayLoadFromHereAlone) {
  const Answer answer = get("/?from=here");
  EXPECT_TRUE(answer.has("HTTP/1.1 200")) << answer.head;
  EXPECT_EQ(answer.body, kPage);
  EXPECT_TRUE(answer.has("Content-Type: text/html; charset=utf-8"));
  EXPECT_TRUE(answer.has("Content-Security-Policy: default-src 'none'; script-src 'self'; style-src 'self'"));
  EXPECT_TRUE(answer.has("connect-src 'self' ws://127.0.0.1:7481;"));
  EXPECT_TRUE(answer.has("X-Content-Type-Options: nosniff"));
}

TEST_F(WebFilesTest, IsSentCompressedToWhoTakesIt) {
  const Answer answer = get("/", "Accept-Encoding: gzip, deflate, br\r\n");
  EXPECT_TRUE(answer.has("Content-Encoding: gzip"));
  EXPECT_LT(answer.body.size(), kPage.size() / 4);
  z_stream stream{};
  ASSERT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  std::string page(kPage.size() + 1, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(answer.body.data()));
  stream.avail_in = static_cast<uInt>(answer.body.size());
  stream.next_out = reinterpret_cast<Bytef*>(page.data());
  stream.avail_out = static_cast<uInt>(page.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  page.resize(stream.total_out);
  inflateEnd(&stream);
  EXPECT_EQ(page, kPage);
}

TEST_F(WebFilesTest, WhoHasItAlreadyIsToldSo) {
  const std::string tag = web_file("", kPage).tag;
  const Answer answer = get("/", "If-None-Match: " + tag + "\r\n");
  EXPECT_TRUE(answer.has("HTTP/1.1 304")) << answer.head;
  EXPECT_EQ(answer.body, "");
  EXPECT_TRUE(get("/", "If-None-Match: \"other\"\r\n").has("HTTP/1.1 200"));
}

TEST_F(WebFilesTest, NothingElseCanBeGot) {
  for (const char* path : {"/secret", "/../etc/passwd", "//", "/%2e%2e/", "*"}) {
    EXPECT_TRUE(get(path).has("HTTP/1.1 404")) << path;
  }
  EXPECT_TRUE(ask("DELETE / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n").has("HTTP/1.1 405"));
  const Answer head = ask("HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  EXPECT_TRUE(head.has("Content-Length: " + std::to_string(kPage.size())));
  EXPECT_EQ(head.body, "");
}

TEST_F(WebFilesTest, AForeignNameThatPointsHereGetsNothing) {
  const Answer answer = get("/", "", "rebound.example");
  EXPECT_TRUE(answer.has("HTTP/1.1 403"));
  EXPECT_NE(answer.body.find("address"), std::string::npos);
}

TEST_F(WebFilesTest, SeveralRequestsMayUseOneConnection) {
  const std::string request = "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
  const Answer answers = ask(request + request + "GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  std::size_t count = 0;
  for (std::size_t at = 0; (at = answers.body.find("HTTP/1.1 200", at)) != std::string::npos; ++at) ++count;
  EXPECT_EQ(count, 2u) << "the first is before the body";
}

TEST(SecurityPolicy, AHostThatIsNoneAddsNothing) {
  EXPECT_EQ(security_policy("a b; script-src *").find("ws://"), std::string::npos);
  EXPECT_NE(security_policy("[::1]:7481").find(" ws://[::1]:7481;"), std::string::npos);
}

}  // namespace
}  // namespace myotact::net
