#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/vector.h"
#include "haptics/haptic_loop.h"
#include "messages/device.h"
#include "messages/held_tool.h"
#include "messages/tool_state.h"

namespace myotact::scene {

// A recording is append-only: 8 bytes "MYOREC01", then chunks of {u32 length, u32 type, payload, u32 crc32 of type and
// payload}, little-endian. After a crash it is readable up to the last whole chunk. Files of the first version, which
// knew one tool, are read as well.

/// A posture in which everything is put at rest.
struct RestPosture {
  std::vector<double> angles_rad;   // one a joint
  std::vector<double> activations;  // one a muscle, 0 .. 1
};

/// The inputs of the simulation before a step, and the state that followed.
struct StepRecord {
  std::optional<RestPosture> from = {};  // the step begins at rest there; none: where the last one ended
  std::vector<double> excitations;       // one a muscle
  std::vector<double> joint_torques_Nm;  // one a joint
  Vec3 gravity_m_s2 = Vec3::Zero();
  std::vector<messages::ToolState> tools;  // one a tool of the scene
  std::uint64_t state_hash = 0;            // after the step
};

/// What a device said in one tick, and which model answered.
struct TickRecord {
  messages::DeviceState device;
  std::uint64_t model_sequence = 0;
  std::uint64_t time_ns = 0;                       // of the loop's clock
  bool forces_stopped = false;                     // by a person or a caller
  std::optional<messages::ToolShape> chosen = {};  // asked for in that tick; none: as the scene says
};

TickRecord record_of(const haptics::HapticTick& tick);

/// A model that a haptic loop could take.
struct ModelRecord {
  std::uint64_t sequence = 0;
  std::uint64_t published_at_ns = 0;
  bool holds_still = false;                        // the simulation paused
  std::array<double, 3> tool_position_world_m{};   // of the tool state for which it was written
  std::size_t step = 0;                            // steps before this one; by the place in the file
  std::optional<messages::ToolShape> chosen = {};  // for which contacts are reported; none: as the scene says
};

/// What one tool's device and loop went through.
struct ToolRecording {
  std::vector<TickRecord> ticks;
  std::vector<ModelRecord> models;
};

struct Recording {
  std::string header_json;  // program version, seed, settings, the scene's text
  std::vector<StepRecord> steps;
  std::vector<ToolRecording> tools;  // up to the last one that anything was recorded of
  bool complete = false;             // the closing chunk is there
};

class RecordingWriter {
 public:
  /// Throws Error InputOutput.
  RecordingWriter(const std::filesystem::path& path, const std::string& header_json);
  void add(const StepRecord& step);
  void add(std::size_t tool, const std::vector<TickRecord>& ticks);
  void add(std::size_t tool, const ModelRecord& model);
  void close();  // once; later calls do nothing

 private:
  void write_chunk(std::uint32_t type, const std::string& payload);

  std::filesystem::path path_;
  std::ofstream file_;
  bool closed_ = false;
};

/// Throws Error NoInput, or BadData when the file is no recording or its first chunk is damaged.
Recording read_recording(const std::filesystem::path& path);
/// The same from its bytes; `file` is only named in errors.
Recording parse_recording(std::string_view bytes, const std::string& file);

}  // namespace myotact::scene
