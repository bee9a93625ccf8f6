#include "measure/stiffness_reason.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace myotact::measure {

namespace {

constexpr double kShown_Nm_rad = 0.005;  // what two digits show

/// One summand of K.
struct Summand {
  const char* what;  // "X is the largest part"
  double K_Nm_rad;
  double (*of_muscle)(const MusclePart& part);  // null: no muscle has a share
  const char* remedy;                           // where it makes the joint unstable
};

std::array<Summand, 5> summands_of(const StiffnessRow& row) {
  const double lines = row.K_muscle_Nm_rad + row.K_geometry_Nm_rad;
  const double beyond_lines = row.K_schur_Nm_rad - row.K_passive_Nm_rad - row.K_contact_Nm_rad - lines;
  return {{{"the fibres' own stiffness at their moment arms (r^2 k)", row.K_muscle_Nm_rad,
            [](const MusclePart& part) { return part.K_muscle_Nm_rad; },
            "a shorter rest stretch, which brings the fibres back below their optimum length"},
           {"the moment arms that change as the joint rotates (-(dr/dq) F)", row.K_geometry_Nm_rad,
            [](const MusclePart& part) { return part.K_geometry_Nm_rad; },
            "lines that wrap round the bone and keep their moment arms, or a shorter rest stretch, which stiffens the "
            "fibres"},
           {"the bulk of the muscles beyond their lines", beyond_lines,
            [](const MusclePart& part) { return part.K_schur_Nm_rad - part.K_muscle_Nm_rad - part.K_geometry_Nm_rad; },
            "bone and neighbours that hold the bellies in place"},
           {"contact between tissues", row.K_contact_Nm_rad, nullptr, "tissues that touch elsewhere"},
           {"the joint's own spring", row.K_passive_Nm_rad, nullptr, "a stiffer joint"}}};
}

/// The key as words, without the limb that may stand before it.
std::string words_of_key(const std::string& key) {
  std::string words = key.substr(key.find('.') == std::string::npos ? 0 : key.find('.') + 1);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// " (most of it X, 1.2)" of the muscle that pushes furthest in the summand's direction; empty where none does.
std::string leader_text(const StiffnessRow& row, const Summand& summand) {
  if (summand.of_muscle == nullptr || row.muscles.empty()) return "";
  const double sign = summand.K_Nm_rad < 0.0 ? -1.0 : 1.0;
  const auto leader = std::max_element(row.muscles.begin(), row.muscles.end(), [&](const auto& a, const auto& b) {
    return sign * summand.of_muscle(a) < sign * summand.of_muscle(b);
  });
  const double share = summand.of_muscle(*leader);
  if (!(sign * share > 0.0)) return "";
  return fmt::format(" (the {} most: {:+.2f})", words_of_key(leader->muscle), share);
}

std::string balance_text(const StiffnessRow& row, const std::array<Summand, 5>& summands) {
  const auto larger = [](const Summand& a, const Summand& b) { return std::abs(a.K_Nm_rad) < std::abs(b.K_Nm_rad); };
  const Summand& first = *std::max_element(summands.begin(), summands.end(), larger);
  const double sign = first.K_Nm_rad < 0.0 ? 1.0 : -1.0;
  const Summand& against = *std::max_element(summands.begin(), summands.end(), [&](const auto& a, const auto& b) {
    return sign * a.K_Nm_rad < sign * b.K_Nm_rad;
  });
  std::string text = fmt::format("K = {:.2f} N m/rad; its largest part is {}, {:+.2f}{}", row.K_schur_Nm_rad,
                                 first.what, first.K_Nm_rad, leader_text(row, first));
  if (sign * against.K_Nm_rad > 0.0) {
    text += fmt::format("; against it: {}, {:+.2f}{}", against.what, against.K_Nm_rad, leader_text(row, against));
  }
  return text + ".";
}

}  // namespace

std::string explain_stiffness(const StiffnessRow& row) {
  if (!std::isfinite(row.K_schur_Nm_rad)) return "K is not known: the tissue found no equilibrium here.";
  const auto summands = summands_of(row);
  std::string text = balance_text(row, summands);
  if (std::abs(row.K_gravity_Nm_rad) >= kShown_Nm_rad) {
    text += fmt::format(" The weight of the bones, which is not in it, adds {:+.2f}.", row.K_gravity_Nm_rad);
  }
  if (row.K_schur_Nm_rad < 0.0) {
    const Summand& worst = *std::min_element(
        summands.begin(), summands.end(), [](const Summand& a, const Summand& b) { return a.K_Nm_rad < b.K_Nm_rad; });
    text +=
        fmt::format(" The joint is unstable: let go, it leaves this angle. What would change it: {}.", worst.remedy);
  } else if (row.held && row.K_low_Nm_rad < 0.0) {
    text +=
        fmt::format(" Whether it is stable at all is open: the anatomy is known to within {:.2f} .. {:.2f} N m/rad.",
                    row.K_low_Nm_rad, row.K_high_Nm_rad);
  }
  if (!row.stuck_line.empty()) {
    text +=
        fmt::format(" The line of {} cannot clear its wrap surface at this angle: its moment arm is not to be trusted.",
                    row.stuck_line);
  }
  if (!row.converged) text += " Some static solve did not converge: do not quote these figures.";
  if (!row.held) text += " The muscles do not hold the joint at this angle.";
  return text;
}

}  // namespace myotact::measure
