#include "anatomy/calibration_file.h"

#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "core/json_reader.h"

namespace myotact::anatomy {
namespace {

/// No fit of a usable mesh comes near these.
constexpr double kLargest = 100.0;

std::uint64_t read_fingerprint(const JsonValue& value) {
  const std::string text = value.string();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, 16);
  if (error != std::errc{} || end != text.data() + text.size() || text.size() != 16)
    throw value.error("must be 16 hexadecimal digits; delete the file, and myotact calibrate makes it again");
  return number;
}

FibreFit read_fit(const JsonValue& value) {
  JsonObject fields(value);
  FibreFit fit;
  fit.of = read_fingerprint(fields.at("of"));
  fit.offset = fields.at("offset").number_between(-kLargest, kLargest);
  fit.scale = fields.at("scale").number_between(0.0, kLargest);
  fit.gain = fields.at("gain").number_between(0.0, kLargest);
  fit.beyond = fields.at("beyond").number_between(0.0, 1.0);
  fit.force = fields.at("force").number_between(-kLargest, kLargest);
  fields.finish();
  return fit;
}

using Fit = std::optional<FibreFit> Muscle::*;  // which of a muscle's

void read_fits(const JsonValue& value, Fit which, Specimen& specimen) {
  for (const auto& [key, fit] : JsonObject(value).entries()) {
    const int muscle = find_muscle(specimen, key);
    const FibreFit read = read_fit(fit);
    if (muscle >= 0) specimen.muscles[static_cast<std::size_t>(muscle)].*which = read;
  }
}

nlohmann::ordered_json json_of_fits(const Specimen& specimen, Fit which) {
  nlohmann::ordered_json muscles = nlohmann::ordered_json::object();
  for (const Muscle& muscle : specimen.muscles) {
    if (!(muscle.*which)) continue;
    const FibreFit& fit = *(muscle.*which);
    muscles[muscle.key] = {{"of", fmt::format("{:016x}", fit.of)},
                           {"offset", fit.offset},
                           {"scale", fit.scale},
                           {"gain", fit.gain},
                           {"beyond", fit.beyond},
                           {"force", fit.force}};
  }
  return muscles;
}

}  // namespace

void read_calibration(const std::filesystem::path& folder, Specimen& specimen) {
  const std::filesystem::path file = folder / kCalibrationFile;
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return;
  const nlohmann::json json = read_json(file);
  JsonObject root(JsonValue(json, file.string()));
  root.at("schema").integer_between(1, 1);
  read_fits(root.at("muscles"), &Muscle::fibre_fit, specimen);
  if (const auto on_bones = root.find("on_bones")) read_fits(*on_bones, &Muscle::fibre_fit_on_bones, specimen);
  root.finish();
}

std::string calibration_json(const Specimen& specimen) {
  const nlohmann::ordered_json json{{"schema", 1},
                                    {"muscles", json_of_fits(specimen, &Muscle::fibre_fit)},
                                    {"on_bones", json_of_fits(specimen, &Muscle::fibre_fit_on_bones)}};
  return json.dump(1) + "\n";
}

}  // namespace myotact::anatomy
