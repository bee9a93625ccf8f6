#pragma once

#include <filesystem>
#include <utility>

#include <spdlog/spdlog.h>

#include "anatomy/specimen.h"
#include "core/exit_status.h"
#include "prepare/commands.h"

// What all commands that make a specimen do once they have a limb: its stages with a progress bar, what is written, the
// report, and an end between two parts when a signal comes.

namespace myotact::prepare {

/// Ends the work where it stands.
struct Interrupted {
  int status;
};
void stop_when_interrupted();

/// Before any work: throws Error unless the folder that is to hold the output is there, or can be made, and can be
/// written. `what` is written there, for the text.
void check_output(const std::filesystem::path& output, const char* what);

/// A person's recipe goes into the specimen that it made, so that it can be edited there and is not lost when the
/// folder is replaced.
anatomy::CompanionFiles companions_of(const Options& options);

/// Takes the limb through its stages and writes the specimen with its report and `companions`, or what the stage
/// `options.until` made. Prints the report.
void finish_limb(LimbWork& limb, const Options& options, const std::filesystem::path& output,
                 anatomy::CompanionFiles companions = {});

/// Calls the command; the exit status.
template <class Command>
int unless_interrupted(Command&& command) {
  try {
    command();
    return static_cast<int>(ExitStatus::Done);
  } catch (const Interrupted& interrupted) {
    spdlog::error("interrupted; nothing was written");
    return interrupted.status;
  }
}

}  // namespace myotact::prepare
