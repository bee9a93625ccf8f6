#include "remote/lockstep_hand.h"

#include <fmt/format.h>

#include "core/error.h"
#include "net/local_model_codec.h"
#include "net/scene_inquiry.h"
#include "net/tool_state_frames.h"
#include "scene/lockstep_haptics.h"

namespace myotact::remote {

namespace {

constexpr std::chrono::milliseconds kConnectWait(2000), kPatience(60'000);

}  // namespace

LockstepHand::LockstepHand(const net::Endpoint& server, const net::Token& token, const scene::ToolSettings& tool,
                           ScriptedDevice& device)
    : server_(server),
      stream_(net::connect_to(server, kConnectWait), kPatience),
      device_(&device),
      loop_(device.device(), scene::haptic_settings(tool)) {
  net::Hello hello;
  hello.role = net::Role::Student;
  hello.wants.hand = true;
  hello.token = token;
  hello.name = "feel";
  stream_.write(net::encode(hello), 0);
  step_ns_ = net::read_scene(stream_, server).welcome.step_ns;
  loop_.prepare(clock_ns_);
  exchange();
}

double LockstepHand::time_s() const {
  return static_cast<double>(clock_ns_ - haptics::kTickPeriod_ns) / 1e9;  // by division: the nearest to whole ms
}

void LockstepHand::step(const std::function<void(double, const haptics::HapticTick&)>& each_tick) {
  device_->begin_step(time_s());
  const std::uint64_t ticks = (step_ns_ + haptics::kTickPeriod_ns / 2) / haptics::kTickPeriod_ns;
  for (std::uint64_t i = 0; i < ticks; ++i) {
    const double now_s = time_s();
    device_->move_to(now_s);
    loop_.tick(clock_ns_);
    clock_ns_ += haptics::kTickPeriod_ns;
    each_tick(now_s, loop_.last_tick());
  }
  exchange();
}

void LockstepHand::exchange() {
  const net::ToolStateFrames state = net::encode(loop_.tool_state());
  for (const net::SmallFrame& frame : state.used()) stream_.write(frame, clock_ns_);
  for (;;) {
    const auto frame = stream_.read();
    if (!frame) {
      throw Error(ExitStatus::Unavailable, fmt::format("{}:{}: {}", server_.host, server_.port, stream_.why()));
    }
    if (frame->header.type != net::FrameType::LocalModel) continue;
    if (!net::decode(frame->payload, loop_.models().back())) {
      throw Error(ExitStatus::Unavailable,
                  fmt::format("{}:{}: sent an invalid contact model", server_.host, server_.port));
    }
    loop_.models().publish();
    return;
  }
}

}  // namespace myotact::remote
