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

/// The chip's latency while it greets and uploads [ms]: so often it sends its status when it has nothing else, which
/// makes an empty transfer as good as a wait of that length.
constexpr std::uint16_t kLatency_ms = 16;
constexpr int kGreetingWaits = 2;  // seven bytes at 9600 baud and one latency are 23 ms
constexpr int kEchoWaits = 60;     // about a second, as libnifalcon
constexpr int kMostStale = 32;     // transfers that may lie in the buffers after many greetings
/// libnifalcon greets up to 100 times a try; ten tries of 30 end within ten seconds where nothing answers.
constexpr int kGreetings = 30, kTries = 10, kTestPackets = 100, kFirstTestPackets = 1000;
constexpr std::size_t kBlock = kTransferBytes - kStatusBytes;          // so that a block's echo fits into one transfer
constexpr std::uintmax_t kSmallestImage = 7000, kLargestImage = 9000;  // bytes; known ones have 7324 .. 8492
constexpr std::array<std::uint8_t, 2> kImageBegin = {0xaa, 0x08};      // of every known one

/// What came in within a latency, without status, appended. False: nothing.
bool receive(Transport& transport, std::vector<std::uint8_t>& bytes) {
  std::array<std::uint8_t, kTransferBytes> transfer{};
  const std::size_t count = transport.receive(transfer, std::chrono::milliseconds(kLatency_ms));
  if (count <= kStatusBytes) return false;
  bytes.insert(bytes.end(), transfer.begin() + kStatusBytes, transfer.begin() + static_cast<std::ptrdiff_t>(count));
  return true;
}

bool purge(Transport& transport) {
  return transport.request(kReset, kPurgeOne) && transport.request(kReset, kPurgeTwo);
}

bool enter_greeting_mode(Transport& transport) {
  return purge(transport) && transport.request(kLatency, kLatency_ms) && transport.request(kBaud, kBaud9600) &&
         transport.request(kFormat, kEightBits) && transport.request(kFlow, kNoFlow) &&
         transport.request(kModem, kRtsLow) && transport.request(kModem, kDtrLow) &&
         transport.request(kModem, kDtrHigh);
}

/// The processor answers a greeting; on some systems with a zero before it, and after what was left of an older answer.
bool is_welcome(const std::vector<std::uint8_t>& bytes) {
  constexpr std::array<std::uint8_t, 4> kWelcome = {0x0a, 0x44, 0x2c, 0x0d};
  return bytes.size() >= kWelcome.size() && std::equal(kWelcome.rbegin(), kWelcome.rend(), bytes.rbegin());
}

/// Answers to greetings that were given up too early would be taken for the echo of a block.
void drop_stale(Transport& transport) {
  std::vector<std::uint8_t> stale;
  for (int i = 0; i < kMostStale && receive(transport, stale); ++i) {
  }
}

bool greet(Transport& transport) {
  constexpr std::array<std::uint8_t, 3> kGreeting = {0x0a, 0x43, 0x0d};
  for (int i = 0; i < kGreetings && !transport.is_gone(); ++i) {
    std::vector<std::uint8_t> answer;
    if (!transport.send(kGreeting)) continue;
    for (int waits = 0; waits < kGreetingWaits && !is_welcome(answer) && answer.size() < kBlock;)
      waits += receive(transport, answer) ? 0 : 1;
    if (!is_welcome(answer)) continue;
    drop_stale(transport);
    return true;
  }
  return false;
}

/// Sends a block and waits for the same bytes back, in however many transfers.
Upload echo(Transport& transport, std::span<const std::uint8_t> block) {
  if (!transport.send(block)) return Upload::Gone;
  std::vector<std::uint8_t> back;
  for (int waits = 0; back.size() < block.size();) {
    if (transport.is_gone()) return Upload::Gone;
    if (receive(transport, back)) continue;
    if (++waits == kEchoWaits) return Upload::NoAnswer;
  }
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
