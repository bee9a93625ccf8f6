#pragma once

#include <array>

#include "core/vector.h"
#include "device/drivers/vendor_library.h"

namespace myotact::device::touch {

/// The test's end of fake_libhd.cpp.
class FakeHd {
 public:
  explicit FakeHd(bool manual = true) : library_("the tests' libHD", {FAKE_LIBHD}) {
    library_.bind("fake_hd_reset", reset_);
    library_.bind("fake_hd_tick", tick);
    library_.bind("fake_hd_push_error", push_error);
    library_.bind("fake_hd_fail", fail);
    library_.bind("fake_hd_pose", pose);
    library_.bind("fake_hd_calibration", calibration);
    library_.bind("fake_hd_warmth", warmth);
    library_.bind("fake_hd_max_force", max_force);
    library_.bind("fake_hd_sent", sent_);
    library_.bind("fake_hd_frames", frames);
    library_.bind("fake_hd_updates", updates);
    library_.bind("fake_hd_misuses", misuses);
    library_.bind("fake_hd_opened", opened);
    reset_(manual);
  }
  ~FakeHd() { reset_(true); }
  FakeHd(const FakeHd&) = delete;
  FakeHd& operator=(const FakeHd&) = delete;

  /// Of the last whole frame [N].
  Vec3 sent_N(unsigned int device = 0) const {
    Vec3 force_N;
    sent_(device, force_N.data());
    return force_N;
  }

  void (*tick)();
  void (*push_error)(unsigned int);
  void (*fail)(unsigned int at_init, unsigned int at_scheduler);
  void (*pose)(unsigned int device, double x_mm, double y_mm, double z_mm, int buttons);
  void (*calibration)(unsigned int device, unsigned int state, unsigned int style);
  void (*warmth)(unsigned int device, double warmth);
  void (*max_force)(double);
  long (*frames)(unsigned int device);
  int (*updates)(unsigned int device);
  long (*misuses)();
  int (*opened)();  // times, both together

 private:
  VendorLibrary library_;
  void (*reset_)(bool manual);
  void (*sent_)(unsigned int device, double* force_N);
};

}  // namespace myotact::device::touch
