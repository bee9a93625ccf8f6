#include "scene/recording.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "core/error.h"
#include "core/file.h"

namespace myotact::scene {

static_assert(std::endian::native == std::endian::little, "the recording's layout is little-endian");

namespace {

constexpr std::string_view kMagic = "MYOREC01";
/// Before there were several tools, a step held one ToolState and ticks and models did not say whose they are.
enum ChunkType : std::uint32_t {
  kHeader = 1,
  kStepOfOne = 2,
  kUntimedTicksOfOne = 3,
  kEnd = 4,
  kModelOfOne = 5,
  kTicksOfOne = 6,
  kStep = 7,
  kTicks = 8,
  kModel = 9,
  kRestPosture = 10  // before the step that begins there
};
constexpr std::uint32_t kMostToolsInAFile = 16;  // two hands; a damaged count must not ask for memory

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const std::vector<double>& values) {
  append(bytes, static_cast<std::uint32_t>(values.size()));
  for (const double value : values) append(bytes, value);
}

/// Takes values off the front of a payload; `ok` becomes false when it is too short.
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
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '.');
  return text;
}

// A flag and the tool that was chosen, in the byte that once held the flag alone: 0 or 1.
constexpr std::uint8_t kFlag = 1;
constexpr int kToolShift = 1;

std::uint8_t with_tool(bool flag, const std::optional<messages::ToolShape>& tool) {
  const int number = tool ? 1 + static_cast<int>(*tool) : 0;
  return static_cast<std::uint8_t>((flag ? kFlag : 0) | (number << kToolShift));
}

std::optional<messages::ToolShape> tool_of(std::uint8_t byte, bool& ok) {
  const int number = byte >> kToolShift;
  ok = ok && number <= 1 + static_cast<int>(messages::ToolShape::Clamp);
  if (!ok || number == 0) return std::nullopt;
  return static_cast<messages::ToolShape>(number - 1);
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

/// Of a step of one tool. Those of earlier versions end before the touched place; a hash follows.
messages::ToolState take_only_tool(Cursor& cursor) {
  constexpr std::size_t kBefore = offsetof(messages::ToolState, touched_world_m);
  if (cursor.rest.size() != kBefore + sizeof(StepRecord::state_hash)) return cursor.take<messages::ToolState>();
  messages::ToolState tool;
  std::memcpy(reinterpret_cast<char*>(&tool), cursor.rest.data(), kBefore);
  cursor.rest.remove_prefix(kBefore);
  return tool;
}

bool read_step(std::string_view payload, bool of_one, Recording& recording) {
  Cursor cursor{payload};
  StepRecord step;
  step.excitations = cursor.take_numbers();
  step.joint_torques_Nm = cursor.take_numbers();
  step.gravity_m_s2 = to_vec3(cursor.take<std::array<double, 3>>());
  const std::uint32_t tools = of_one ? 1 : cursor.take<std::uint32_t>();
  if (tools > kMostToolsInAFile) return false;
  for (std::uint32_t t = 0; t < tools; ++t) {
    step.tools.push_back(of_one ? take_only_tool(cursor) : cursor.take<messages::ToolState>());
  }
  step.state_hash = cursor.take<std::uint64_t>();
  if (cursor.ok) recording.steps.push_back(std::move(step));
  return cursor.ok;
}

/// Whose ticks or model a chunk holds; null when its number makes no sense.
ToolRecording* take_tool(Cursor& cursor, bool of_one, Recording& recording) {
  const std::uint32_t tool = of_one ? 0 : cursor.take<std::uint32_t>();
  if (!cursor.ok || tool >= kMostToolsInAFile) return nullptr;
  if (recording.tools.size() <= tool) recording.tools.resize(tool + 1);
  return &recording.tools[tool];
}

bool read_ticks(const Chunk& chunk, Recording& recording) {
  Cursor cursor{chunk.payload};
  ToolRecording* tool = take_tool(cursor, chunk.type != kTicks, recording);
  if (tool == nullptr) return false;
  while (cursor.ok && !cursor.rest.empty()) {
    TickRecord tick;
    tick.device = cursor.take<messages::DeviceState>();
    tick.model_sequence = cursor.take<std::uint64_t>();
    if (chunk.type != kUntimedTicksOfOne) {
      tick.time_ns = cursor.take<std::uint64_t>();
      const auto byte = cursor.take<std::uint8_t>();
      tick.forces_stopped = (byte & kFlag) != 0;
      tick.chosen = tool_of(byte, cursor.ok);
    }
    if (cursor.ok) tool->ticks.push_back(tick);
  }
  return cursor.ok;
}

bool read_model(const Chunk& chunk, Recording& recording) {
  Cursor cursor{chunk.payload};
  ToolRecording* tool = take_tool(cursor, chunk.type != kModel, recording);
  if (tool == nullptr) return false;
  ModelRecord model;
  model.sequence = cursor.take<std::uint64_t>();
  model.published_at_ns = cursor.take<std::uint64_t>();
  const auto byte = cursor.take<std::uint8_t>();
  model.holds_still = (byte & kFlag) != 0;
  model.chosen = tool_of(byte, cursor.ok);
  model.tool_position_world_m = cursor.take<std::array<double, 3>>();
  model.step = recording.steps.size();
  if (cursor.ok) tool->models.push_back(model);
  return cursor.ok;
}

RestPosture read_posture(std::string_view payload, bool& ok) {
  Cursor cursor{payload};
  RestPosture posture;
  posture.angles_rad = cursor.take_numbers();
  posture.activations = cursor.take_numbers();
  ok = cursor.ok;
  return posture;
}

bool read_chunk(const Chunk& chunk, std::optional<RestPosture>& from, Recording& recording) {
  bool ok = true;
  switch (chunk.type) {
    case kStepOfOne:
    case kStep:
      ok = read_step(chunk.payload, chunk.type == kStepOfOne, recording);
      if (ok) recording.steps.back().from = std::exchange(from, std::nullopt);
      return ok;
    case kRestPosture:
      from = read_posture(chunk.payload, ok);
      return ok;
    case kUntimedTicksOfOne:
    case kTicksOfOne:
    case kTicks:
      return read_ticks(chunk, recording);
    case kModelOfOne:
    case kModel:
      return read_model(chunk, recording);
    case kEnd:
      recording.complete = true;
      return true;
    default:
      return true;  // of a later version
  }
}

}  // namespace

TickRecord record_of(const haptics::HapticTick& tick) {
  return {tick.device, tick.model_sequence, tick.tool.time_ns, tick.gate == haptics::GateState::Off, tick.chosen};
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
  if (step.from) {
    append(payload, step.from->angles_rad);
    append(payload, step.from->activations);
    write_chunk(kRestPosture, payload);
    payload.clear();
  }
  append(payload, step.excitations);
  append(payload, step.joint_torques_Nm);
  append(payload, to_array(step.gravity_m_s2));
  append(payload, static_cast<std::uint32_t>(step.tools.size()));
  for (const messages::ToolState& tool : step.tools) append(payload, tool);
  append(payload, step.state_hash);
  write_chunk(kStep, payload);
}

void RecordingWriter::add(std::size_t tool, const std::vector<TickRecord>& ticks) {
  std::string payload;
  append(payload, static_cast<std::uint32_t>(tool));
  for (const TickRecord& tick : ticks) {
    append(payload, tick.device);
    append(payload, tick.model_sequence);
    append(payload, tick.time_ns);
    append(payload, with_tool(tick.forces_stopped, tick.chosen));
  }
  write_chunk(kTicks, payload);
}

void RecordingWriter::add(std::size_t tool, const ModelRecord& model) {
  std::string payload;
  append(payload, static_cast<std::uint32_t>(tool));
  append(payload, model.sequence);
  append(payload, model.published_at_ns);
  append(payload, with_tool(model.holds_still, model.chosen));
  append(payload, model.tool_position_world_m);
  write_chunk(kModel, payload);
}

void RecordingWriter::close() {
  if (std::exchange(closed_, true)) return;
  write_chunk(kEnd, "");
  file_.flush();
}

Recording read_recording(const std::filesystem::path& path) {
  return parse_recording(read_file(path), path.string());
}

Recording parse_recording(std::string_view bytes, const std::string& file) {
  std::string_view rest = bytes;
  if (!rest.starts_with(kMagic)) {
    const bool other = rest.starts_with(kMagic.substr(0, 6));
    throw bad_data(file, "byte 0",
                   other
                       ? fmt::format("is a recording of another version, \"{}\"; this program reads \"{}\". Record it "
                                     "again, or take the program that wrote it",
                                     printable(rest.substr(0, kMagic.size())), kMagic)
                       : fmt::format("is no recording (\"{}\" is missing)", kMagic));
  }
  rest.remove_prefix(kMagic.size());
  const auto header = take_chunk(rest);
  if (!header || header->type != kHeader) throw bad_data(file, "byte 8", "the header chunk is damaged");
  Recording recording;
  recording.header_json = header->payload;
  std::optional<RestPosture> from;
  for (std::size_t at = bytes.size() - rest.size(); const auto chunk = take_chunk(rest);
       at = bytes.size() - rest.size()) {
    if (read_chunk(*chunk, from, recording)) continue;
    throw bad_data(file, fmt::format("byte {}", at),
                   "a chunk is shorter than its content; recorded by another version?");
  }
  return recording;
}

}  // namespace myotact::scene
