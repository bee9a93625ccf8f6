#pragma once

#include <vector>

namespace myotact::fit_texture {

/// The signal at `to_Hz`, without what lies above `cut_Hz` (less than half of either rate): a Blackman-windowed sinc of
/// 16 periods of the cut to each side. The ends, where the window hangs over, are left out.
std::vector<double> resampled(const std::vector<double>& signal, double from_Hz, double to_Hz, double cut_Hz);

/// The signal less its running mean over 0.5 s: what is slower than some 2 Hz is the hand's push, not texture.
std::vector<double> without_push(const std::vector<double>& signal, double rate_Hz);

}  // namespace myotact::fit_texture
