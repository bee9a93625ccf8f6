#include "app/fidelity_input.h"

#include "app/interruption.h"
#include "core/error.h"

namespace myotact::app {

std::optional<device::NamedProfile> named_profile(const Options& options) {
  if (options.devices.empty()) return std::nullopt;
  if (options.devices.size() > 1)
    throw Error(ExitStatus::Usage, "--device: one tool is measured; name one device profile");
  return device::load_profile(options.devices.front());
}

measure::RunWatch watch_until_interrupted(Progress& progress) {
  watch_for_interruption();
  return {[&progress](int done, int all) { progress.show(done, all); }, [] { return interruption() != 0; }};
}

}  // namespace myotact::app
