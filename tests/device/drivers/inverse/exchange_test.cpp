#include "device/drivers/inverse/exchange.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "device/drivers/inverse/states.h"
#include "support/allocation_guard.h"

namespace myotact::device::inverse {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StrEq;

constexpr std::uint64_t kTick_ns = 1'000'000;

/// An exchange with a service that answers at once, stepped by a tick of 1 ms: no thread, no clock.
class InverseExchange : public ::testing::Test {
 protected:
  void begin() { exchange_.begin(CommandForm::Vector, now_ns_); }

  messages::DeviceState tick(const Vec3& force_N) {
    now_ns_ += kTick_ns;
    const messages::DeviceState state = exchange_.read(now_ns_);
    exchange_.write({to_array(force_N)});
    return state;
  }
  /// What the next command says [N], in the service's frame.
  Vec3 sent_N() {
    const auto json = nlohmann::json::parse(exchange_.next_command(now_ns_));
    const auto& force = json["inverse3"][0]["commands"]["set_cursor_force"]["vector"];
    return Vec3(force["x"].get<double>(), force["y"].get<double>(), force["z"].get<double>());
  }
  std::string answer(const std::string& text) { return exchange_.take(text, now_ns_); }
  std::string answer() { return answer(state_text("049D", position_m_)); }

  /// Ticks with a force of 1 N up, each answered.
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      tick(Vec3(0, 1, 0));
      sent_N();
      ASSERT_EQ(answer(), "");
    }
  }
  void make_ready() {
    begin();
    run(kGoodBeforeReady + 2);
    ASSERT_EQ(exchange_.report().phase, DevicePhase::Ready);
    tick(Vec3(0, 1, 0));
    ASSERT_TRUE(exchange_.connected());
    ASSERT_EQ(sent_N(), Vec3(0, 0, 1));
    ASSERT_EQ(answer(), "");
  }

  InverseSettings settings_;
  Vec3 position_m_{0.01, -0.15, 0.22};
  std::uint64_t now_ns_ = 5'000'000'000;
  Exchange exchange_{"049D", 0, settings_};
};

TEST_F(InverseExchange, NothingIsFeltBeforeItIsOpenAndThenUntilSomeStatesCame) {
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Closed);
  tick(Vec3(0, 5, 0));
  EXPECT_FALSE(exchange_.connected());
  begin();
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Opening);
  for (int i = 0; i < kGoodBeforeReady; ++i) {
    tick(Vec3(0, 5, 0));
    EXPECT_FALSE(exchange_.connected());
    EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
    EXPECT_EQ(answer(), "");
  }
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Ready);
  EXPECT_EQ(sent_N(), Vec3(0, 0, 0)) << "the last force answered no state of this phase";
  tick(Vec3(0, 5, 0));
  EXPECT_TRUE(exchange_.connected());
  EXPECT_EQ(sent_N(), Vec3(0, 0, 5));
}

TEST_F(InverseExchange, FramesAreTurnedBothWays) {
  make_ready();
  now_ns_ += kTick_ns;
  answer(state_text("049D", {0.01, -0.14, 0.23}, {0.1, 0.2, 0.3}, R"("button_0":true)"));
  const messages::DeviceState state = tick(Vec3(1, 2, 3));
  EXPECT_NEAR(state.stylus_position_world_m[0], 0.01, 1e-12);
  EXPECT_NEAR(state.stylus_position_world_m[1], 0.03, 1e-12) << "up";
  EXPECT_NEAR(state.stylus_position_world_m[2], -0.01, 1e-12) << "away from the person is -z";
  EXPECT_THAT(state.stylus_velocity_world_m_s, ElementsAre(0.1, 0.3, -0.2));
  EXPECT_EQ(state.buttons, 1U);
  EXPECT_EQ(sent_N(), Vec3(1, -3, 2));
  answer(state_text("049D", {0.01, -0.14, 0.23}, {0.1, 0.2, 0.3}, R"("a":false,"b":true,"c":true)"));
  EXPECT_EQ(tick(Vec3::Zero()).buttons, messages::kClutchButton | messages::kGrabBoneButton);
  const Vec3 any(0.3, -0.7, 1.1);
  EXPECT_EQ(device_from_service(service_from_device(any)), any);
}

TEST_F(InverseExchange, ForcesAreLimitedAndNonsenseIsZero) {
  make_ready();
  const auto sent_for = [&](const Vec3& force_N) {
    tick(force_N);
    const Vec3 sent = sent_N();
    answer();
    return sent;
  };
  const double peak_N = settings_.profile.peak_force_N;
  EXPECT_NEAR(sent_for(Vec3(0, 1.2 * peak_N, 0)).z(), peak_N, 1e-4);
  EXPECT_NEAR(sent_for(Vec3(0.8 * peak_N, 0.8 * peak_N, 0.8 * peak_N)).norm(), peak_N, 1e-4);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 1e300, 25.0}) {
    EXPECT_EQ(sent_for(Vec3(0, bad, 0)), Vec3(0, 0, 0)) << bad;
  }
}

TEST_F(InverseExchange, SilenceEndsTheForceAndStatesBringItBackThroughZero) {
  make_ready();
  const std::uint64_t heard_ns = now_ns_;
  while (now_ns_ <= heard_ns + kSilence_ns) {
    EXPECT_TRUE(exchange_.connected());
    tick(Vec3(0, 1, 0));
  }
  EXPECT_FALSE(exchange_.connected()) << "the tick notices by itself";
  EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Lost);
  EXPECT_THAT(exchange_.report().hint, HasSubstr("haply-inverse-service"));
  for (int i = 0; i < kGoodBeforeReady; ++i) {
    EXPECT_EQ(exchange_.report().phase, DevicePhase::Lost);
    answer();
    tick(Vec3(0, 1, 0));
    now_ns_ += kTick_ns;
    if (i + 1 < kGoodBeforeReady) {
      EXPECT_EQ(sent_N(), Vec3(0, 0, 0)) << i;
    }
  }
  EXPECT_TRUE(exchange_.connected());
  EXPECT_EQ(sent_N(), Vec3(0, 0, 1));
  EXPECT_THAT(exchange_.report().hint, StrEq(""));
}

TEST_F(InverseExchange, AfterAServiceThatStoodStillNoForceIsBehindAQueue) {
  constexpr std::uint64_t kService_ns = 1'000'000, kStep_ns = 100'000;
  begin();
  int queued = 0, most_queued = 0, felt = 0;
  std::uint64_t busy_until_ns = now_ns_;
  const std::uint64_t begun_ns = now_ns_;
  for (int step = 0; step < 30'000; ++step) {
    now_ns_ += kStep_ns;
    const std::uint64_t ran_ns = now_ns_ - begun_ns;
    const bool stands = ran_ns > 500'000'000 && ran_ns < 1'400'000'000;
    exchange_.read(now_ns_);
    exchange_.write({{0.0, 1.0, 0.0}});
    if (now_ns_ >= exchange_.due_ns()) {
      const Vec3 sent = sent_N();
      if (queued == 0) busy_until_ns = now_ns_ + kService_ns;
      most_queued = std::max(most_queued, ++queued);
      if (sent != Vec3::Zero()) {
        ASSERT_EQ(queued, 1) << "a force is the only command under way";
        felt += ran_ns > 1'400'000'000 ? 1 : 0;
      }
    }
    if (queued > 0 && !stands && now_ns_ >= busy_until_ns) {
      answer();
      --queued;
      busy_until_ns = now_ns_ + kService_ns;
    }
  }
  EXPECT_EQ(most_queued, 2);
  EXPECT_GT(felt, 1000);
}

TEST_F(InverseExchange, ADeviceThatIsGoneIsLostAtOnce) {
  make_ready();
  EXPECT_THAT(answer(R"({"session_id":7,"inverse3":[]})"), HasSubstr("049D"));
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Lost);
  EXPECT_THAT(exchange_.report().hint, HasSubstr("cable"));
  EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
  EXPECT_NE(answer(R"({"session_id":7,"inverse3":[]})"), "");
  tick(Vec3(0, 1, 0));
  EXPECT_FALSE(exchange_.connected());
  run(kGoodBeforeReady);
  tick(Vec3(0, 1, 0));
  EXPECT_TRUE(exchange_.connected());
}

TEST_F(InverseExchange, AnotherDevicesStateIsNotOurs) {
  make_ready();
  EXPECT_NE(answer(state_text("049E", position_m_)), "");
  EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
}

TEST_F(InverseExchange, BrokenAndImpossibleStatesAreFaults) {
  for (const std::string& bad : {std::string("{\"inverse3\":[{"), std::string("\xff\xfe"),
                                 state_text("049D", {0.31, -0.15, 0.22}), state_text("049D", {9, 0, 0})}) {
    make_ready();
    EXPECT_NE(answer(bad), "");
    EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
    tick(Vec3(0, 1, 0));
    EXPECT_FALSE(exchange_.connected());
  }
}

TEST_F(InverseExchange, AFastHandIsNoFault) {
  make_ready();
  for (int i = 0; i < 100; ++i) {
    position_m_.x() += i < 50 ? 0.004 : -0.004;  // 4 m/s
    run(1);
    ASSERT_EQ(exchange_.report().phase, DevicePhase::Ready);
  }
}

TEST_F(InverseExchange, AnAxisLeftOutKeepsItsLastNumberAndAllLeftOutAreNotFresh) {
  make_ready();
  EXPECT_EQ(answer(R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":0.02}}}]})"), "");
  const messages::DeviceState state = tick(Vec3(0, 1, 0));
  EXPECT_NEAR(state.stylus_position_world_m[0], 0.02, 1e-12);
  EXPECT_NEAR(state.stylus_position_world_m[1], 0.02, 1e-12);
  for (std::uint64_t i = 0; i <= kSilence_ns / kTick_ns; ++i) {
    sent_N();
    EXPECT_NE(answer(R"({"inverse3":[{"device_id":"049D","state":{}}]})"), "");
    tick(Vec3(0, 1, 0));
  }
  EXPECT_FALSE(exchange_.connected());
  EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
}

TEST_F(InverseExchange, ATickThatStandsStillEndsTheForce) {
  make_ready();
  for (std::uint64_t waited_ns = 0; waited_ns < 2 * kSilence_ns; waited_ns += kTick_ns) {
    now_ns_ += kTick_ns;
    const Vec3 sent = sent_N();
    if (waited_ns > kSilence_ns) {
      EXPECT_EQ(sent, Vec3(0, 0, 0));
    }
    answer();
  }
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Ready);
}

TEST_F(InverseExchange, AForceOfAnEarlierPhaseIsNotSentInALaterOne) {
  make_ready();
  answer("garbage");
  for (int i = 0; i < kGoodBeforeReady; ++i) answer();  // within the same millisecond, without a tick
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Ready);
  EXPECT_EQ(sent_N(), Vec3(0, 0, 0));
}

TEST_F(InverseExchange, OneCommandAtATimeUntilSilence) {
  begin();
  EXPECT_LE(exchange_.due_ns(), now_ns_);
  sent_N();
  EXPECT_EQ(exchange_.due_ns(), now_ns_ + kSilence_ns) << "no answer yet";
  answer();
  EXPECT_EQ(exchange_.due_ns(), now_ns_ + kExchange_ns);
}

TEST_F(InverseExchange, TheRateIsCounted) {
  begin();
  run(3000);
  EXPECT_NEAR(exchange_.report().rate_Hz, 1000.0, 2.0);
  exchange_.end(DevicePhase::Lost);
  EXPECT_EQ(exchange_.report().rate_Hz, 0.0);
  EXPECT_EQ(exchange_.report().phase, DevicePhase::Lost);
}

TEST_F(InverseExchange, ATickAllocatesNothing) {
  make_ready();
  for (int i = 0; i < 1000; ++i) {
    answer();
    const support::AllocationGuard guard;
    tick(Vec3(0, 1, 0));
    exchange_.connected();
    exchange_.report();
    ASSERT_EQ(guard.allocations(), 0U);
    sent_N();
  }
}

}  // namespace
}  // namespace myotact::device::inverse
