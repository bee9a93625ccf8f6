#include "device/ready_finding.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace myotact::device {

std::size_t ready_finding(const std::vector<DeviceFinding>& findings, const std::string& name) {
  auto found = std::find_if(findings.begin(), findings.end(), [&](const auto& row) { return row.name == name; });
  const bool any_ready = std::any_of(findings.begin(), findings.end(), [](const auto& row) { return row.ready; });
  if (found == findings.end() && any_ready) {
    throw Error(ExitStatus::Unavailable,
                fmt::format("there is no device \"{}\"; the last one found is \"{}\"", name, findings.back().name));
  }
  if (found == findings.end()) found = findings.begin();
  if (!found->ready) throw Error(ExitStatus::Unavailable, fmt::format("{}: {}; {}", name, found->cause, found->remedy));
  return static_cast<std::size_t>(found - findings.begin());
}

}  // namespace myotact::device
