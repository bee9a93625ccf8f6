#include "fit_texture/burg.h"

#include <algorithm>

namespace myotact::fit_texture {

namespace {

/// A pure tone would have 1, which no stable process has.
constexpr double kLargest = 0.999;

struct Errors {
  std::vector<double> forward, backward;
};

}  // namespace

std::vector<double> burg_reflection(std::span<const std::vector<double>> pieces, int order) {
  std::vector<Errors> errors;
  for (const std::vector<double>& piece : pieces) {
    if (piece.size() > 2 * static_cast<std::size_t>(order)) errors.push_back({piece, piece});
  }
  std::vector<double> reflection;
  for (std::size_t m = 1; m <= static_cast<std::size_t>(order); ++m) {
    double product = 0.0, power = 0.0;
    for (const Errors& e : errors) {
      for (std::size_t n = m; n < e.forward.size(); ++n) {
        product += e.forward[n] * e.backward[n - 1];
        power += e.forward[n] * e.forward[n] + e.backward[n - 1] * e.backward[n - 1];
      }
    }
    const double k = power > 0.0 ? std::clamp(-2.0 * product / power, -kLargest, kLargest) : 0.0;
    reflection.push_back(k);
    for (Errors& e : errors) {
      for (std::size_t n = e.forward.size() - 1; n >= m; --n) {  // backwards: backward[n - 1] is still the old one
        const double forward = e.forward[n], late = e.backward[n - 1];
        e.forward[n] = forward + k * late;
        e.backward[n] = late + k * forward;
      }
    }
  }
  return reflection;
}

}  // namespace myotact::fit_texture
