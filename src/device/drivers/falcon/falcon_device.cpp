#include "device/drivers/falcon/falcon_device.h"

#include <utility>
#include <vector>

#include "core/error.h"
#include "device/drivers/falcon/firmware.h"
#include "device/drivers/falcon/session.h"
#include "realtime/periodic_loop.h"

namespace myotact::device::falcon {

namespace {

/// The chip answers and the processor behind it does not: it lost its power, and its firmware with it.
constexpr std::uint64_t kGivenUp_ns = 2'000'000'000;

std::uint64_t steady(void*) {
  return realtime::steady_now_ns();
}

/// As assets/devices/falcon.json, whose sources hold here, too.
DeviceProfile falcon_profile(double peak_force_N) {
  DeviceProfile profile;
  profile.peak_force_N = peak_force_N;
  profile.continuous_force_N = 0.5 * peak_force_N;
  profile.max_stiffness_N_m = 3000.0;
  profile.inertia_kg = 0.2;
  profile.viscous_Ns_m = 0.4;
  profile.coulomb_N = 0.3;
  profile.resolution_m = 4.3e-5;
  profile.delay_ticks = 1;
  profile.workspace_m = {0.08, 0.08, 0.08};
  return profile;
}

/// A transport that is gone as soon as its user wants to stop: what waits for an answer, the start of a firmware above
/// all, ends at once.
class Stoppable : public Transport {
 public:
  Stoppable(std::unique_ptr<Transport> inner, const std::atomic<bool>& stopping)
      : inner_(std::move(inner)), stopping_(stopping) {}

  bool request(std::uint8_t number, std::uint16_t value) noexcept override { return inner_->request(number, value); }
  bool send(std::span<const std::uint8_t> bytes) noexcept override { return inner_->send(bytes); }
  std::size_t receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept override {
    return inner_->receive(bytes, patience);
  }
  bool is_gone() const noexcept override { return stopping_ || inner_->is_gone(); }

 private:
  std::unique_ptr<Transport> inner_;
  const std::atomic<bool>& stopping_;
};

}  // namespace

FalconDevice::FalconDevice(std::string name, const FalconSettings& settings, OpenTransport open_transport)
    : ExchangingDevice(std::move(name), "falcon"),
      settings_(settings),
      open_transport_(std::move(open_transport)),
      profile_(falcon_profile(settings.exchange.peak_force_N)) {}

std::unique_ptr<Transport> FalconDevice::start_transport() const {
  auto transport = std::make_unique<Stoppable>(open_transport_(), stopping());
  const std::vector<std::uint8_t> image =
      settings_.firmware.empty() ? std::vector<std::uint8_t>{} : read_firmware(settings_.firmware);
  start_firmware(*transport, image);
  return transport;
}

bool FalconDevice::reopen() noexcept {
  transport_.reset();  // first: a device that is held cannot be taken
  try {
    transport_ = start_transport();
    return true;
  } catch (const std::exception&) {  // not yet there again: the phase says so
    return false;
  }
}

void FalconDevice::exchange_until_gone() noexcept {
  Session session(*transport_, settings_.exchange, steady, nullptr);
  ExchangeRate rate(session.now_ns());
  std::uint64_t heard_ns = session.now_ns(), heard = 0;
  while (!stopping() && !transport_->is_gone()) {
    session.exchange_once(wanted());
    const Exchange& exchange = session.exchange();
    const std::uint64_t now_ns = session.now_ns();
    publish({to_array(exchange.position_m()), to_array(exchange.velocity_m_s()), exchange.reported_ns(),
             stylus_buttons(exchange.buttons())},
            exchange.phase(now_ns));
    if (session.reports() != heard) {
      heard = session.reports();
      heard_ns = now_ns;
    }
    if (now_ns - heard_ns > kGivenUp_ns) break;
    if (rate.count(session.reports(), now_ns)) set_rate(rate.rate_Hz());
  }
  session.rest();
}

DeviceReport FalconDevice::report() const noexcept {
  DeviceReport report;
  report.phase = phase();
  report.rate_Hz = rate_Hz();
  if (report.phase == DevicePhase::NeedsCalibration)
    report.hint = "Pull the grip all the way out, then push it all the way in.";
  if (report.phase == DevicePhase::Lost) report.hint = "Plug the Falcon in again, with its power.";
  return report;
}

}  // namespace myotact::device::falcon
