#include "device/drivers/force_dimension/force_dimension_driver.h"

#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "core/error.h"
#include "device/drivers/force_dimension/models.h"

namespace myotact::device::force_dimension {

namespace {

constexpr const char* kTitle = "Force Dimension omega, delta, sigma, lambda";
constexpr const char* kInstall =
    "install the Force Dimension SDK, or name its libdrd.so or libdhd.so by force_dimension.library";
constexpr const char* kSeeTo =
    "end other programs that use it, see to its cable and its power, and let this computer's user open it by "
    "assets/devices/udev/70-myotact.rules";

std::shared_ptr<DhdLibrary> shared_library(const std::string& path) {
  static std::mutex mutex;
  static std::weak_ptr<DhdLibrary> loaded;
  static std::string loaded_path;
  const std::lock_guard lock(mutex);
  if (auto library = loaded.lock()) {
    if (loaded_path == path) return library;
    const auto is_open = [](const std::atomic<bool>& open) { return open.load(); };
    if (std::any_of(library->is_open.begin(), library->is_open.end(), is_open)) {
      throw Error(ExitStatus::Unavailable, "this program uses another libdhd already");
    }
  }
  auto library = std::make_shared<DhdLibrary>(path);
  loaded = library;
  loaded_path = path;
  return library;
}

int count_of(const DhdLibrary& library) {
  return std::clamp(library.api.device_count(), 0, DhdLibrary::kMostDevices);
}

std::string name_of(int number) {
  return number == 0 ? "force_dimension" : fmt::format("force_dimension:{}", number + 1);
}

/// The device, opened and closed again.
DeviceFinding look_at(const DhdLibrary& library, int number) {
  DeviceFinding finding{name_of(number), kTitle, false, "", ""};
  if (library.is_open[static_cast<std::size_t>(number)]) {
    finding.cause = "this program has it open";
    finding.remedy = "close it first";
    return finding;
  }
  const int opened = library.api.open_device(number);
  if (opened < 0) {
    finding.cause = "it does not open: " + library.api.error_text();
    finding.remedy = kSeeTo;
    return finding;
  }
  const char id = static_cast<char>(opened);
  unsigned short serial = 0;
  finding.title = fmt::format("Force Dimension {}", model_of(library.api.system_type(id)).title);
  if (library.api.serial_number(&serial, id) >= 0) finding.title += fmt::format(", serial number {}", serial);
  library.api.close_device(id);
  finding.ready = true;
  return finding;
}

}  // namespace

std::vector<DeviceFinding> ForceDimensionDriver::find() {
  std::shared_ptr<DhdLibrary> library;
  try {
    library = shared_library(settings_.library);
  } catch (const Error& failure) {
    return {{name_, kTitle, false, failure.what(), kInstall}};
  }
  std::vector<DeviceFinding> findings;
  for (int i = 0; i < count_of(*library); ++i) findings.push_back(look_at(*library, i));
  if (findings.empty()) {
    return {{name_, kTitle, false, fmt::format("{} sees no device", library->api.library.path()), kSeeTo}};
  }
  return findings;
}

std::unique_ptr<HardwareDevice> ForceDimensionDriver::make(const std::string& name) {
  std::shared_ptr<DhdLibrary> library;
  try {
    library = shared_library(settings_.library);
  } catch (const Error& failure) {
    throw Error(ExitStatus::Unavailable, fmt::format("{}: {}; {}", name, failure.what(), kInstall));
  }
  const int count = count_of(*library);
  for (int i = 0; i < count; ++i) {
    if (name == name_of(i)) return std::make_unique<ForceDimensionDevice>(name, i, settings_, library);
  }
  throw Error(ExitStatus::Unavailable, fmt::format("there is no device \"{}\": {} sees {}; {}", name,
                                                   library->api.library.path(), count, kSeeTo));
}

}  // namespace myotact::device::force_dimension
