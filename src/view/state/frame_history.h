#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "messages/scene_frame.h"

namespace myotact::view {

/// The frames of the last minutes, to be looked at again. Its memory is bounded: when it is full, a frame goes where
/// the gap that it leaves is smallest for its age, so that the last seconds stay dense and older ones thin out. Which
/// frames are kept depends on the frames alone.
class FrameHistory {
 public:
  /// 200 MB hold about four minutes of the forelimb, its last ten seconds in every picture.
  static constexpr std::size_t kMost_bytes = std::size_t{200} << 20;
  /// Of simulated time; what is older is given up.
  static constexpr double kLongest_s = 600.0;

  explicit FrameHistory(std::size_t most_bytes = kMost_bytes, double longest_s = kLongest_s)
      : most_bytes_(most_bytes), longest_s_(longest_s) {}

  /// A frame of the same time as the last one is not kept; one of an earlier time, or of other parts, begins anew.
  void add(const messages::SceneFrame& frame);

  std::size_t size() const { return kept_.size(); }
  std::size_t bytes() const { return bytes_; }
  double time_s(std::size_t i) const { return kept_[i].rest.time_s; }
  /// The frame nearest to that time; nothing while there is none.
  std::optional<std::size_t> nearest(double time_s) const;
  /// Everything but the skins is what it was; a skin's vertex lies within half of 1/65535 of the skins' box.
  void fetch(std::size_t i, messages::SceneFrame& frame) const;

 private:
  /// A frame whose skins are three 16-bit numbers a vertex, places in the box of all skins.
  struct Kept {
    messages::SceneFrame rest;  // without skins
    std::array<float, 3> lowest_m{}, step_m{};
    std::vector<std::uint16_t> skins;     // muscles, one after the other, x vertices x 3
    std::vector<std::uint32_t> vertices;  // a muscle's
    std::size_t bytes = 0;
  };

  static void pack_skins(const messages::SceneFrame& frame, Kept& kept);
  static std::size_t bytes_of(const Kept& kept);
  bool continues(const messages::SceneFrame& frame) const;
  void remove(std::size_t i);
  void make_room();

  std::size_t most_bytes_;
  double longest_s_;
  std::size_t bytes_ = 0;
  std::vector<Kept> kept_;  // rising in time
};

}  // namespace myotact::view
