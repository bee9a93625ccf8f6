#include <algorithm>
#include <cstdlib>

#include "device/drivers/falcon/packet.h"
#include "device/drivers/spacemouse/reports.h"
#include "fuzz/check.h"

namespace {

using namespace myotact;
using namespace myotact::device;

/// As transfers of the Falcon's serial chip, each of the length that its first byte says.
void read_falcon(std::span<const std::uint8_t> bytes) {
  falcon::PacketReader reader;
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(bytes.front() % 65, bytes.size() - 1);
    reader.take_transfer(bytes.subspan(1, size));
    bytes = bytes.subspan(1 + size);
    while (const auto packet = reader.next()) {
      testing::require(packet->front() == '<' && packet->back() == '>');
      const auto report = falcon::decode(*packet);
      if (!report) continue;
      const auto again = falcon::decode(falcon::encode(*report));
      testing::require(again && again->encoder_counts == report->encoder_counts);
    }
  }
}

/// As reports of a SpaceMouse, in the same way.
void read_spacemouse(std::span<const std::uint8_t> bytes) {
  spacemouse::Cap cap;
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(bytes.front(), bytes.size() - 1);
    spacemouse::apply_report(bytes.subspan(1, size), cap);
    bytes = bytes.subspan(1 + size);
    for (const int counts : cap.push) testing::require(std::abs(counts) <= spacemouse::kFullDeflection);
    for (const int counts : cap.rotation) testing::require(std::abs(counts) <= spacemouse::kFullDeflection);
    testing::require(cap.battery_percent <= 100);
  }
}

}  // namespace

// What comes over the cable of devices that send plain bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_falcon({data, size});
  read_spacemouse({data, size});
  return 0;
}
