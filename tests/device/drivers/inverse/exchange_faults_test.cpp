// A million ticks of an exchange whose service, connection and force all go wrong at random. Stepped: no thread, no
// clock. Whatever happens, no force beyond the limit is sent, and none at all from the second tick after a fault on
// until ten states in a row were good again.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "device/drivers/inverse/exchange.h"
#include "device/drivers/inverse/states.h"
#include "support/mutator.h"
#include "support/sanitizer.h"

namespace myotact::device::inverse {
namespace {

constexpr std::uint64_t kTick_ns = 1'000'000;
constexpr int kTicks = testing::kSanitizer ? 100'000 : 1'000'000;
constexpr double kRounding_N = 1e-5 * 1.8;  // five decimals, three axes

enum class Reply { Good, Garbage, Truncated, Mutated, NoDevice, NoPosition, Jump, Huge, Silence, Disconnect };

class Adversary {
 public:
  /// One tick of 1 ms: the haptic loop, then one exchange.
  void tick() {
    now_ns_ += kTick_ns;
    exchange_.read(now_ns_);
    if (must_be_zero()) {
      ASSERT_FALSE(exchange_.connected()) << "tick " << ticks_;
    }
    exchange_.write({to_array(wanted_force_N())});
    exchange_.silence_ns(now_ns_);
    if (!is_linked_ && now_ns_ >= quiet_until_ns_) link();
    if (is_linked_ && now_ns_ >= exchange_.due_ns()) send();
    if (is_linked_ && is_asked_ && now_ns_ >= quiet_until_ns_) reply();
    if (now_ns_ - delivered_ns_ > kSilence_ns) fault();
    ++ticks_;
  }

  int faults() const { return faults_; }
  int felt() const { return felt_; }

 private:
  std::uint64_t below(std::uint64_t limit) { return random_() % limit; }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Vec3 wanted_force_N() {
    const double infinite = std::numeric_limits<double>::infinity();
    Vec3 force_N(uniform(-4, 4), uniform(-4, 4), uniform(-4, 4));
    switch (below(20)) {
      case 0:
        force_N[static_cast<int>(below(3))] = std::numeric_limits<double>::quiet_NaN();
        break;
      case 1:
        force_N[static_cast<int>(below(3))] = below(2) == 0 ? infinite : -infinite;
        break;
      case 2:
        force_N *= 1e300;
        break;
      case 3:
        force_N *= 3.0;
        break;  // about the limit
      case 4:
        force_N *= 1e308;
        break;
      default:
        break;
    }
    return force_N;
  }

  void link() {
    exchange_.begin(CommandForm::Vector, now_ns_);
    is_linked_ = true;
    is_asked_ = false;
    delivered_ns_ = now_ns_;
  }

  void send() {
    const auto json = nlohmann::json::parse(exchange_.next_command(now_ns_));
    const auto& force = json.at("inverse3").at(0).at("commands").at("set_cursor_force").at("vector");
    const Vec3 force_N(force.at("x").get<double>(), force.at("y").get<double>(), force.at("z").get<double>());
    ASSERT_TRUE(force_N.allFinite());
    ASSERT_LE(force_N.norm(), settings_.profile.peak_force_N + kRounding_N) << "tick " << ticks_;
    if (must_be_zero()) {
      ASSERT_EQ(force_N, Vec3(0, 0, 0)) << "tick " << ticks_ << ", fault at " << fault_tick_;
    }
    if (force_N != Vec3::Zero()) ++felt_;
    is_asked_ = true;
  }

  Reply next_reply() {
    constexpr std::uint64_t kOneIn = 60;  // states is none
    return below(kOneIn) != 0 ? Reply::Good : static_cast<Reply>(1 + below(9));
  }

  void reply() {
    position_m_ += Vec3(uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3));
    position_m_ = position_m_.cwiseMax(Vec3(-0.1, -0.25, 0.1)).cwiseMin(Vec3(0.1, -0.05, 0.3));
    const std::string good = state_text("049D", position_m_, {0.1, 0.2, 0.3});
    switch (next_reply()) {
      case Reply::Good:
        return deliver(good, false);
      case Reply::Garbage:
        return deliver("\x01 no service {]", true);
      case Reply::Truncated:
        return deliver(good.substr(0, below(good.size())), true);
      case Reply::Mutated:
        return deliver_mutated(good);
      case Reply::NoDevice:
        return deliver(R"({"session_id":7,"inverse3":[{"device_id":"05AA"}]})", true);
      case Reply::NoPosition:
        return hand_over(R"({"inverse3":[{"device_id":"049D","state":{}}]})");
      case Reply::Jump:
        return deliver(state_text("049D", position_m_ + Vec3(1, 0, 0)), true);
      case Reply::Huge:
        return deliver(state_text("049D", {1e12, 0, 0}), true);
      case Reply::Silence:
        quiet_until_ns_ = now_ns_ + below(60) * kTick_ns;
        return;
      case Reply::Disconnect:
        return disconnect();
    }
  }

  void hand_over(const std::string& text) {
    exchange_.take(text, now_ns_);
    is_asked_ = false;
  }
  void deliver(const std::string& text, bool is_fault) {
    hand_over(text);
    if (is_fault) return fault();
    delivered_ns_ = now_ns_;
    ++good_;
  }
  /// May still be a good state, and counts as one: the exchange may be stricter than this test, not the other way.
  void deliver_mutated(const std::string& good) {
    hand_over(mutator_.broken(good));
    delivered_ns_ = now_ns_;
    ++good_;
  }
  void disconnect() {
    exchange_.end(DevicePhase::Lost);
    is_linked_ = false;
    quiet_until_ns_ = now_ns_ + below(100) * kTick_ns;
    fault();
  }
  void fault() {
    if (good_ > 0) {
      fault_tick_ = ticks_;
      ++faults_;
    }
    good_ = 0;
  }
  bool must_be_zero() const { return good_ < kGoodBeforeReady && ticks_ >= fault_tick_ + 2; }

  InverseSettings settings_;
  Exchange exchange_{"049D", 0, settings_};
  std::mt19937_64 random_{20261123};
  testing::Mutator mutator_;
  Vec3 position_m_{0, -0.15, 0.2};
  std::uint64_t now_ns_ = 1'000'000'000;
  std::uint64_t quiet_until_ns_ = 0;
  std::uint64_t delivered_ns_ = 0;  // when the service was last heard
  bool is_linked_ = false;
  bool is_asked_ = false;
  int ticks_ = 0;
  int fault_tick_ = -2;
  int good_ = 0;  // states since the last fault
  int faults_ = 0;
  int felt_ = 0;
};

TEST(InverseFaults, NeverBeyondTheLimitAndZeroWithinTwoTicksOfAnyFault) {
  Adversary adversary;
  for (int i = 0; i < kTicks; ++i) {
    adversary.tick();
    if (::testing::Test::HasFatalFailure()) return;
  }
  std::printf("%d ticks, %d faults, %d commands with a force\n", kTicks, adversary.faults(), adversary.felt());
  EXPECT_GT(adversary.faults(), kTicks / 300);
  EXPECT_GT(adversary.felt(), kTicks / 4) << "it also works in between";
}

}  // namespace
}  // namespace myotact::device::inverse
