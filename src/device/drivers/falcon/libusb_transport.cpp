#include "device/drivers/falcon/libusb_transport.h"

#include <algorithm>
#include <new>
#include <utility>

#include "device/drivers/falcon/packet.h"

namespace myotact::device::falcon {

namespace {

// The chip's endpoints, and how a vendor's request to it is marked. Source: libnifalcon (BSD).
constexpr unsigned char kInEndpoint = 0x81, kOutEndpoint = 0x02;
constexpr std::uint8_t kVendorRequest = LIBUSB_REQUEST_TYPE_VENDOR;  // to the device, without data: 0x40
constexpr unsigned kRequestTimeout_ms = 1000;                        // as libnifalcon

/// A command to the motors that the device did not take by then is old: it is taken back, and never pushes late.
constexpr unsigned kCommandTimeout_ms = 15;
constexpr unsigned kBlockTimeout_ms = 50;  // for more bytes, a block of the firmware: ten times its time on the wire
constexpr auto kSendPatience = std::chrono::milliseconds(20);  // for one of the four sendings to land
constexpr auto kLastSendPatience = std::chrono::milliseconds(100);
constexpr auto kTakeBackPatience = std::chrono::seconds(1);
constexpr auto kStallPatience = std::chrono::milliseconds(100);  // for the kernel to give back what it queued

}  // namespace

LibusbTransport::LibusbTransport(UsbContext context, UsbHandle handle)
    : context_(std::move(context)), handle_(std::move(handle)) {
  const auto prepare = [this](Flight& flight, unsigned char endpoint, unsigned timeout_ms) {
    flight.owner = this;
    flight.transfer = libusb_alloc_transfer(0);
    if (flight.transfer == nullptr) throw std::bad_alloc();
    libusb_fill_bulk_transfer(flight.transfer, handle_.get(), endpoint, flight.bytes.data(),
                              static_cast<int>(flight.bytes.size()), landed, &flight, timeout_ms);
  };
  for (Flight& flight : receipts_) prepare(flight, kInEndpoint, 0);
  for (Flight& flight : sendings_) prepare(flight, kOutEndpoint, kBlockTimeout_ms);
  queue_receipts();
}

LibusbTransport::~LibusbTransport() {
  const auto until = Clock::now() + kLastSendPatience;
  while (any_flies(sendings_) && !is_gone_ && Clock::now() < until) handle_events(until);
  is_closing_ = true;
  const auto back = [](Flight& flight) {
    if (flight.flies) libusb_cancel_transfer(flight.transfer);
  };
  std::for_each(receipts_.begin(), receipts_.end(), back);
  std::for_each(sendings_.begin(), sendings_.end(), back);
  const auto end = Clock::now() + kTakeBackPatience;
  while ((any_flies(receipts_) || any_flies(sendings_)) && Clock::now() < end) handle_events(end);
  libusb_release_interface(handle_.get(), kUsbInterface);
  handle_.reset();  // what still flies is libusb's no more
  for (const Flight& flight : receipts_) libusb_free_transfer(flight.transfer);
  for (const Flight& flight : sendings_) libusb_free_transfer(flight.transfer);
}

void LIBUSB_CALL LibusbTransport::landed(libusb_transfer* transfer) {
  auto& flight = *static_cast<Flight*>(transfer->user_data);
  flight.owner->land(flight);
}

void LibusbTransport::land(Flight& flight) noexcept {
  flight.flies = false;
  const bool is_receipt = flight.transfer->endpoint == kInEndpoint;
  switch (flight.transfer->status) {
    case LIBUSB_TRANSFER_COMPLETED:
      if (!is_receipt) return;
      keep(flight);
      if (!is_closing_ && !in_is_stalled_) fly(flight);
      return;
    case LIBUSB_TRANSFER_NO_DEVICE:
      is_gone_ = true;
      return;
    case LIBUSB_TRANSFER_STALL:
      (is_receipt ? in_is_stalled_ : out_is_stalled_) = true;
      return;
    default:  // taken back, timed out or broken on the wire: the next call queues it again
      return;
  }
}

void LibusbTransport::keep(const Flight& flight) noexcept {
  if (count_ == arrivals_.size()) {
    first_ = (first_ + 1) % arrivals_.size();
    --count_;
  }
  Arrival& arrival = arrivals_[(first_ + count_++) % arrivals_.size()];
  arrival.bytes = flight.bytes;
  arrival.count = static_cast<std::size_t>(flight.transfer->actual_length);
}

bool LibusbTransport::fly(Flight& flight) noexcept {
  const int code = libusb_submit_transfer(flight.transfer);
  flight.flies = code == LIBUSB_SUCCESS;
  is_gone_ = is_gone_ || code == LIBUSB_ERROR_NO_DEVICE;
  return flight.flies;
}

void LibusbTransport::queue_receipts() noexcept {
  for (Flight& flight : receipts_)
    if (!flight.flies && !is_gone_) fly(flight);
}

void LibusbTransport::take_back(Flights& flights) noexcept {
  for (Flight& flight : flights)
    if (flight.flies) libusb_cancel_transfer(flight.transfer);
  const auto until = Clock::now() + kStallPatience;
  while (any_flies(flights) && Clock::now() < until) handle_events(until);
}

/// An endpoint that stalled takes nothing more until its halt is cleared, which the kernel requires while nothing is
/// queued on it.
void LibusbTransport::clear_stalls() noexcept {
  const auto clear = [this](bool& is_stalled, unsigned char endpoint, Flights& flights) {
    if (!is_stalled) return;
    take_back(flights);
    const int code = libusb_clear_halt(handle_.get(), endpoint);
    is_gone_ = is_gone_ || code == LIBUSB_ERROR_NO_DEVICE;
    is_stalled = code != LIBUSB_SUCCESS;
  };
  clear(in_is_stalled_, kInEndpoint, receipts_);
  clear(out_is_stalled_, kOutEndpoint, sendings_);
}

void LibusbTransport::handle_events(Clock::time_point until) noexcept {
  using std::chrono::microseconds;
  const auto left = std::chrono::duration_cast<microseconds>(until - Clock::now());
  const auto wait = std::clamp(left, microseconds(0), microseconds(999'999));
  timeval most{0, static_cast<suseconds_t>(wait.count())};
  libusb_handle_events_timeout_completed(context_.get(), &most, nullptr);
}

bool LibusbTransport::any_flies(const Flights& flights) noexcept {
  return std::any_of(flights.begin(), flights.end(), [](const Flight& flight) { return flight.flies; });
}

bool LibusbTransport::request(std::uint8_t number, std::uint16_t value) noexcept {
  if (is_gone_) return false;
  const int code =
      libusb_control_transfer(handle_.get(), kVendorRequest, number, value, 0, nullptr, 0, kRequestTimeout_ms);
  is_gone_ = is_gone_ || code == LIBUSB_ERROR_NO_DEVICE;
  return code >= 0;
}

LibusbTransport::Flight* LibusbTransport::idle_sending(Clock::time_point until) noexcept {
  for (;;) {
    const auto idle = std::find_if(sendings_.begin(), sendings_.end(), [](const Flight& f) { return !f.flies; });
    if (idle != sendings_.end()) return &*idle;
    if (is_gone_ || Clock::now() >= until) return nullptr;
    handle_events(until);
  }
}

bool LibusbTransport::send(std::span<const std::uint8_t> bytes) noexcept {
  if (is_gone_ || bytes.size() > kTransferBytes) return false;
  clear_stalls();
  Flight* flight = idle_sending(Clock::now() + kSendPatience);
  if (flight == nullptr) return false;
  std::copy(bytes.begin(), bytes.end(), flight->bytes.begin());
  flight->transfer->length = static_cast<int>(bytes.size());
  flight->transfer->timeout = bytes.size() <= kPacketBytes ? kCommandTimeout_ms : kBlockTimeout_ms;
  return fly(*flight);
}

std::size_t LibusbTransport::receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept {
  const auto until = Clock::now() + patience;
  clear_stalls();
  queue_receipts();
  while (count_ == 0 && !is_gone_ && Clock::now() < until) handle_events(until);
  if (count_ == 0) return 0;
  const Arrival& arrival = arrivals_[first_];
  const std::size_t count = std::min(arrival.count, bytes.size());
  std::copy_n(arrival.bytes.begin(), count, bytes.begin());
  first_ = (first_ + 1) % arrivals_.size();
  --count_;
  return count;
}

}  // namespace myotact::device::falcon
