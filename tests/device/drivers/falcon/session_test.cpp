#include "device/drivers/falcon/session.h"

#include <filesystem>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/file.h"
#include "device/drivers/falcon/firmware.h"
#include "fake_falcon.h"
#include "support/allocation_guard.h"
#include "support/sanitizer.h"

// The driver's own course against a Falcon in software, on a virtual clock.

namespace myotact::device::falcon {
namespace {

const Vec3 kMiddle_m(0.0, 0.0, 0.125);

struct Rig {
  explicit Rig(const ExchangeSettings& wanted = {})
      : settings(wanted), session(fake, settings, FakeFalcon::clock, &fake) {
    fake.boot_with_firmware();
  }
  void home() {
    fake.home();
    turns(5);
  }
  void turns(int count, const Vec3& force_N = Vec3::Zero()) {
    for (int i = 0; i < count; ++i) session.exchange_once({to_array(force_N), fake.now_ns()});
  }
  DevicePhase phase() const { return session.exchange().phase(fake.now_ns()); }
  Vec3 felt_N() const { return fake.force_N(settings.counts_per_Nm); }

  ExchangeSettings settings;
  FakeFalcon fake;
  Session session;
};

std::vector<std::uint8_t> some_image() {
  std::vector<std::uint8_t> image(8000);
  std::mt19937 random(3);
  for (std::uint8_t& byte : image) byte = static_cast<std::uint8_t>(random());
  image[0] = 0xaa;
  image[1] = 0x08;
  return image;
}

TEST(FalconFirmware, IsUploadedWholeAndRuns) {
  for (const bool zero : {false, true}) {
    FakeFalcon fake;
    if (zero) fake.greet_with_zero();
    start_firmware(fake, some_image());
    EXPECT_EQ(fake.uploaded(), some_image());
  }
}

TEST(FalconFirmware, OneThatRunsIsLeftAlone) {
  FakeFalcon fake;
  fake.boot_with_firmware();
  start_firmware(fake, {});
  EXPECT_TRUE(fake.uploaded().empty());
}

TEST(FalconFirmware, AnEchoThatDiffersIsTriedAgain) {
  FakeFalcon fake;
  fake.spoil_block(40);
  EXPECT_EQ(upload(fake, some_image()), Upload::EchoDiffers);
  fake.spoil_block(7);
  start_firmware(fake, some_image());
  EXPECT_EQ(fake.uploaded(), some_image());
}

TEST(FalconFirmware, WhatFailsIsSaid) {
  const auto message = [](Fault fault, std::vector<std::uint8_t> image) -> std::string {
    FakeFalcon fake;
    fake.set(fault);
    try {
      start_firmware(fake, image);
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), ExitStatus::Unavailable);
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message(Fault::None, {}).find("falcon.firmware"), std::string::npos);
  EXPECT_NE(message(Fault::Stall, some_image()).find("does not answer"), std::string::npos);
  EXPECT_NE(message(Fault::Gone, some_image()).find("went away"), std::string::npos);
}

TEST(FalconFirmware, AFileOfAnotherKindIsRefusedWithWhatItShouldBe) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "myotact_no_firmware.bin";
  const auto message = [&path] {
    try {
      read_firmware(path);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  std::filesystem::remove(path);
  EXPECT_NE(message().find(path.string()), std::string::npos);
  write_file(path, std::string(100, '\xaa'));
  EXPECT_NE(message().find("7000 .. 9000"), std::string::npos);
  write_file(path, std::string(8000, '\x11'));
  EXPECT_NE(message().find("11 11"), std::string::npos);
  write_file(path, "\xaa\x08" + std::string(8000, '\x11'));
  EXPECT_EQ(read_firmware(path).size(), 8002u);
  std::filesystem::remove(path);
}

TEST(FalconSession, ThereIsNoForceBeforeHoming) {
  Rig rig;
  rig.turns(200, {2.0, 0.0, 0.0});
  EXPECT_EQ(rig.phase(), DevicePhase::NeedsCalibration);
  EXPECT_EQ(rig.felt_N().norm(), 0.0);
  EXPECT_TRUE(rig.fake.last_command().homes);
  rig.home();
  rig.turns(250);  // a while, since homing is a leap
  EXPECT_EQ(rig.phase(), DevicePhase::Ready);
}

TEST(FalconSession, TheGripIsWhereTheHandHoldsItAndFeelsWhatIsWanted) {
  Rig rig;
  rig.home();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> across(-0.03, 0.03), push(-1.0, 1.0);
  Vec3 hand_m = kMiddle_m;
  for (int i = 0; i < 50; ++i) {
    const Vec3 next_m = kMiddle_m + Vec3(across(random), across(random), across(random));
    for (int step = 1; step <= 100; ++step) {
      rig.fake.hold(hand_m + step / 100.0 * (next_m - hand_m));
      rig.turns(1);
    }
    hand_m = next_m;
    const Vec3 wanted_N(push(random), push(random), push(random));
    rig.turns(3, wanted_N);
    EXPECT_LT((rig.session.exchange().position_m() - (hand_m - kMiddle_m)).norm(), 1e-4) << "two counts";
    EXPECT_LT((rig.felt_N() - wanted_N).norm(), 0.01) << "a motor's count, and a grip between two of an encoder";
  }
}

TEST(FalconSession, MoreThanThePeakIsNeverSentAndKeepsItsDirection) {
  ExchangeSettings settings;
  settings.peak_force_N = 2.0;
  Rig rig(settings);
  rig.home();
  rig.turns(3, {30.0, 40.0, 0.0});
  EXPECT_LT((rig.felt_N() - Vec3(1.2, 1.6, 0.0)).norm(), 0.01);
}

TEST(FalconSession, WhatIsNoNumberOrTooOldIsNoForce) {
  Rig rig;
  rig.home();
  rig.turns(3, {1.0, 0.0, 0.0});
  rig.turns(1, Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(rig.felt_N().norm(), 0.0);
  rig.session.exchange_once({{1.0, 0.0, 0.0}, rig.fake.now_ns() - 100'000'000});
  EXPECT_EQ(rig.felt_N().norm(), 0.0) << "the host stalled for 100 ms";
  rig.session.exchange_once({{1.0, 0.0, 0.0}, 0});
  EXPECT_EQ(rig.felt_N().norm(), 0.0) << "never asked";
}

TEST(FalconSession, FramesInPartsInPairsAndBehindGarbageAreRead) {
  for (const Fault fault : {Fault::Split, Fault::TwoAtOnce, Fault::GarbageBefore}) {
    Rig rig;
    rig.home();
    rig.fake.set(fault);
    const std::uint64_t before = rig.session.reports();
    rig.turns(50, {1.0, 0.0, 0.0});
    EXPECT_EQ(rig.phase(), DevicePhase::Ready) << static_cast<int>(fault);
    EXPECT_GE(rig.session.reports(), before + 50);
    EXPECT_NEAR(rig.felt_N().x(), 1.0, 0.01);
  }
}

TEST(FalconSession, SilenceTakesTheForceAndGivesItBackAfterwards) {
  for (const Fault fault : {Fault::NoReply, Fault::StatusOnly, Fault::Stall}) {
    Rig rig;
    rig.home();
    rig.turns(3, {1.0, 0.0, 0.0});
    rig.fake.set(fault);
    rig.turns(10, {1.0, 0.0, 0.0});
    EXPECT_NE(rig.phase(), DevicePhase::Ready) << static_cast<int>(fault);
    if (fault != Fault::Stall) {  // a stalled one takes no command any more
      EXPECT_EQ(rig.felt_N().norm(), 0.0) << static_cast<int>(fault);
    }
    rig.fake.set(Fault::None);
    rig.turns(3, {1.0, 0.0, 0.0});
    EXPECT_EQ(rig.phase(), DevicePhase::Ready);
  }
}

TEST(FalconSession, ALegThatForgetsItsStopTakesTheForceAtOnce) {
  Rig rig;
  rig.home();
  rig.turns(3, {1.0, 0.0, 0.0});
  rig.fake.set(Fault::HomedDrops);
  rig.turns(2, {1.0, 0.0, 0.0});
  EXPECT_EQ(rig.phase(), DevicePhase::NeedsCalibration);
  EXPECT_EQ(rig.felt_N().norm(), 0.0);
}

TEST(FalconSession, ALeapOfAnEncoderTakesTheForceAndIsCounted) {
  Rig rig;
  rig.home();
  rig.turns(3, {1.0, 0.0, 0.0});
  const Vec3 before_m = rig.session.exchange().position_m();
  rig.fake.set(Fault::EncoderLeaps);
  rig.turns(1, {1.0, 0.0, 0.0});
  EXPECT_NE(rig.phase(), DevicePhase::Ready);
  EXPECT_EQ(rig.session.exchange().position_m(), before_m);
  EXPECT_EQ(rig.session.exchange().refused_reports(), 1u);
  rig.fake.set(Fault::None);
  rig.turns(100, {1.0, 0.0, 0.0});
  EXPECT_EQ(rig.felt_N().norm(), 0.0) << "50 ms: not yet believed again";
  rig.turns(200, {1.0, 0.0, 0.0});
  EXPECT_NEAR(rig.felt_N().x(), 1.0, 0.01);
}

TEST(FalconSession, ButtonsAreReadWithTheLegsHomed) {
  Rig rig;
  rig.home();
  rig.fake.press(0x5);
  rig.turns(2);
  EXPECT_EQ(rig.session.exchange().buttons(), 0x5);
  EXPECT_EQ(rig.phase(), DevicePhase::Ready);
}

TEST(FalconSession, TheLastCommandPushesNothing) {
  Rig rig;
  rig.home();
  rig.turns(3, {1.0, 0.0, 0.0});
  rig.session.rest();
  EXPECT_EQ(rig.felt_N().norm(), 0.0);
  EXPECT_FALSE(rig.fake.last_command().homes) << "flags 0: lamps off";
}

TEST(FalconSession, WhateverHappensTheForceHasItsLimitAndEndsWithinTwoTurnsOfAFault) {
  const int turns = testing::kAddressSanitizer ? 100'000 : 1'000'000;
  ExchangeSettings settings;
  settings.peak_force_N = 3.0;
  Rig rig(settings);
  rig.home();
  std::mt19937 random(9);
  std::uniform_real_distribution<double> number(-20.0, 20.0), share(0.0, 1.0);
  const Fault faults[] = {Fault::NoReply,       Fault::StatusOnly, Fault::Split,        Fault::TwoAtOnce,
                          Fault::GarbageBefore, Fault::HomedDrops, Fault::EncoderLeaps, Fault::Stall};
  int since_fault = 0, pushed = 0;
  Fault fault = Fault::None;
  for (int i = 0; i < turns; ++i) {
    // An encoder that stays away is believed after 100 ms: it is where the grip might be.
    if (share(random) < 0.02 || (fault == Fault::EncoderLeaps && since_fault > 150)) {
      fault = fault != Fault::None ? Fault::None : faults[random() % std::size(faults)];
      rig.fake.set(fault);
      since_fault = 0;
    }
    const double angle = 1e-3 * i;
    rig.fake.hold(kMiddle_m + 0.02 * Vec3(std::sin(angle), std::sin(1.3 * angle), std::sin(0.7 * angle)));
    Vec3 wanted_N(number(random), number(random), number(random));
    if (share(random) < 0.01) wanted_N[0] = std::numeric_limits<double>::infinity();
    rig.turns(1, wanted_N);
    ++since_fault;
    if (fault == Fault::Stall) continue;  // it takes no command: what its motors do then is the firmware's
    ASSERT_LE(rig.felt_N().norm(), settings.peak_force_N * 1.02)
        << "turn " << i << ", fault " << static_cast<int>(fault) << " for "
        << since_fault;  // between two counts of an encoder
    if (rig.felt_N().norm() > 0.0) ++pushed;
    const bool lost = fault == Fault::HomedDrops || fault == Fault::NoReply || fault == Fault::StatusOnly;
    const int within = fault == Fault::HomedDrops ? 2 : 8;  // silence is known after 30 ms
    if (lost && since_fault > within) {
      ASSERT_EQ(rig.felt_N().norm(), 0.0) << "turn " << i;
    }
  }
  EXPECT_GT(pushed, turns / 4);
}

TEST(FalconSession, ATurnAllocatesNothing) {
  Rig rig;
  rig.home();
  struct Silent : Transport {  // the fake's own queues allocate
    bool request(std::uint8_t, std::uint16_t) noexcept override { return true; }
    bool send(std::span<const std::uint8_t>) noexcept override { return true; }
    std::size_t receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds) noexcept override {
      std::copy(report.begin(), report.end(), bytes.begin() + 2);
      return 2 + report.size();
    }
    bool is_gone() const noexcept override { return false; }
    Packet report = encode(Report{{-200, -200, -200}, {true, true, true}, 0});
  } transport;
  Session session(transport, {}, FakeFalcon::clock, &rig.fake);
  const support::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) session.exchange_once({{1.0, 0.0, 0.0}, rig.fake.now_ns()});
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(session.exchange().phase(rig.fake.now_ns()), DevicePhase::Ready);
}

}  // namespace
}  // namespace myotact::device::falcon
