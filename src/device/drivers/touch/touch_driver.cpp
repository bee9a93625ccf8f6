#include "device/drivers/touch/touch_driver.h"

#include <mutex>

#include <fmt/format.h>

#include "core/error.h"

namespace myotact::device::touch {

namespace {

constexpr const char* kTitle = "3D Systems Touch";
constexpr const char* kInstall =
    "install 3D Systems' Touch Device Driver and OpenHaptics, or name the file by touch.library";

/// A second copy of the library's servo loop would fight with the first for the device.
std::shared_ptr<TouchLibrary> shared_library(const std::string& path) {
  static std::mutex mutex;
  static std::weak_ptr<TouchLibrary> loaded;
  static std::string loaded_path;
  const std::lock_guard lock(mutex);
  if (auto library = loaded.lock()) {
    if (loaded_path == path) return library;
    if (library->servo.is_in_use()) throw Error(ExitStatus::Unavailable, "this program uses another libHD already");
  }
  auto library = std::make_shared<TouchLibrary>(path);
  loaded = library;
  loaded_path = path;
  return library;
}

std::string name_of(std::size_t index) {
  return index == 0 ? "touch" : fmt::format("touch:{}", index + 1);
}

std::string text_of(const Hdapi& api, Code parameter) {
  const char* text = api.get_string(parameter);
  return api.take_error() == kNone && text != nullptr ? text : "";
}

/// The device, opened and closed again.
DeviceFinding look_at(TouchLibrary& library, const std::string& configuration, const std::string& name) {
  DeviceFinding finding{name, configuration.empty() ? kTitle : fmt::format("{} \"{}\"", kTitle, configuration), false,
                        "", ""};
  library.api.take_error();
  const Handle handle = library.api.init_device(configuration.empty() ? nullptr : configuration.c_str());
  const Code error = library.api.take_error();
  if (error != kNone || handle == kNoDevice) {
    if (handle != kNoDevice) library.api.disable_device(handle);
    const Trouble trouble = trouble_of(library.api, error);
    finding.cause = trouble.cause;
    finding.remedy = trouble.remedy;
    return finding;
  }
  const std::string model = text_of(library.api, kModel), serial = text_of(library.api, kSerial);
  if (!model.empty()) finding.title += ", " + model;
  if (!serial.empty()) finding.title += ", " + serial;
  library.api.disable_device(handle);
  library.api.take_error();
  finding.ready = true;
  return finding;
}

}  // namespace

std::vector<DeviceFinding> TouchDriver::find() {
  std::shared_ptr<TouchLibrary> library;
  try {
    library = shared_library(settings_.library);
  } catch (const Error& failure) {
    return {{name_, kTitle, false, failure.what(), kInstall}};
  }
  std::vector<DeviceFinding> findings;
  for (std::size_t i = 0; i < settings_.configurations.size(); ++i) {
    if (library->servo.is_in_use()) {
      findings.push_back({name_of(i), kTitle, false, "this program has a Touch open", "close it first"});
    } else {
      findings.push_back(look_at(*library, settings_.configurations[i], name_of(i)));
    }
  }
  return findings;
}

std::unique_ptr<HardwareDevice> TouchDriver::make(const std::string& name) {
  for (std::size_t i = 0; i < settings_.configurations.size(); ++i) {
    if (name != name_of(i)) continue;
    try {
      return std::make_unique<TouchDevice>(name, settings_.configurations[i], settings_,
                                           shared_library(settings_.library));
    } catch (const Error& failure) {
      throw Error(ExitStatus::Unavailable, fmt::format("{}: {}; {}", name, failure.what(), kInstall));
    }
  }
  throw Error(ExitStatus::Unavailable,
              fmt::format("there is no device \"{}\"; touch.configurations names {}", name,
                          settings_.configurations.size() == 1
                              ? std::string("one, \"touch\"")
                              : fmt::format("\"touch\" to \"{}\"", name_of(settings_.configurations.size() - 1))));
}

}  // namespace myotact::device::touch
