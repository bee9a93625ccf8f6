#include <algorithm>
#include <cmath>
#include <cstring>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "anatomy/specimen.h"
#include "core/json_reader.h"
#include "fuzz/check.h"
#include "scene/recording.h"
#include "scene/recording_header.h"
#include "support/synthetic_specimen.h"
#include "support/temporary_folder.h"

namespace {

using namespace myotact;

constexpr std::size_t kMagicSize = 8;

/// Where the specimen of every recording lies, whatever its header names.
const testing::TemporaryFolder& folder() {
  static const testing::TemporaryFolder kFolder;
  return kFolder;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// The same chunks with lengths and check sums that are right: random bytes would never get past those.
std::string mended(std::string_view bytes) {
  std::string whole(bytes.substr(0, kMagicSize));
  bytes.remove_prefix(whole.size());
  while (bytes.size() > 2 * sizeof(std::uint32_t)) {
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), sizeof length);
    bytes.remove_prefix(sizeof length);
    length = static_cast<std::uint32_t>(std::min<std::size_t>(length, bytes.size() - sizeof(std::uint32_t)));
    const std::string_view type_and_payload = bytes.substr(0, sizeof(std::uint32_t) + length);
    const auto* start = reinterpret_cast<const Bytef*>(type_and_payload.data());
    append(whole, length);
    whole += type_and_payload;
    append(whole, static_cast<std::uint32_t>(crc32(0L, start, static_cast<uInt>(type_and_payload.size()))));
    bytes.remove_prefix(std::min(bytes.size(), type_and_payload.size() + sizeof(std::uint32_t)));
  }
  return whole;
}

void check_profiles(const std::vector<device::DeviceProfile>& profiles) {
  for (const device::DeviceProfile& profile : profiles) {
    testing::require(profile.peak_force_N >= 0.0 && std::isfinite(profile.peak_force_N));
    testing::require(profile.delay_ticks >= 0);
  }
}

/// What a replay is handed: a state and a number for everything that the scene has.
void check_fit(const scene::Recording& recording, const scene::Scene& scene) {
  for (const scene::StepRecord& step : recording.steps) {
    testing::require(step.tools.size() == scene.tools.size() && step.gravity_m_s2.allFinite());
    testing::require(step.excitations.size() == scene.specimen.muscles.size());
    testing::require(step.joint_torques_Nm.size() == scene.specimen.joints.size());
  }
  testing::require(recording.tools.size() <= scene.tools.size());
  for (const scene::ToolRecording& tool : recording.tools) {
    for (const scene::ModelRecord& model : tool.models) testing::require(model.step <= recording.steps.size());
  }
}

/// As load_recording() of scene/replay_session.h does. Other files that a scene names may be missing or bad.
void check_recording(std::string_view bytes) {
  scene::Recording recording;
  testing::check_reader("f.rec", [&] { recording = scene::parse_recording(bytes, "f.rec"); });
  if (recording.header_json.empty()) return;
  try {
    const nlohmann::json header = parse_json(recording.header_json, "f.rec (header)");
    check_profiles(scene::devices_of_recording(header, "f.rec"));
    const scene::Scene scene = scene::scene_of_recording(header, "f.rec", {{"specimen", (folder() / "s").string()}});
    scene::require_fit(recording, scene, "f.rec");
    check_fit(recording, scene);
  } catch (const Error& error) {
    testing::require(error.status() == ExitStatus::BadData || error.status() == ExitStatus::NoInput);
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  testing::BarShape shape;
  shape.cells = {1, 1, 1};
  anatomy::save_specimen(testing::single_muscle(shape), folder() / "s");
  return 0;
}

/// A recording as it is, and with the check sums of its chunks made right.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes = testing::as_text(data, size);
  check_recording(bytes);
  check_recording(mended(bytes));
  return 0;
}
