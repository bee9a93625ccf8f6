#include "view/window/display_loss.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <utility>

#include <dlfcn.h>

#include "core/exit_status.h"

namespace myotact::view {

namespace {

std::function<void()>& action() {
  static std::function<void()> last;
  return last;
}

/// Whatever is returned from here, Xlib ends the process at once, with a status of its own.
int end_program(void*) {
  try {
    if (action()) std::exchange(action(), {})();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "error: %s\n", failure.what());
  }
  std::fputs("error: the display went away. Forces are off, what was recorded is kept; start the program again.\n",
             stderr);
  std::_Exit(static_cast<int>(ExitStatus::Unavailable));
}

}  // namespace

void on_display_loss(std::function<void()> last_action) {
  action() = std::move(last_action);
  using Handler = int (*)(void* display);
  using SetHandler = Handler (*)(Handler);
  // The window's library brings Xlib where it draws on X11; on Wayland there is nothing to set.
  if (void* found = dlsym(RTLD_DEFAULT, "XSetIOErrorHandler")) reinterpret_cast<SetHandler>(found)(end_program);
}

}  // namespace myotact::view
