#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include <libusb.h>

#include "device/drivers/falcon/transport.h"

namespace myotact::device::falcon {

struct UsbContextEnd {
  void operator()(libusb_context* context) const noexcept { libusb_exit(context); }
};
struct UsbHandleEnd {
  void operator()(libusb_device_handle* handle) const noexcept { libusb_close(handle); }
};
using UsbContext = std::unique_ptr<libusb_context, UsbContextEnd>;
using UsbHandle = std::unique_ptr<libusb_device_handle, UsbHandleEnd>;

inline constexpr int kUsbInterface = 0;  // the only one of the Falcon

/// The transfers of one Falcon by libusb. IN transfers are always queued with the kernel, so that a reply is taken up
/// in the frame of the bus in which the chip has it; nothing here waits for one before it asks for the next. The thread
/// that calls handles libusb's events, too, while it waits: no hand-over to another thread lies between reply and
/// command.
class LibusbTransport : public Transport {
 public:
  /// Of a handle whose interface is claimed. Throws std::bad_alloc.
  LibusbTransport(UsbContext context, UsbHandle handle);
  /// Waits up to a tenth of a second for what was sent, so that a last command arrives; then takes back what is queued.
  ~LibusbTransport() override;
  LibusbTransport(const LibusbTransport&) = delete;
  LibusbTransport& operator=(const LibusbTransport&) = delete;

  bool request(std::uint8_t number, std::uint16_t value) noexcept override;
  bool send(std::span<const std::uint8_t> bytes) noexcept override;
  std::size_t receive(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) noexcept override;
  bool is_gone() const noexcept override { return is_gone_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// A transfer and its bytes. The kernel has both while it flies.
  struct Flight {
    LibusbTransport* owner = nullptr;
    libusb_transfer* transfer = nullptr;
    std::array<std::uint8_t, kTransferBytes> bytes{};
    bool flies = false;
  };
  using Flights = std::array<Flight, 4>;
  /// What came in and was not yet asked for.
  struct Arrival {
    std::array<std::uint8_t, kTransferBytes> bytes{};
    std::size_t count = 0;
  };

  static void LIBUSB_CALL landed(libusb_transfer* transfer);
  void land(Flight& flight) noexcept;
  void keep(const Flight& flight) noexcept;
  bool fly(Flight& flight) noexcept;
  void queue_receipts() noexcept;
  void clear_stalls() noexcept;
  Flight* idle_sending(Clock::time_point until) noexcept;
  void handle_events(Clock::time_point until) noexcept;
  void take_back(Flights& flights) noexcept;
  static bool any_flies(const Flights& flights) noexcept;

  UsbContext context_;
  UsbHandle handle_;
  Flights receipts_, sendings_;
  std::array<Arrival, 16> arrivals_;  // four times what is queued: who is slower wants the newest anyway
  std::size_t first_ = 0, count_ = 0;
  bool is_gone_ = false, is_closing_ = false;
  bool in_is_stalled_ = false, out_is_stalled_ = false;
};

}  // namespace myotact::device::falcon
