#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "app/device_calibration.h"
#include "app/device_check.h"
#include "app/equipment.h"
#include "app/guarded_motors.h"
#include "app/interruption.h"
#include "app/options.h"
#include "core/error.h"
#include "core/text.h"
#include "device/profile_file.h"
#include "device/simulated_device.h"

namespace myotact::app {

namespace {

/// A row of the table.
struct Row {
  device::DeviceFinding finding;
  std::string driver;
  double rate_Hz = 0.0;  // of exchanges with it, at most
  std::optional<device::DeviceProfile> limits = {};
};

std::vector<Row> devices_without_hardware() {
  return {{{"simulated", "a simulated hand on a simulated 3-axis device, follows the scene's script", true, "", ""},
           "simulated",
           1000.0,
           device::simulated_profile("simulated")},
          {{"mouse", "the mouse moves the stylus in the window; forces are shown, not felt", true, "", ""},
           "mouse",
           60.0}};  // once a picture
}

Row row_of(device::Driver& driver, const device::DeviceFinding& finding) {
  Row row{finding, driver.name(), device::nominal_rate_Hz(driver.name())};
  if (!finding.ready) return row;
  try {
    row.limits = driver.make(finding.name)->profile();
  } catch (const Error& failure) {  // taken or unplugged since it was found
    row.finding.ready = false;
    row.finding.cause = failure.what();
  }
  return row;
}

std::vector<Row> rows_of(const Options& options) {
  std::vector<Row> rows = devices_without_hardware();
  for (const auto& driver : device::make_drivers(device_settings_of(options))) {
    for (const device::DeviceFinding& finding : driver->find()) rows.push_back(row_of(*driver, finding));
  }
  return rows;
}

nlohmann::json row_json(const Row& row) {
  nlohmann::json json = {{"name", row.finding.name},
                         {"what", row.finding.title},
                         {"driver", row.driver},
                         {"available", row.finding.ready},
                         {"rate_Hz", row.rate_Hz}};
  if (row.limits && !row.limits->shows_force_only) {
    json["peak_force_N"] = row.limits->peak_force_N;
    json["continuous_force_N"] = row.limits->continuous_force_N;
    json["max_stiffness_N_m"] = row.limits->max_stiffness_N_m;
    json["workspace_m"] = row.limits->workspace_m;
  }
  if (!row.finding.ready) {
    json["cause"] = row.finding.cause;
    json["remedy"] = row.finding.remedy;
  }
  return json;
}

std::string limits_text(const Row& row) {
  if (!row.limits || row.limits->shows_force_only) return "-";
  return fmt::format("{:.1f} N, {:.0f} N/m", row.limits->peak_force_N, row.limits->max_stiffness_N_m);
}

void print_table(const std::vector<Row>& rows) {
  constexpr const char* kFormat = "{:<18} {:<10} {:>8}  {:<17} {}\n";
  std::cout << fmt::format(kFormat, "name", "state", "rate", "limits", "what");
  for (const Row& row : rows) {
    std::cout << fmt::format(kFormat, row.finding.name, row.finding.ready ? "ready" : "not ready",
                             fmt::format("{:.0f} Hz", row.rate_Hz), limits_text(row), row.finding.title);
    if (!row.finding.cause.empty()) std::cout << "    why:    " << row.finding.cause << '\n';
    if (!row.finding.remedy.empty()) std::cout << "    remedy: " << row.finding.remedy << '\n';
  }
}

int test_simulated(const std::string& name, GuardedMotors& guarded, LineInput& answers) {
  device::SimulatedDevice device(name, Vec3::Zero(), device::simulated_profile(name));
  device.drive(guarded.motors[0]);
  return check_device(device, nullptr, &guarded.watchdog, answers, std::cout) ? 0 : 1;
}

int test_device(const Options& options, const std::string& name) {
  GuardedMotors guarded;  // first: the watchdog is forked off before there are threads
  watch_for_interruption();
  LineInput answers(STDIN_FILENO);
  int status = 0;
  if (name == "simulated" || name.starts_with("simulated:")) {
    status = test_simulated(name, guarded, answers);
  } else {
    const auto device = make_device(device_settings_of(options), name);
    device->open();
    device::PlacedDevice placed(*device, {});
    status = check_device(placed, device.get(), nullptr, answers, std::cout) ? 0 : 1;
  }
  return interruption() != 0 ? interruption() : status;
}

/// A device that moves by itself to find out where it is must be let.
bool may_move_itself(LineInput& answers) {
  std::cout << "The device may move by itself through its whole reach to find out where it is. Take your hands away.\n"
               "Type yes to allow it: "
            << std::flush;
  std::optional<std::string> line;
  while (!line && !answers.ended() && interruption() == 0) line = answers.next(std::chrono::milliseconds(50));
  std::cout << '\n';
  return line == "yes";
}

int calibrate(const Options& options, const std::string& name) {
  watch_for_interruption();
  LineInput answers(STDIN_FILENO);
  device::DeviceSettings settings = device_settings_of(options);
  make_device(settings, name);  // throws where there is none: nothing to be asked about
  if (name.starts_with("force_dimension") && !may_move_itself(answers)) {
    std::cout << name << " is not calibrated: it has to be let move by itself.\n" << std::flush;
    return interruption() != 0 ? interruption() : 1;
  }
  settings.force_dimension.initialises_itself = true;
  const auto device = make_device(settings, name);
  std::optional<ForceScale> scale;
  if (name.starts_with("falcon")) {
    scale = {settings.falcon.exchange.counts_per_Nm, device::kLowestFalconScale, device::kHighestFalconScale};
  }
  device->open();
  const Calibration found = calibrate_device(*device, scale, answers, std::cout);
  device->close();
  if (found.scale) {
    const std::filesystem::path file = device::device_settings_file();
    std::cout << fmt::format("\nThe force scale is {:.0f} now", *found.scale) << std::flush;
    device::keep_device_settings(file, {{"falcon.counts_per_Nm", to_text(*found.scale)}});
    std::cout << fmt::format("; {} keeps it.\n", file.string());
  }
  return interruption() != 0 ? interruption() : (found.is_ready ? 0 : 1);
}

}  // namespace

int devices(const Options& options) {
  for (const auto& [key, value] : scene_overrides_of(options)) {
    throw Error(ExitStatus::Usage, "--set " + key + ": is no setting of a device; assets/devices/README.md lists them");
  }
  if (options.test_device) return test_device(options, *options.test_device);
  if (options.calibrate_device) return calibrate(options, *options.calibrate_device);
  const std::vector<Row> rows = rows_of(options);
  if (options.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& row : rows) list.push_back(row_json(row));
    std::cout << list.dump(2) << '\n';
  } else {
    print_table(rows);
  }
  std::cout << std::flush;
  return 0;
}

}  // namespace myotact::app
