#include "device/drivers/falcon/firmware.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "device/drivers/falcon/packet.h"

namespace myotact::device::falcon {

namespace {

// Requests to the serial chip (FTDI) and their values, as libnifalcon sends them.
enum : std::uint8_t { kReset = 0, kModem = 1, kFlow = 2, kBaud = 3, kFormat = 4, kLatency = 9 };
constexpr std::uint16_t kPurgeOne = 1, kPurgeTwo = 2;  // both buffers; which is which differs between sources
constexpr std::uint16_t kDtrLow = 0x0100, kDtrHigh = 0x0101, kRtsLow = 0x0200;
constexpr std::uint16_t kNoFlow = 0, kEightBits = 0x0008;
constexpr std::uint16_t kBaud9600 = 0x4138, kBaud142857 = 0x0015, kBaud1500000 = 0x0002;

constexpr std::chrono::milliseconds kAnswerWithin(50);  // three of the chip's longest latencies
constexpr int kGreetings = 100, kTries = 10, kTestPackets = 100, kFirstTestPackets = 1000;
constexpr std::size_t kBlock = kTransferBytes - kStatusBytes;          // so that a block's echo fits into one transfer
constexpr std::uintmax_t kSmallestImage = 7000, kLargestImage = 9000;  // bytes; known ones have 7324 .. 8492
constexpr std::array<std::uint8_t, 2> kImageBegin = {0xaa, 0x08};      // of every known one

/// What came in, without status, appended; false: nothing came.
bool receive(Transport& transport, std::vector<std::uint8_t>& bytes) {
  std::array<std::uint8_t, kTransferBytes> transfer{};
  const std::size_t count = transport.receive(transfer, kAnswerWithin);
  if (count > kStatusBytes)
    bytes.insert(bytes.end(), transfer.begin() + kStatusBytes, transfer.begin() + static_cast<std::ptrdiff_t>(count));
  return count > 0;
}

bool purge(Transport& transport) {
  return transport.request(kReset, kPurgeOne) && transport.request(kReset, kPurgeTwo);
}

bool enter_greeting_mode(Transport& transport) {
  return purge(transport) && transport.request(kLatency, 16) && transport.request(kBaud, kBaud9600) &&
         transport.request(kFormat, kEightBits) && transport.request(kFlow, kNoFlow) &&
         transport.request(kModem, kRtsLow) && transport.request(kModem, kDtrLow) &&
         transport.request(kModem, kDtrHigh);
}

/// The processor answers a greeting; on some systems with a zero before it.
bool is_welcome(std::vector<std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 4> kWelcome = {0x0a, 0x44, 0x2c, 0x0d};
  if (!bytes.empty() && bytes.front() == 0) bytes.erase(bytes.begin());
  return std::equal(bytes.begin(), bytes.end(), kWelcome.begin(), kWelcome.end());
}

bool greet(Transport& transport) {
  constexpr std::array<std::uint8_t, 3> kGreeting = {0x0a, 0x43, 0x0d};
  for (int i = 0; i < kGreetings && !transport.is_gone(); ++i) {
    std::vector<std::uint8_t> answer;
    if (transport.send(kGreeting) && receive(transport, answer) && is_welcome(answer)) return true;
  }
  return false;
}

/// Sends a block and waits for the same bytes back, in however many transfers.
Upload echo(Transport& transport, std::span<const std::uint8_t> block) {
  if (!transport.send(block)) return Upload::Gone;
  std::vector<std::uint8_t> back;
  while (back.size() < block.size())
    if (!receive(transport, back)) return transport.is_gone() ? Upload::Gone : Upload::NoAnswer;
  return std::equal(back.begin(), back.end(), block.begin(), block.end()) ? Upload::Done : Upload::EchoDiffers;
}

std::string why(Upload last) {
  switch (last) {
    case Upload::NoAnswer:
      return "does not answer the upload of its firmware";
    case Upload::EchoDiffers:
      return "gave back other bytes than its firmware's";
    case Upload::Gone:
      return "went away while it was started";
    case Upload::Done:
      return "took its firmware and does not run it";
  }
  return "";
}

}  // namespace

std::vector<std::uint8_t> read_firmware(const std::filesystem::path& path) {
  const std::string remedy = "; name the maker's image, which comes with its driver or SDK, by falcon.firmware";
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error)
    throw Error(ExitStatus::Unavailable, path.string() + ": no firmware of the Falcon: " + error.message() + remedy);
  if (size < kSmallestImage || size > kLargestImage) {
    throw Error(ExitStatus::Unavailable, fmt::format("{}: {} bytes are no firmware of the Falcon; must be {} .. {}{}",
                                                     path.string(), size, kSmallestImage, kLargestImage, remedy));
  }
  const std::string text = read_file(path);
  std::vector<std::uint8_t> image(text.begin(), text.end());
  if (!std::equal(kImageBegin.begin(), kImageBegin.end(), image.begin())) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("{}: begins with {:02x} {:02x}; a firmware of the Falcon begins with aa 08{}",
                            path.string(), image[0], image[1], remedy));
  }
  return image;
}

bool enter_normal_mode(Transport& transport) noexcept {
  return purge(transport) && transport.request(kLatency, 1) && transport.request(kBaud, kBaud1500000) &&
         purge(transport);
}

bool firmware_runs(Transport& transport, int packets) noexcept {
  PacketReader reader;
  std::array<std::uint8_t, kTransferBytes> transfer{};
  const Packet idle = encode(Command{});
  for (int i = 0; i < packets && !transport.is_gone(); ++i) {
    if (!transport.send(idle)) return false;
    reader.take_transfer(std::span(transfer).first(transport.receive(transfer, std::chrono::milliseconds(2))));
    while (const auto packet = reader.next())
      if (decode(*packet)) return true;
  }
  return false;
}

Upload upload(Transport& transport, std::span<const std::uint8_t> image) {
  constexpr std::array<std::uint8_t, 1> kBegin = {0x41};
  if (!enter_greeting_mode(transport)) return Upload::Gone;
  if (!greet(transport)) return transport.is_gone() ? Upload::Gone : Upload::NoAnswer;
  if (!transport.request(kModem, kDtrLow) || !transport.request(kBaud, kBaud142857)) return Upload::Gone;
  Upload last = echo(transport, kBegin);
  for (std::size_t at = 0; at < image.size() && last == Upload::Done; at += kBlock)
    last = echo(transport, image.subspan(at, std::min(kBlock, image.size() - at)));
  return last;
}

void start_firmware(Transport& transport, std::span<const std::uint8_t> image) {
  if (enter_normal_mode(transport) && firmware_runs(transport, kFirstTestPackets)) return;
  if (image.empty()) {
    throw Error(
        ExitStatus::Unavailable,
        "the Falcon runs no firmware; name the maker's image, which comes with its driver or SDK, by falcon.firmware");
  }
  Upload last = Upload::NoAnswer;
  for (int i = 0; i < kTries && !transport.is_gone(); ++i) {
    last = upload(transport, image);
    if (last == Upload::Done && enter_normal_mode(transport) && firmware_runs(transport, kTestPackets)) return;
  }
  throw Error(ExitStatus::Unavailable,
              fmt::format("the Falcon {} ({} tries); unplug its power for ten seconds and plug it in again",
                          why(transport.is_gone() ? Upload::Gone : last), kTries));
}

}  // namespace myotact::device::falcon
