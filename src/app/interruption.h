#pragma once

namespace myotact::app {

/// From now on SIGINT and SIGTERM only set a flag, so that forces can go to zero and recordings be flushed.
void watch_for_interruption();

/// The exit status of the signal that came (130 or 143), or 0.
int interruption();

}  // namespace myotact::app
