#pragma once

namespace myotact {

/// How a program of this project ends. Values follow sysexits.h; scripts rely on them.
enum class ExitStatus : int {
  Done = 0,
  CheckFailed = 1,
  Usage = 2,
  BadData = 65,
  NoInput = 66,
  Unavailable = 69,  // a device or a display is not there
  Internal = 70,
  InputOutput = 74,
  Interrupted = 130,
  Terminated = 143,
};

}  // namespace myotact
