#pragma once

#include <stdexcept>
#include <string>

#include "core/exit_status.h"

namespace myotact {

/// An error that ends a command. The text names file, place, value, allowed range and remedy.
/// Thrown while loading and preparing only, never from a haptic tick.
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& text) : std::runtime_error(text), status_(status) {}

  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// Bad content of a file: "FILE: PLACE: PROBLEM". `place` is "line:column", a JSON pointer, a byte offset or an
/// element.
inline Error bad_data(const std::string& file, const std::string& place, const std::string& problem) {
  return {ExitStatus::BadData, place.empty() ? file + ": " + problem : file + ": " + place + ": " + problem};
}

}  // namespace myotact
