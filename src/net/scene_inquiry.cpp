#include "net/scene_inquiry.h"

#include <fmt/format.h>

#include "core/error.h"
#include "net/frame_stream.h"

namespace myotact::net {

namespace {

constexpr std::chrono::milliseconds kConnectWait(2000), kAnswerWait(30'000);  // a lockstep server may still be settling

std::string reason_of(const Frame& frame) {
  Bye bye;
  if (frame.header.type == FrameType::Bye && decode(frame.payload, bye) && !bye.text.empty()) return bye.text;
  return "what answers there is no server of this protocol";
}

}  // namespace

SceneAnswer read_scene(FrameStream& stream, const Endpoint& server) {
  const auto fail = [&](const std::string& why) {
    return Error(ExitStatus::Unavailable, fmt::format("{}:{}: {}", server.host, server.port, why));
  };
  SceneAnswer answer;
  const auto first = stream.read();
  if (!first) throw fail(stream.why());
  if (first->header.type != FrameType::Welcome || !decode(first->payload, answer.welcome))
    throw fail(reason_of(*first));
  const auto second = stream.read();
  if (!second) throw fail(stream.why());
  if (second->header.type != FrameType::Control) throw fail(reason_of(*second));
  answer.scene_json.assign(second->payload.begin(), second->payload.end());
  return answer;
}

SceneAnswer ask_scene(const Endpoint& server, const Token& token) {
  FrameStream stream(connect_to(server, kConnectWait), kAnswerWait);
  Hello hello;
  hello.token = token;
  stream.write(encode(hello), 0);
  SceneAnswer answer = read_scene(stream, server);
  stream.write(encode(Bye{ByeReason::Leaving, ""}), 0);
  return answer;
}

}  // namespace myotact::net
