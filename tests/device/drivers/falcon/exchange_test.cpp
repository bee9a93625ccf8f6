// Which reports are believed, one by one, on a clock of the test's.

#include "device/drivers/falcon/exchange.h"

#include <cmath>

#include <gtest/gtest.h>

#include "device/drivers/falcon/kinematics.h"

namespace myotact::device::falcon {
namespace {

constexpr std::uint64_t kTurn_ns = 1'000'000;

class FalconExchange : public ::testing::Test {
 protected:
  FalconExchange() {
    const auto angles_rad = angles_of({0.0, 0.0, 0.125});
    for (std::size_t leg = 0; leg < 3; ++leg) {
      report_.encoder_counts[leg] = static_cast<std::int16_t>(std::lround(counts_of_angle((*angles_rad)[leg])));
    }
    report_.is_homed = {true, true, true};
  }
  /// True: the motors push.
  bool turn() {
    now_ns_ += kTurn_ns;
    exchange_.take(report_, now_ns_);
    return pushes();
  }
  bool pushes() const {
    const Command sent = decode_command(exchange_.command({{0.0, 0.0, 1.0}, now_ns_}, now_ns_));
    return sent.motor_counts != std::array<std::int16_t, 3>{};
  }
  void shift(int counts) {
    for (std::int16_t& count : report_.encoder_counts) count = static_cast<std::int16_t>(count + counts);
  }

  Exchange exchange_{ExchangeSettings{}};
  Report report_;
  std::uint64_t now_ns_ = 1'000'000'000;
};

TEST_F(FalconExchange, AHomedOneIsFeltFromItsFirstReport) {
  EXPECT_TRUE(turn());
  EXPECT_NEAR(exchange_.position_m().norm(), 0.0, 1e-4);
  EXPECT_EQ(exchange_.reported_ns(), now_ns_);
}

TEST_F(FalconExchange, HomingAnewWhereverItIsTakesTheForceForAWhile) {
  ASSERT_TRUE(turn());
  report_.is_homed[1] = false;
  EXPECT_FALSE(turn());
  report_.is_homed[1] = true;
  shift(500);
  for (int ms = 0; ms < 100; ++ms) ASSERT_FALSE(turn()) << ms;
  EXPECT_TRUE(turn());
}

TEST_F(FalconExchange, EncodersThatFlipAllTheTimePushNever) {
  ASSERT_TRUE(turn());
  for (int i = 0; i < 1000; ++i) {
    shift(i % 2 == 0 ? 450 : -450);
    ASSERT_FALSE(turn()) << i;
  }
}

TEST_F(FalconExchange, CountsThatNoFalconHasPushNever) {
  for (const int counts : {4000, 9681, -4000, 32000}) {
    Exchange fresh{ExchangeSettings{}};
    exchange_ = fresh;
    const Report good = report_;
    report_.encoder_counts[0] = static_cast<std::int16_t>(counts);
    for (int ms = 0; ms < 300; ++ms) ASSERT_FALSE(turn()) << counts;
    report_ = good;
  }
}

TEST_F(FalconExchange, WithoutReportsTheForceEndsWithinTwoTurnsOfFiveMilliseconds) {
  ASSERT_TRUE(turn());
  now_ns_ += 10'000'000;
  EXPECT_TRUE(pushes());
  now_ns_ += 1;
  EXPECT_FALSE(pushes());
}

}  // namespace
}  // namespace myotact::device::falcon
