#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "core/error.h"
#include "net/frame_stream.h"
#include "net/scene_inquiry.h"
#include "net/tool_state_frames.h"

// What a path gets in lockstep from `myotact serve --lockstep`, byte for byte, for comparison with clients in other
// languages: drive PORT STATES FILE LINE
// LINE: muscle whose line is in hand from the tenth state on, or -1.

namespace {

using namespace myotact;

messages::ToolState state_on_path(int i, int line) {
  messages::ToolState state;
  // Numbers that every language computes to the same bits.
  state.tool_position_world_m = {0.001 * (i % 30), -0.0005 * (i % 20), 0.00025 * (i % 40)};
  state.proxy_position_world_m = state.tool_position_world_m;
  state.sequence = static_cast<std::uint64_t>(i);
  if (line < 0 || i < 10) return state;
  state.grabbed_line = line;
  state.grab_fraction = 0.5;
  state.line_stiffness_N_m = 100.0;
  return state;
}

void drive(const net::Endpoint& server, int states, int line, std::ostream& out) {
  constexpr std::chrono::milliseconds kPatience(60'000);
  net::FrameStream stream(net::connect_to(server, kPatience), kPatience);
  net::Hello hello;
  hello.role = net::Role::Student;
  hello.wants = {true, true, true, false};
  stream.write(net::encode(hello), 0);
  net::read_scene(stream, server);
  for (int i = 0; i < states; ++i) {
    const std::uint64_t time_ns = 1'000'000 * static_cast<std::uint64_t>(i);
    const net::ToolStateFrames state = net::encode(state_on_path(i, line));
    for (const net::SmallFrame& frame : state.used()) stream.write(frame, time_ns);
    for (bool answered = false; !answered;) {
      const auto frame = stream.read();
      if (!frame) throw Error(ExitStatus::Unavailable, stream.why());
      const net::HeaderBytes head = net::header_bytes(frame->header, frame->payload);
      out.write(reinterpret_cast<const char*>(head.data()), head.size());
      out.write(reinterpret_cast<const char*>(frame->payload.data()),
                static_cast<std::streamsize>(frame->payload.size()));
      answered = frame->header.type == net::FrameType::LocalModel;
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 5) return 2;
  try {
    std::ofstream out(arguments[3], std::ios::binary);
    drive({"127.0.0.1", static_cast<std::uint16_t>(std::atoi(arguments[1]))}, std::atoi(arguments[2]),
          std::atoi(arguments[4]), out);
    return out.flush() ? 0 : 1;
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
