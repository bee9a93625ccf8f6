#include <mutex>

#include <fmt/format.h>
#include <hidapi/hidapi.h>
#include <unistd.h>

#include "core/error.h"
#include "device/drivers/spacemouse/hid_port.h"

namespace myotact::device::spacemouse {

namespace {

/// hidapi keeps its last error in one place for all threads.
std::mutex& hidapi_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// Names of devices are plain Latin letters; what is not becomes '?'.
std::string plain(const wchar_t* text) {
  std::string letters;
  for (; text != nullptr && *text != L'\0'; ++text) {
    letters += *text >= L' ' && *text <= L'~' ? static_cast<char>(*text) : '?';
  }
  return letters;
}

class HidrawPort : public HidPort {
 public:
  explicit HidrawPort(hid_device* device) : device_(device) {}
  ~HidrawPort() override { hid_close(device_); }
  HidrawPort(const HidrawPort&) = delete;
  HidrawPort& operator=(const HidrawPort&) = delete;

  int read(std::span<std::uint8_t> report) noexcept override {
    return hid_read_timeout(device_, report.data(), report.size(), 0);
  }
  bool write(std::span<const std::uint8_t> report) noexcept override {
    return hid_write(device_, report.data(), report.size()) == static_cast<int>(report.size());
  }

 private:
  hid_device* device_;
};

class HidrawBus : public HidBus {
 public:
  std::vector<HidEntry> list() override {
    const std::lock_guard lock(hidapi_mutex());
    std::vector<HidEntry> entries;
    hid_device_info* const first = hid_enumerate(0, 0);
    for (const hid_device_info* info = first; info != nullptr; info = info->next) {
      if (info->path == nullptr) continue;
      entries.push_back({info->path, info->vendor_id, info->product_id, info->usage_page, info->usage,
                         plain(info->manufacturer_string), plain(info->product_string), plain(info->serial_number),
                         access(info->path, R_OK | W_OK) == 0});
    }
    hid_free_enumeration(first);
    return entries;
  }

  std::unique_ptr<HidPort> open(const std::string& path) override {
    const std::lock_guard lock(hidapi_mutex());
    hid_device* const device = hid_open_path(path.c_str());
    if (device == nullptr) {
      throw Error(ExitStatus::Unavailable, fmt::format("{}: cannot be opened ({}); plug the SpaceMouse in again", path,
                                                       plain(hid_error(nullptr))));
    }
    return std::make_unique<HidrawPort>(device);
  }
};

}  // namespace

std::unique_ptr<HidBus> make_hidraw_bus() {
  return std::make_unique<HidrawBus>();
}

}  // namespace myotact::device::spacemouse
