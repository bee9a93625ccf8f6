#include "usbip_falcon.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace myotact::device::falcon {

namespace {

// The kernel's Documentation/usb/usbip_protocol.rst: headers of 48 bytes, numbers big-endian.
constexpr std::uint32_t kSubmit = 1, kUnlink = 2, kSubmitted = 3, kUnlinked = 4;
constexpr std::size_t kSequence = 4, kDirection = 12, kEndpoint = 16, kLength = 24, kSetup = 40, kUnlinkSequence = 20;
constexpr std::uint32_t kIn = 1;
constexpr const char* kAttach = "/sys/devices/platform/vhci_hcd.0/attach";
constexpr const char* kDetach = "/sys/devices/platform/vhci_hcd.0/detach";
constexpr int kDeviceId = 0x10002, kFullSpeed = 2;
constexpr std::uint8_t kGetDescriptor = 6, kLatencyTimer = 9;

const std::vector<std::uint8_t> kDevice = {0x12, 0x01, 0x00, 0x02, 0x00, 0x00, 0x00, 0x08, 0x03,
                                           0x04, 0x48, 0xCB, 0x00, 0x04, 0x00, 0x00, 0x00, 0x01};
const std::vector<std::uint8_t> kConfiguration = {0x09, 0x02, 0x20, 0x00, 0x01, 0x01, 0x00, 0x80, 0x2D, 0x09, 0x04,
                                                  0x00, 0x00, 0x02, 0xFF, 0xFF, 0xFF, 0x00, 0x07, 0x05, 0x81, 0x02,
                                                  0x40, 0x00, 0x00, 0x07, 0x05, 0x02, 0x02, 0x40, 0x00, 0x00};

std::uint32_t number_at(std::span<const std::uint8_t> bytes, std::size_t place) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | bytes[place + i];
  return value;
}

void put_number(std::span<std::uint8_t> bytes, std::size_t place, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[place + i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

std::uint32_t negative(int error) {
  return static_cast<std::uint32_t>(-error);
}

void tell(const char* file, const std::string& text) {
  std::ofstream out(file);
  out << text << std::flush;
  if (!out) throw std::runtime_error(std::string(file) + ": cannot write: " + std::strerror(errno));
}

}  // namespace

UsbipFalcon::UsbipFalcon() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) throw std::runtime_error("no socket pair");
  ours_ = ends[0];
  kernels_ = ends[1];
  thread_ = std::thread([this] { run(); });
  tell(kAttach, "0 " + std::to_string(kernels_) + " " + std::to_string(kDeviceId) + " " + std::to_string(kFullSpeed));
}

UsbipFalcon::~UsbipFalcon() {
  unplug();
}

void UsbipFalcon::unplug() {
  if (ours_ < 0) return;
  try {
    tell(kDetach, "0");
  } catch (const std::runtime_error&) {  // gone already
  }
  stopping_ = true;
  thread_.join();
  ::close(ours_);
  ::close(kernels_);
  ours_ = kernels_ = -1;
}

void UsbipFalcon::run() {
  while (!stopping_) {
    pollfd waiting{ours_, POLLIN, 0};
    ::poll(&waiting, 1, 1);
    if ((waiting.revents & POLLIN) != 0 && !take_request()) return;
    give_receipts();
  }
}

bool UsbipFalcon::read_all(std::span<std::uint8_t> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::read(ours_, bytes.data(), bytes.size());
    if (got <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool UsbipFalcon::take_request() {
  Header header{};
  if (!read_all(header)) return false;
  if (number_at(header, 0) == kUnlink) {
    unlink(header);
    return true;
  }
  std::vector<std::uint8_t> sent;
  if (number_at(header, kDirection) != kIn) sent.resize(number_at(header, kLength));
  if (!read_all(sent)) return false;
  submit(header, sent);
  return true;
}

void UsbipFalcon::submit(const Header& header, const std::vector<std::uint8_t>& sent) {
  const std::uint32_t sequence = number_at(header, kSequence), length = number_at(header, kLength);
  if (number_at(header, kEndpoint) == 0) {
    std::uint32_t status = 0;
    const std::vector<std::uint8_t> data = control(header, status);
    const std::size_t count = std::min<std::size_t>(data.size(), length);
    return answer(sequence, status, {data.data(), count}, static_cast<std::uint32_t>(count));
  }
  if (number_at(header, kDirection) == kIn) return receipts_.push_back({sequence, length});
  const bool taken = with([&](FakeFalcon& fake) { return fake.send(sent); });
  answer(sequence, taken ? 0 : negative(EPIPE), {}, taken ? length : 0);
}

/// Descriptors, the kernel's housekeeping, and the serial chip's requests.
std::vector<std::uint8_t> UsbipFalcon::control(const Header& header, std::uint32_t& status) {
  const std::uint8_t type = header[kSetup], request = header[kSetup + 1];
  const auto value = static_cast<std::uint16_t>(header[kSetup + 2] | header[kSetup + 3] << 8);
  if (type == 0x80 && request == kGetDescriptor) {
    if (value >> 8 == 1) return kDevice;
    if (value >> 8 == 2) return kConfiguration;
    status = negative(EPIPE);
    return {};
  }
  if (type != 0x40) return {0, 0};
  if (request == kLatencyTimer) latency_ = std::chrono::milliseconds(value);
  with([&](FakeFalcon& fake) { return fake.request(request, value); });
  return {};
}

void UsbipFalcon::unlink(const Header& header) {
  const std::uint32_t wanted = number_at(header, kUnlinkSequence);
  const auto is_it = [wanted](const Receipt& receipt) { return receipt.sequence == wanted; };
  const bool was_there = std::erase_if(receipts_, is_it) > 0;
  Header answer{};
  put_number(answer, 0, kUnlinked);
  put_number(answer, 4, number_at(header, kSequence));
  put_number(answer, 20, was_there ? negative(ECONNRESET) : 0);
  say(answer);
}

/// What the device has to say, or the chip's status alone once a latency.
void UsbipFalcon::give_receipts() {
  constexpr std::array<std::uint8_t, kStatusBytes> kStatus = {0x01, 0x60};
  while (!receipts_.empty()) {
    std::array<std::uint8_t, kTransferBytes> bytes{};
    std::size_t count = with([&](FakeFalcon& fake) { return fake.receive(bytes, std::chrono::milliseconds(0)); });
    const auto now = std::chrono::steady_clock::now();
    if (count == 0) {
      if (now - last_receipt_ < latency_) return;
      std::copy(kStatus.begin(), kStatus.end(), bytes.begin());
      count = kStatus.size();
    }
    last_receipt_ = now;
    const Receipt receipt = receipts_.front();
    receipts_.pop_front();
    count = std::min<std::size_t>(count, receipt.length);
    answer(receipt.sequence, 0, {bytes.data(), count}, static_cast<std::uint32_t>(count));
  }
}

void UsbipFalcon::answer(std::uint32_t sequence, std::uint32_t status, std::span<const std::uint8_t> data,
                         std::uint32_t length) {
  std::vector<std::uint8_t> bytes(kHeaderBytes, 0);
  put_number(bytes, 0, kSubmitted);
  put_number(bytes, 4, sequence);
  put_number(bytes, 20, status);
  put_number(bytes, 24, length);
  bytes.insert(bytes.end(), data.begin(), data.end());
  say(bytes);
}

/// A kernel that has detached the device meanwhile hears nothing, and that is no fault.
void UsbipFalcon::say(std::span<const std::uint8_t> bytes) {
  [[maybe_unused]] const ssize_t sent = ::send(ours_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

}  // namespace myotact::device::falcon
