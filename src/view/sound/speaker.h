#pragma once

#include <memory>

namespace myotact::view {

/// Plays a force as a tone (force_tone.h) on the computer's own output, from a thread of its own.
class Speaker {
 public:
  /// Throws Error Unavailable: there is no output, or another program keeps it.
  Speaker();
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  /// 0 .. 1 of the largest force. Once a picture; without it for a quarter of a second the tone ends, so that a window
  /// that waits does not hum on.
  void play(double share);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace myotact::view
