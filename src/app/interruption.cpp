#include "app/interruption.h"

#include <csignal>

namespace myotact::app {

namespace {

volatile std::sig_atomic_t received = 0;

void remember(int signal) {
  received = signal;
}

}  // namespace

void watch_for_interruption() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
}

int interruption() {
  constexpr int kShellOffset = 128;  // how a shell reports an end by signal
  return received == 0 ? 0 : kShellOffset + received;
}

}  // namespace myotact::app
