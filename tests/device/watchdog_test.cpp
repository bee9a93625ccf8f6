// A program that pushes the hand dies or hangs in every way there is: the motor's force, in memory that outlives it, is
// gone within 100 ms, and no watchdog stays behind.

#include "realtime/watchdog.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "device/shared_motor.h"
#include "device/simulated_device.h"
#include "realtime/periodic_loop.h"

namespace myotact::device {
namespace {

constexpr std::uint64_t kMillisecond_ns = 1'000'000;
constexpr std::uint64_t kAllowed_ns = 100 * kMillisecond_ns;
constexpr std::uint64_t kPatience_ns = 5'000 * kMillisecond_ns;

struct Shared {
  std::atomic<int> watchdog{0};      // its process
  std::atomic<bool> crashes{false};  // the program shall abort by itself
  std::atomic<std::uint64_t> ticks{0};
};

/// The program: watchdog, device and a loop of 1 kHz that pushes with 2 N.
[[noreturn]] void push(SharedMotor& motor, realtime::SharedPage<Shared>& shared) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  realtime::Watchdog watchdog(motor);
  shared->watchdog = watchdog.process();
  SimulatedDevice device("simulated", Vec3::Zero());
  device.drive(motor);
  realtime::PeriodicLoop beat(kMillisecond_ns);
  beat.start();
  bool cut = false;
  while (true) {
    beat.wait();
    device.read(realtime::steady_now_ns());
    cut = watchdog.tripped() || cut;
    device.write({{0.0, 0.0, cut ? 0.0 : 2.0}});
    watchdog.beat();
    ++shared->ticks;
    if (shared->crashes) std::abort();
  }
}

template <class Condition>
bool wait_until(Condition&& condition, std::uint64_t* took_ns = nullptr) {
  const std::uint64_t start_ns = realtime::steady_now_ns();
  while (!condition()) {
    if (realtime::steady_now_ns() - start_ns > kPatience_ns) return false;
    ::usleep(200);
  }
  if (took_ns != nullptr) *took_ns = realtime::steady_now_ns() - start_ns;
  return true;
}

/// Neither running nor, where nobody collects it, more than a name.
bool is_gone(int process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  if (!std::getline(stat, line)) return true;
  return line.find(") Z") != std::string::npos;
}

class Program {
 public:
  Program() : process_(::fork()) {
    if (process_ == 0) push(motor, shared);
  }
  ~Program() {
    if (process_ > 0) end(SIGKILL);
  }
  bool pushes() {
    return wait_until([&] { return motor.force_world_N().z() > 1.0; });
  }
  void signal(int number) { ::kill(process_, number); }
  void end(int number) {
    signal(number);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

  SharedMotor motor;
  realtime::SharedPage<Shared> shared;

 private:
  pid_t process_;
};

void expect_zero_soon(Program& program, const char* what) {
  std::uint64_t took_ns = 0;
  ASSERT_TRUE(wait_until([&] { return program.motor.force_world_N().norm() == 0.0; }, &took_ns)) << what;
  std::printf("%s: zero force after %.1f ms\n", what, 1e-6 * static_cast<double>(took_ns));
  EXPECT_LT(took_ns, kAllowed_ns) << what;
}

TEST(Watchdog, AProgramThatIsKilledOrCrashesLeavesNoForce) {
  for (const auto& [number, name] : {std::pair{SIGKILL, "SIGKILL"}, {SIGSEGV, "SIGSEGV"}, {SIGBUS, "SIGBUS"}}) {
    Program program;
    ASSERT_TRUE(program.pushes());
    const int watchdog = program.shared->watchdog;
    ASSERT_GT(watchdog, 0);
    program.signal(number);
    expect_zero_soon(program, name);
    program.end(SIGKILL);
    EXPECT_TRUE(wait_until([&] { return is_gone(watchdog); })) << "the watchdog stayed behind";
  }
}

TEST(Watchdog, AProgramThatAbortsLeavesNoForce) {
  Program program;
  ASSERT_TRUE(program.pushes());
  program.shared->crashes = true;
  expect_zero_soon(program, "abort()");
}

TEST(Watchdog, AProgramThatHangsIsCutAndGoesOnFromZero) {
  Program program;
  ASSERT_TRUE(program.pushes());
  program.signal(SIGSTOP);
  expect_zero_soon(program, "SIGSTOP");
  EXPECT_FALSE(is_gone(program.shared->watchdog));
  const std::uint64_t ticks = program.shared->ticks;
  program.signal(SIGCONT);
  ASSERT_TRUE(wait_until([&] { return program.shared->ticks > ticks + 50; }));
  EXPECT_EQ(program.motor.force_world_N().norm(), 0.0);  // the program was told
}

TEST(Watchdog, NeitherCtrlCNorAnEndOfTheTerminalReachesIt) {
  Program program;
  ASSERT_TRUE(program.pushes());
  const int watchdog = program.shared->watchdog;
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) ::kill(watchdog, number);
  ::usleep(50'000);
  EXPECT_FALSE(is_gone(watchdog));
  EXPECT_NE(::getsid(watchdog), ::getsid(0));
  program.signal(SIGKILL);
  expect_zero_soon(program, "SIGKILL after the rest");
}

TEST(Watchdog, EndsWithItsOwnerAndCutsOnceMore) {
  SharedMotor motor;
  int process = 0;
  {
    realtime::Watchdog watchdog(motor);
    process = watchdog.process();
    motor.set_force(Vec3(1, 2, 3));
    ::usleep(120'000);  // no beat yet: silence is no fault
    EXPECT_EQ(motor.force_world_N().x(), 1.0);
    watchdog.beat();
    ASSERT_TRUE(wait_until([&] { return watchdog.tripped(); }));
    EXPECT_EQ(motor.force_world_N().norm(), 0.0);
    watchdog.beat();
    watchdog.rest();
    motor.set_force(Vec3(1, 2, 3));
    ::usleep(120'000);
    EXPECT_EQ(motor.force_world_N().x(), 1.0);
  }
  EXPECT_EQ(motor.force_world_N().norm(), 0.0);
  EXPECT_TRUE(is_gone(process));
}

TEST(Watchdog, CutsTheMotorsOfBothHands) {
  MotorGroup motors;
  realtime::Watchdog watchdog(motors);
  motors[0].set_force(Vec3(1, 0, 0));
  motors[1].set_force(Vec3(0, 2, 0));
  watchdog.beat();
  ASSERT_TRUE(wait_until([&] { return watchdog.tripped(); }));
  EXPECT_EQ(motors[0].force_world_N().norm() + motors[1].force_world_N().norm(), 0.0);
}

}  // namespace
}  // namespace myotact::device
