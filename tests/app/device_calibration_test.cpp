// What --calibrate asks a person and makes of the answers; a device of the test's, a pipe for the keyboard.

#include "app/device_calibration.h"

#include <atomic>
#include <chrono>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace myotact::app {
namespace {

using ::testing::HasSubstr;

/// At rest in the middle; wants to be homed until it was read some hundred times.
class RestingDevice : public device::HardwareDevice {
 public:
  const std::string& name() const override { return name_; }
  const device::DeviceProfile& profile() const override { return profile_; }
  void open() override {}
  void close() noexcept override {}
  bool connected() const noexcept override { return is_homed(); }
  messages::DeviceState read(std::uint64_t now_ns) noexcept override {
    ++reads_;
    messages::DeviceState state;
    state.sampled_at_ns = now_ns;
    return state;
  }
  void write(const messages::DeviceCommand& command) noexcept override {
    const double down_N = -command.force_world_N[1];
    if (!is_homed()) felt_unhomed_ = felt_unhomed_ || down_N != 0.0;
    if (down_N > most_N_) most_N_ = down_N;
    last_N_ = down_N;
  }
  device::DeviceReport report() const noexcept override {
    if (is_homed()) return {device::DevicePhase::Ready, 1000.0, -1.0, ""};
    return {device::DevicePhase::NeedsCalibration, 1000.0, -1.0, "Pull the grip out."};
  }

  double most_N() const { return most_N_; }
  double last_N() const { return last_N_; }
  bool felt_unhomed() const { return felt_unhomed_; }

 private:
  bool is_homed() const { return reads_ > 200; }

  const std::string name_ = "falcon";
  device::DeviceProfile profile_{.peak_force_N = 8.0, .continuous_force_N = 4.0};
  std::atomic<int> reads_{0};
  std::atomic<double> most_N_{0.0}, last_N_{0.0};
  std::atomic<bool> felt_unhomed_{false};
};

class Calibration : public ::testing::Test {
 protected:
  Calibration() { EXPECT_EQ(::pipe(ends_), 0); }
  ~Calibration() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  void answer(const std::string& text) { EXPECT_EQ(::write(ends_[1], text.data(), text.size()), ssize_t(text.size())); }
  std::optional<double> calibrate(const std::optional<ForceScale>& scale) {
    LineInput answers(ends_[0]);
    return calibrate_device(device_, scale, answers, told_).scale;
  }

  RestingDevice device_;
  std::ostringstream told_;
  int ends_[2] = {-1, -1};
};

constexpr ForceScale kScale{4000.0, 100.0, 20'000.0};

TEST_F(Calibration, WeighsThePullAndCorrectsTheScale) {
  answer("yes\n");
  // The balance is read while it pulls.
  std::thread person([this] {
    while (device_.last_N() < 1.99) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    answer("1.0\n");
  });
  const auto found = calibrate(kScale);
  person.join();
  EXPECT_THAT(told_.str(), HasSubstr("Pull the grip out."));
  ASSERT_TRUE(found);
  EXPECT_DOUBLE_EQ(*found, 8000.0) << "half of what was wanted: twice the counts";
  EXPECT_LT(device_.most_N(), 2.1);
  EXPECT_FALSE(device_.felt_unhomed());
}

TEST_F(Calibration, NeverPullsWithoutAYes) {
  answer("no\n");
  EXPECT_FALSE(calibrate(kScale));
  EXPECT_EQ(device_.most_N(), 0.0);
  EXPECT_THAT(told_.str(), HasSubstr("the scale stays"));
}

TEST_F(Calibration, DoesNotBelieveWhatIsNoForce) {
  for (const char* weight : {"heavy", "0", "-1", "1e9", "nan", ""}) {
    answer(std::string("yes\n") + weight + "\n");
    EXPECT_FALSE(calibrate(kScale)) << weight;
  }
  EXPECT_THAT(told_.str(), HasSubstr("the scale stays 4000"));
}

TEST_F(Calibration, EndsWhenNothingIsToBeWeighed) {
  EXPECT_FALSE(calibrate(std::nullopt));
  EXPECT_THAT(told_.str(), HasSubstr("ready"));
}

}  // namespace
}  // namespace myotact::app
