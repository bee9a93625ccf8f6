#include "scene/recording.h"

#include <bit>
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
enum ChunkType : std::uint32_t { kHeader = 1, kStep = 2, kTicks = 3, kEnd = 4 };

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

bool read_step(std::string_view payload, Recording& recording) {
  Cursor cursor{payload};
  StepRecord step;
  step.excitations = cursor.take_numbers();
  step.joint_torques_Nm = cursor.take_numbers();
  step.gravity_m_s2 = to_vec3(cursor.take<std::array<double, 3>>());
  step.tool = cursor.take<messages::ToolState>();
  step.state_hash = cursor.take<std::uint64_t>();
  if (cursor.ok) recording.steps.push_back(std::move(step));
  return cursor.ok;
}

bool read_ticks(std::string_view payload, Recording& recording) {
  Cursor cursor{payload};
  while (cursor.ok && !cursor.rest.empty()) {
    const auto device = cursor.take<messages::DeviceState>();
    const auto sequence = cursor.take<std::uint64_t>();
    if (cursor.ok) recording.ticks.push_back({device, sequence});
  }
  return cursor.ok;
}

}  // namespace

std::string recording_header(const Scene& scene, std::uint64_t seed, Clock clock) {
  const nlohmann::json header = {{"schema", 1},
                                 {"seed", seed},
                                 {"clock", clock == Clock::Virtual ? "virtual" : "wall"},
                                 {"specimen", std::filesystem::absolute(scene.specimen_folder).string()},
                                 {"scene", scene.source_text}};
  return header.dump();
}

Clock clock_of_recording(const nlohmann::json& header, const std::filesystem::path& file) {
  JsonObject fields(JsonValue(header, file.string()));
  const std::optional<JsonValue> clock = fields.find("clock");
  if (!clock) return Clock::Wall;
  return clock->one_of({"virtual", "wall"}) == "virtual" ? Clock::Virtual : Clock::Wall;
}

Scene scene_of_recording(const nlohmann::json& header, const std::filesystem::path& file, const Overrides& overrides) {
  JsonObject fields(JsonValue(header, file.string()));
  fields.at("schema").integer_between(1, 1);
  fields.at("seed").number();
  fields.find("clock");  // clock_of_recording
  Overrides all = {{"specimen", fields.at("specimen").string()}};
  for (const auto& [key, value] : overrides) all[key] = value;
  const std::string text = fields.at("scene").string();
  fields.finish();
  return parse_scene(text, file, all);
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
  }
  write_chunk(kTicks, payload);
}

void RecordingWriter::close() {
  write_chunk(kEnd, "");
  file_.flush();
}

Recording read_recording(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  std::string_view rest = bytes;
  if (!rest.starts_with(kMagic)) throw bad_data(path.string(), "byte 0", "is no recording (\"MYOREC01\" is missing)");
  rest.remove_prefix(kMagic.size());
  const auto header = take_chunk(rest);
  if (!header || header->type != kHeader) throw bad_data(path.string(), "byte 8", "the header chunk is damaged");
  Recording recording;
  recording.header_json = header->payload;
  while (const auto chunk = take_chunk(rest)) {
    if (chunk->type == kEnd) recording.complete = true;
    const bool read = chunk->type == kStep    ? read_step(chunk->payload, recording)
                      : chunk->type == kTicks ? read_ticks(chunk->payload, recording)
                                              : true;
    if (!read) throw bad_data(path.string(), "", "a chunk is shorter than its content; recorded by another version?");
  }
  return recording;
}

}  // namespace myotact::scene
