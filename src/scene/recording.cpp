#include "scene/recording.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "core/error.h"
#include "core/file.h"
#include "core/json_reader.h"

namespace myotact::scene {

static_assert(std::endian::native == std::endian::little, "the recording's layout is little-endian");

namespace {

constexpr std::string_view kMagic = "MYOREC01";
enum ChunkType : std::uint32_t { kHeader = 1, kStep = 2, kTicks = 3, kEnd = 4, kModel = 5, kTimedTicks = 6 };

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const std::vector<double>& values) {
  append(bytes, static_cast<std::uint32_t>(values.size()));
  for (const double value : values) append(bytes, value);
}

/// Takes values off the front of a payload; `ok` turns false when it is too short.
struct Cursor {
  std::string_view rest;
  bool ok = true;

  template <class T>
  T take() {
    T value{};
    if (rest.size() < sizeof value) {
      ok = false;
      return value;
    }
    std::memcpy(&value, rest.data(), sizeof value);
    rest.remove_prefix(sizeof value);
    return value;
  }

  std::vector<double> take_numbers() {
    const auto count = take<std::uint32_t>();
    if (count > rest.size() / sizeof(double)) {
      ok = false;
      return {};
    }
    std::vector<double> numbers(count);
    for (double& number : numbers) number = take<double>();
    return numbers;
  }
};

/// With dots for what no terminal shows.
std::string printable(std::string_view bytes) {
  std::string text(bytes);
  std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '.');
  return text;
}

std::uint32_t checksum(std::uint32_t type, std::string_view payload) {
  uLong crc = crc32(0L, Z_NULL, 0);
  crc = crc32(crc, reinterpret_cast<const Bytef*>(&type), sizeof type);
  crc = crc32(crc, reinterpret_cast<const Bytef*>(payload.data()), static_cast<uInt>(payload.size()));
  return static_cast<std::uint32_t>(crc);
}

struct Chunk {
  std::uint32_t type = 0;
  std::string_view payload;
};

/// The next whole, undamaged chunk, or nothing.
std::optional<Chunk> take_chunk(std::string_view& bytes) {
  Cursor cursor{bytes};
  const auto length = cursor.take<std::uint32_t>();
  Chunk chunk{cursor.take<std::uint32_t>(), {}};
  if (!cursor.ok || cursor.rest.size() < sizeof(std::uint32_t) || length > cursor.rest.size() - sizeof(std::uint32_t)) {
    return std::nullopt;
  }
  chunk.payload = cursor.rest.substr(0, length);
  cursor.rest.remove_prefix(length);
  if (cursor.take<std::uint32_t>() != checksum(chunk.type, chunk.payload)) return std::nullopt;
  bytes = cursor.rest;
  return chunk;
}

/// Steps of earlier versions end before the touched place; a hash follows.
messages::ToolState take_tool(Cursor& cursor) {
  constexpr std::size_t kBefore = offsetof(messages::ToolState, touched_world_m);
  if (cursor.rest.size() != kBefore + sizeof(StepRecord::state_hash)) return cursor.take<messages::ToolState>();
  messages::ToolState tool;
  std::memcpy(reinterpret_cast<char*>(&tool), cursor.rest.data(), kBefore);
  cursor.rest.remove_prefix(kBefore);
  return tool;
}

bool read_step(std::string_view payload, Recording& recording) {
  Cursor cursor{payload};
  StepRecord step;
  step.excitations = cursor.take_numbers();
  step.joint_torques_Nm = cursor.take_numbers();
  step.gravity_m_s2 = to_vec3(cursor.take<std::array<double, 3>>());
  step.tool = take_tool(cursor);
  step.state_hash = cursor.take<std::uint64_t>();
  if (cursor.ok) recording.steps.push_back(std::move(step));
  return cursor.ok;
}

/// `timed`: with their times; files of earlier versions hold none.
bool read_ticks(std::string_view payload, bool timed, Recording& recording) {
  Cursor cursor{payload};
  while (cursor.ok && !cursor.rest.empty()) {
    TickRecord tick;
    tick.device = cursor.take<messages::DeviceState>();
    tick.model_sequence = cursor.take<std::uint64_t>();
    if (timed) {
      tick.time_ns = cursor.take<std::uint64_t>();
      tick.forces_stopped = cursor.take<std::uint8_t>() != 0;
    }
    if (cursor.ok) recording.ticks.push_back(tick);
  }
  return cursor.ok;
}

bool read_model(std::string_view payload, Recording& recording) {
  Cursor cursor{payload};
  ModelRecord model;
  model.sequence = cursor.take<std::uint64_t>();
  model.published_at_ns = cursor.take<std::uint64_t>();
  model.holds_still = cursor.take<std::uint8_t>() != 0;
  model.tool_position_world_m = cursor.take<std::array<double, 3>>();
  model.step = recording.steps.size();
  if (cursor.ok) recording.models.push_back(model);
  return cursor.ok;
}

bool read_chunk(const Chunk& chunk, Recording& recording) {
  switch (chunk.type) {
    case kStep:
      return read_step(chunk.payload, recording);
    case kTicks:
    case kTimedTicks:
      return read_ticks(chunk.payload, chunk.type == kTimedTicks, recording);
    case kModel:
      return read_model(chunk.payload, recording);
    case kEnd:
      recording.complete = true;
      return true;
    default:
      return true;  // of a later version
  }
}

/// Keys of a device's profile in the header.
struct ProfileKey {
  const char* name;
  double device::DeviceProfile::*value;
};
constexpr std::array<ProfileKey, 7> kProfileKeys = {{
    {"peak_force_N", &device::DeviceProfile::peak_force_N},
    {"continuous_force_N", &device::DeviceProfile::continuous_force_N},
    {"max_stiffness_N_m", &device::DeviceProfile::max_stiffness_N_m},
    {"inertia_kg", &device::DeviceProfile::inertia_kg},
    {"viscous_Ns_m", &device::DeviceProfile::viscous_Ns_m},
    {"coulomb_N", &device::DeviceProfile::coulomb_N},
    {"resolution_m", &device::DeviceProfile::resolution_m},
}};
constexpr double kMostOfAll = 1e6;  // of any of them: no device of this world

}  // namespace

TickRecord record_of(const haptics::HapticTick& tick) {
  return {tick.device, tick.model_sequence, tick.tool.time_ns, tick.gate == haptics::GateState::Off};
}

std::string recording_header(const Scene& scene, std::uint64_t seed, const device::DeviceProfile& profile) {
  nlohmann::json device = {{"delay_ticks", profile.delay_ticks}, {"shows_force_only", profile.shows_force_only}};
  for (const ProfileKey& key : kProfileKeys) device[key.name] = profile.*key.value;
  const nlohmann::json header = {{"schema", 1},
                                 {"seed", seed},
                                 {"device", device},
                                 {"specimen", std::filesystem::absolute(scene.specimen_folder).string()},
                                 {"scene", scene.source_text}};
  return header.dump();
}

device::DeviceProfile device_of_recording(const nlohmann::json& header, const std::filesystem::path& file) {
  device::DeviceProfile profile;
  JsonObject fields(JsonValue(header, file.string()));
  const std::optional<JsonValue> device = fields.find("device");
  if (!device) return profile;
  JsonObject numbers(*device);
  for (const ProfileKey& key : kProfileKeys) profile.*key.value = numbers.at(key.name).number_between(0.0, kMostOfAll);
  profile.delay_ticks = numbers.at("delay_ticks").integer_between(0, 1000);
  profile.shows_force_only = numbers.at("shows_force_only").boolean();
  numbers.finish();
  return profile;
}

Scene scene_of_recording(const nlohmann::json& header, const std::filesystem::path& file, const Overrides& overrides) {
  JsonObject fields(JsonValue(header, file.string()));
  fields.at("schema").integer_between(1, 1);
  const JsonValue seed = fields.at("seed");
  if (!seed.raw().is_number_unsigned()) throw seed.error("must be a whole number of at least 0");
  fields.find("device");  // device_of_recording
  Overrides all = {{"specimen", fields.at("specimen").string()}};
  for (const auto& [key, value] : overrides) all[key] = value;
  const std::string text = fields.at("scene").string();
  fields.finish();
  Scene scene = parse_scene(text, file, all);
  set_seed(scene, seed.raw().get<std::uint64_t>());
  return scene;
}

void require_fit(const Recording& recording, const anatomy::Specimen& specimen, const std::filesystem::path& file) {
  for (std::size_t i = 0; i < recording.steps.size(); ++i) {
    const std::size_t muscles = recording.steps[i].excitations.size();
    const std::size_t joints = recording.steps[i].joint_torques_Nm.size();
    if (muscles == specimen.muscles.size() && joints == specimen.joints.size()) continue;
    throw bad_data(file.string(), fmt::format("step {}", i),
                   fmt::format("is for {} muscles and {} joints; the specimen has {} and {}. Name the specimen of the "
                               "recording with --set specimen=FOLDER",
                               muscles, joints, specimen.muscles.size(), specimen.joints.size()));
  }
}

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const std::string& header_json)
    : path_(path), file_(path, std::ios::binary | std::ios::trunc) {
  file_.write(kMagic.data(), static_cast<std::streamsize>(kMagic.size()));
  write_chunk(kHeader, header_json);
}

void RecordingWriter::write_chunk(std::uint32_t type, const std::string& payload) {
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(payload.size()));
  append(bytes, type);
  bytes += payload;
  append(bytes, checksum(type, payload));
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file_) {
    throw Error(
        ExitStatus::InputOutput,
        fmt::format("{}: the recording cannot be written. Check the folder and the free space.", path_.string()));
  }
}

void RecordingWriter::add(const StepRecord& step) {
  std::string payload;
  append(payload, step.excitations);
  append(payload, step.joint_torques_Nm);
  append(payload, to_array(step.gravity_m_s2));
  append(payload, step.tool);
  append(payload, step.state_hash);
  write_chunk(kStep, payload);
}

void RecordingWriter::add(const std::vector<TickRecord>& ticks) {
  std::string payload;
  for (const TickRecord& tick : ticks) {
    append(payload, tick.device);
    append(payload, tick.model_sequence);
    append(payload, tick.time_ns);
    append(payload, static_cast<std::uint8_t>(tick.forces_stopped));
  }
  write_chunk(kTimedTicks, payload);
}

void RecordingWriter::add(const ModelRecord& model) {
  std::string payload;
  append(payload, model.sequence);
  append(payload, model.published_at_ns);
  append(payload, static_cast<std::uint8_t>(model.holds_still));
  append(payload, model.tool_position_world_m);
  write_chunk(kModel, payload);
}

void RecordingWriter::close() {
  write_chunk(kEnd, "");
  file_.flush();
}

Recording read_recording(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  std::string_view rest = bytes;
  if (!rest.starts_with(kMagic)) {
    const bool other = rest.starts_with(kMagic.substr(0, 6));
    throw bad_data(path.string(), "byte 0",
                   other ? fmt::format("is a recording of another version, \"{}\"; this program reads \"{}\". Record it "
                                       "again, or take the program that wrote it",
                                       printable(rest.substr(0, kMagic.size())), kMagic)
                         : fmt::format("is no recording (\"{}\" is missing)", kMagic));
  }
  rest.remove_prefix(kMagic.size());
  const auto header = take_chunk(rest);
  if (!header || header->type != kHeader) throw bad_data(path.string(), "byte 8", "the header chunk is damaged");
  Recording recording;
  recording.header_json = header->payload;
  while (const auto chunk = take_chunk(rest)) {
    if (!read_chunk(*chunk, recording))
      throw bad_data(path.string(), "", "a chunk is shorter than its content; recorded by another version?");
  }
  return recording;
}

}  // namespace myotact::scene
