#include "device/drivers/force_dimension/force_dimension_device.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "device/drivers/force_dimension/models.h"
#include "realtime/periodic_loop.h"

namespace myotact::device::force_dimension {

namespace {

constexpr std::uint64_t kExchange_ns = 500'000;       // twice a tick: no force waits longer than that
constexpr std::uint64_t kGivenUp_ns = 2'000'000'000;  // of a device that answers with errors alone
constexpr std::uint64_t kExchangesBetweenLooks = 20;  // at the status: a hundredth of a second
constexpr int kMostRefused = 4;                       // two milliseconds of forces that were not taken

}  // namespace

ForceDimensionDevice::ForceDimensionDevice(std::string name, int number, const ForceDimensionSettings& settings,
                                           std::shared_ptr<DhdLibrary> library)
    : ExchangingDevice(std::move(name), "force_dimension"),
      number_(number),
      settings_(settings),
      library_(std::move(library)),
      profile_(profile_of(model_of(0), 0.0)) {}

bool ForceDimensionDevice::open_on_library() noexcept {
  const int opened = api().open_device(number_);
  if (opened < 0) return false;
  id_ = static_cast<char>(opened);
  is_held_ = true;
  return true;
}

ForceDimensionDevice::Identity ForceDimensionDevice::identity() const noexcept {
  unsigned short serial = 0;
  const bool has_serial = api().serial_number(&serial, id_) >= 0;
  return {api().system_type(id_), has_serial ? serial : -1};
}

/// It moves by itself. That it failed shows in the status.
void ForceDimensionDevice::initialise() const noexcept {
  if (!settings_.initialises_itself || !api().has_drd() || api().is_initialised(id_)) return;
  api().initialise(id_);
  api().drd_stop(true, id_);  // or DRD would hold the grip where it left it
}

/// Ready to be felt, from no force: where it does not take that, its motors stay off.
void ForceDimensionDevice::prepare() const noexcept {
  api().set_gravity_compensation(settings_.gravity_compensation ? 1 : 0, id_);
  api().set_brakes(0, id_);
  if (api().emulate_button != nullptr) api().emulate_button(1, id_);
  if (api().set_force(0.0, 0.0, 0.0, id_) >= 0) api().enable_force(1, id_);
}

/// Brakes, where it has them, slow the grip's fall once nothing carries it.
void ForceDimensionDevice::close_on_library() noexcept {
  if (!std::exchange(is_held_, false)) return;
  api().set_force(0.0, 0.0, 0.0, id_);
  api().enable_force(0, id_);
  api().set_brakes(1, id_);
  api().close_device(id_);
}

void ForceDimensionDevice::connect() {
  std::atomic<bool>& is_open = library_->is_open[static_cast<std::size_t>(number_)];
  if (is_open.exchange(true)) throw Error(ExitStatus::Unavailable, name() + ": this program has it open already");
  if (!open_on_library()) {
    is_open = false;
    throw Error(ExitStatus::Unavailable,
                fmt::format("{}: it does not open: {}; end other programs that use it, see to its cable and its power, "
                            "and let this computer's user open it by assets/devices/udev/70-myotact.rules",
                            name(), api().error_text()));
  }
  identity_ = identity();
  profile_ = profile_of(model_of(identity_.type), api().max_force(id_));
  initialise();
  prepare();
}

void ForceDimensionDevice::disconnect() noexcept {
  close_on_library();
  library_->is_open[static_cast<std::size_t>(number_)] = false;
  hint_ = "";
}

void ForceDimensionDevice::leave_gone() noexcept {
  close_on_library();
  hint_ = "The device does not answer: see to its cable and its power.";
}

/// The same device; another one at its place is left alone.
bool ForceDimensionDevice::reopen() noexcept {
  if (!open_on_library()) return false;
  if (identity() == identity_) {
    prepare();
    return true;
  }
  api().close_device(id_);
  is_held_ = false;
  return false;
}

void ForceDimensionDevice::exchange_until_gone() noexcept {
  Exchange exchange(profile_.peak_force_N);
  realtime::PeriodicLoop beat(kExchange_ns);
  beat.start();
  const std::uint64_t begun_ns = realtime::steady_now_ns();
  ExchangeRate rate(begun_ns);
  std::uint64_t exchanges = 0;
  int refused = 0;      // forces in a row that it did not take
  bool pushes = false;  // by the last one that it took
  while (!stopping()) {
    beat.wait();
    const bool looks = exchanges++ % kExchangesBetweenLooks == 0;
    if (looks) exchange.take(read_status());
    const RawState state = read_state();
    const std::uint64_t now_ns = realtime::steady_now_ns();
    exchange.take(state, now_ns);
    const Vec3 force_N = exchange.allowed(wanted(), now_ns);
    const int sent = api().set_force(force_N.x(), force_N.y(), force_N.z(), id_);  // zeros, too: they carry its weight
    refused = sent < 0 ? refused + 1 : 0;
    if (refused == 0) pushes = force_N != Vec3::Zero();
    if (refused > 0) exchange.distrust(now_ns);
    if (refused > kMostRefused && pushes) return;  // its motors may keep that: they are switched off
    if (looks && exchange.may_enable(now_ns)) api().enable_force(1, id_);
    publish(exchange.state(), exchange.phase());
    hint_ = exchange.hint();
    if (now_ns - std::max(exchange.heard_ns(), begun_ns) > kGivenUp_ns) return;
    if (rate.count(exchanges, now_ns)) set_rate(rate.rate_Hz());
  }
}

RawState ForceDimensionDevice::read_state() const noexcept {
  RawState state;
  Vec3& p = state.position_m;
  Vec3& v = state.velocity_m_s;
  const int position = api().get_position(&p.x(), &p.y(), &p.z(), id_);
  const int velocity = api().get_velocity(&v.x(), &v.y(), &v.z(), id_);
  state.result = std::min(position, velocity);
  state.buttons = api().button_mask(id_);
  return state;
}

RawStatus ForceDimensionDevice::read_status() const noexcept {
  std::array<int, kStatusLength> raw{};
  if (api().get_status(raw.data(), id_) < 0) return {.is_connected = false};
  const bool is_initialised = api().has_drd() ? api().is_initialised(id_) : raw[kInitialised] != 0;
  return {raw[kPower] != 0, raw[kConnected] != 0, is_initialised, raw[kForceIsOn] != 0, raw[kForceOffCause]};
}

}  // namespace myotact::device::force_dimension
