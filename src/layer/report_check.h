#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "layer/engine.h"
#include "messages/local_model.h"

namespace myotact::layer {

/// What an engine may get wrong.
enum class ReportDefect : std::uint8_t {
  NotFinite,
  NoNormal,
  NegativeDepth,
  NoSuchBody,
  LostBody,
  TooMany,
  UnsoundSurface,
  Silent,
};
inline constexpr std::size_t kReportDefects = 8;

struct ReportDefectText {
  ReportDefect defect;
  std::string_view name;
  std::string_view remedy;  // what was done, and what to do
};

/// Every defect, in the order of the enumeration.
std::span<const ReportDefectText> report_defect_texts();

/// Looks through what an engine hands to a tool, before the tool sees it: what is wrong is taken out, never mended into
/// a force; it is counted, and reported once a kind. Used by the engine's thread; counts by any.
class ReportCheck {
 public:
  /// `engine` outlives this.
  explicit ReportCheck(const Engine& engine) : engine_(engine) {}

  /// Leaves the contacts that can be used, in their order. A report that does not know where the tool is loses all.
  void clean(messages::ReportedContacts& reported);
  /// An unsound surface stays in the model: the tool refuses the whole of it (Fault::BadModel), its force goes to zero
  /// and comes back through the ramp.
  void look_at(const messages::LocalModel& model);
  /// The engine had reported nothing for that long, which was kSilent_ns and more.
  void note_silence(double lasted_s);

  /// Contacts, models or silences with that defect so far. Any thread.
  std::uint64_t count(ReportDefect defect) const noexcept {
    return counts_[static_cast<std::size_t>(defect)].load(std::memory_order_relaxed);
  }
  /// A line for each kind that came up for the first time since the last call.
  std::vector<std::string> take_news();

 private:
  bool is_usable(const messages::ReportedContact& contact);
  bool find(ReportDefect defect, const std::string& detail);

  const Engine& engine_;
  std::array<std::atomic<std::uint64_t>, kReportDefects> counts_{};
  std::vector<std::string> news_;
};

/// An engine that reports nothing for this long hangs: its own steps are some 10 to 20 ms, and forces are long gone by
/// the gate's rule (100 ms).
inline constexpr std::uint64_t kSilent_ns = 200'000'000;

}  // namespace myotact::layer
