#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace myotact::simulation {

/// Published families of muscle force curves, between which a caller may choose at run time.
enum class CurveSet { DeGrooteFregly2016, Thelen2003, Millard2012, Blemker2005 };

/// A curve and its analytic derivative. At a kink the derivative is that of the left side.
struct Curve {
  double (*value)(double) noexcept;
  double (*slope)(double) noexcept;
};

/// Force against velocity at an activation 0 .. 1, which only Thelen's curve depends on.
struct VelocityCurve {
  /// Force, and its derivative against v.
  double (*value)(double v, double activation) noexcept;
  double (*slope)(double v, double activation) noexcept;
  /// The v at which the force is `force`, within -1 .. 1: the isotonic velocity under that load.
  double (*inverse)(double force, double activation) noexcept;
};

/// All curves of one set. Forces are over the peak isometric force; lengths `n` over the optimal fibre length; speeds
/// `v` over the largest shortening speed, v < 0 shortens; the tendon's argument is its length over its slack length.
/// Finite for every finite argument; real-time safe.
struct ForceCurves {
  Curve active;            // fL(n) at full activation
  Curve passive;           // fP(n)
  Curve tendon;            // fT(stretch)
  VelocityCurve velocity;  // fV(v), 1 at v = 0
};

/// The curves of one set; they last for ever. Blemker's muscle is quasi-static and ends where its tendon begins: its
/// velocity and tendon curves are De Groote's.
const ForceCurves& force_curves(CurveSet set) noexcept;

/// "degroote_fregly_2016" and so on, as files name the sets, in the order of the enumerators.
const std::vector<std::string>& curve_set_names();
/// The set of that name, or none.
std::optional<CurveSet> find_curve_set(std::string_view name);

}  // namespace myotact::simulation
