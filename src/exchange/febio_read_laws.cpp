#include "exchange/febio_read_laws.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/text.h"
#include "exchange/febio_laws.h"

namespace myotact::exchange {

namespace {

using namespace simulation;

constexpr double kLargestModulus_Pa = 1e15, kLargestOther = 1e3;

class FebioLawReader {
 public:
  FebioLawReader(bool in_motion, FebioFile& file) : in_motion_(in_motion), file_(file) {}

  FebioReadMaterial read(const pugi::xml_node& material) {
    out_.density_kg_m3 = positive(material, "density", 1.0);
    read_axes(material);
    if (std::string(material.attribute("type").value()) == "solid mixture") {
      for (const pugi::xml_node& part : material.children("solid")) read_part(part);
    } else {
      read_part(material);
    }
    return std::move(out_);
  }

 private:
  double positive(const pugi::xml_node& node, const char* name, std::optional<double> fallback = {},
                  double largest = kLargestModulus_Pa) const {
    const double value = fallback ? file_.value(node, name, *fallback) : file_.value(node, name);
    if (value > 0.0 && value <= largest) return value;
    throw file_.error(node.child(name),
                      fmt::format("is {}; must be > 0 and at most {}", to_text(value), to_text(largest)));
  }
  double not_negative(const pugi::xml_node& node, const char* name, double fallback,
                      double largest = kLargestModulus_Pa) const {
    const double value = file_.value(node, name, fallback);
    if (value >= 0.0 && value <= largest) return value;
    throw file_.error(node.child(name), fmt::format("is {}; must be 0 to {}", to_text(value), to_text(largest)));
  }

  void read_part(const pugi::xml_node& node) {
    using Read = void (FebioLawReader::*)(const pugi::xml_node&);
    static const std::vector<std::pair<std::string, Read>> kTypes = {
        {"neo-Hookean", &FebioLawReader::neo_hookean},
        {"Mooney-Rivlin", &FebioLawReader::mooney_rivlin},
        {"hyperelastic", &FebioLawReader::hyperelastic},
        {"muscle material", &FebioLawReader::muscle},
        {"tendon material", &FebioLawReader::tendon},
        {"trans iso Mooney-Rivlin", &FebioLawReader::trans_iso},
        {"coupled trans-iso Mooney-Rivlin", &FebioLawReader::coupled},
        {"active fiber stress", &FebioLawReader::active_fibre},
        {"prescribed uniaxial active contraction", &FebioLawReader::uniaxial},
        {"prescribed isotropic active contraction", &FebioLawReader::isotropic}};
    const std::string type = node.attribute("type").value();
    for (const auto& [name, read] : kTypes) {
      if (name != type) continue;
      if (read_axes(node)) (this->*read)(node);
      return;
    }
    file_.cannot(node, fmt::format("of the type \"{}\"", type));
  }

  /// <fiber> and <mat_axis>; false where they are given in a way that is not read.
  bool read_axes(const pugi::xml_node& node) {
    if (const pugi::xml_node fiber = node.child("fiber")) {
      const std::string type = fiber.attribute("type").value();
      const pugi::xml_node vector = fiber.child("vector");
      if (type != "vector") {
        file_.cannot(fiber, fmt::format("of the type \"{}\" (\"vector\" is read, and axes of each element)", type));
        return false;
      }
      const bool plain = !vector && std::string(fiber.child_value()).find_first_not_of(" \t\r\n") == std::string::npos;
      return take_fibre(fiber, plain ? Vec3(Vec3::UnitX()) : file_.vector(vector ? vector : fiber));
    }
    const pugi::xml_node axes = node.child("mat_axis");
    if (!axes) return true;
    const std::string type = axes.attribute("type").value();
    if (type == "vector") return take_fibre(axes, file_.vector(file_.child(axes, "a")));
    if (type == "angles") {
      const double degree = std::numbers::pi / 180.0;
      const double theta = degree * file_.value(axes, "theta", 0.0), phi = degree * file_.value(axes, "phi", 0.0);
      return take_fibre(axes, {std::cos(theta) * std::sin(phi), std::sin(theta) * std::sin(phi), std::cos(phi)});
    }
    file_.cannot(axes, fmt::format("of the type \"{}\" (\"vector\" and \"angles\" are read)", type));
    return false;
  }

  bool take_fibre(const pugi::xml_node& node, const Vec3& direction) {
    const double length = direction.stableNorm();
    if (!(length > 0.0 && std::isfinite(length))) throw file_.error(node, "has no direction; must be longer than 0");
    const Vec3 fibre = direction / length;
    if (out_.fibre && !out_.fibre->isApprox(fibre, 1e-9)) {
      file_.cannot(node, "with another direction than the rest of the material's");
      return false;
    }
    out_.fibre = fibre;
    return true;
  }

  /// One activation drives all fibres.
  void take_activation(const pugi::xml_node& node, const char* name) {
    const pugi::xml_node child = node.child(name);
    const double activation = not_negative(node, name, 0.0, 1.0);
    if (out_.activation && *out_.activation != activation) {
      throw file_.error(child, fmt::format("is {} at the end, but another fibre of the material has {}; one is read",
                                           to_text(activation), to_text(*out_.activation)));
    }
    out_.activation = activation;
    if (in_motion_ && child) out_.rise_s = file_.rise_s(child);
  }

  void neo_hookean(const pugi::xml_node& node) {
    const double young_Pa = positive(node, "E"), nu = file_.value(node, "v");
    if (!(nu > -1.0 && nu < 0.5)) {
      throw file_.error(node.child("v"), fmt::format("is {}; must be > -1 and < 0.5", to_text(nu)));
    }
    out_.laws.push_back(NeoHookean{young_Pa / (2.0 * (1.0 + nu)), young_Pa * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))});
  }

  /// Other ways of the volume term are not read.
  bool knows_pressure(const pugi::xml_node& node) {
    const std::string model = lower(node.child_value("pressure_model"));
    if (model.empty() || model == "default" || model == "0") return true;
    file_.cannot(node.child("pressure_model"), fmt::format("\"{}\"", model));
    return false;
  }

  void mooney_rivlin(const pugi::xml_node& node) {
    if (!knows_pressure(node)) return;
    out_.laws.push_back(MooneyRivlin{positive(node, "c1"), not_negative(node, "c2", 0.0), positive(node, "k")});
  }

  /// Half the shear term, half the volume term and the rest ratio stand in a row; only the energy that they make again
  /// is known.
  void hyperelastic(const pugi::xml_node& node) {
    const std::string energy = node.child_value("W");
    const std::size_t star = energy.find('*'), plus = energy.find(")+"), minus = energy.rfind("(J-");
    if (star != std::string::npos && plus != std::string::npos && minus != std::string::npos && minus > plus) {
      const auto shear = parse_number(energy.substr(0, star));
      const std::size_t times = energy.find('*', plus + 1);
      const auto volume = parse_number(energy.substr(plus + 2, std::max(times, plus + 2) - plus - 2));
      if (shear && volume && std::isfinite(*shear) && std::isfinite(*volume) && *shear > 0.0) {
        const double shear_Pa = 1.5 * *shear;
        const StableNeoHookean matrix{shear_Pa, 2.0 * *volume - 5.0 / 6.0 * shear_Pa};
        if (same_energy(febio_energy(matrix), energy)) {
          out_.laws.push_back(matrix);
          return;
        }
      }
    }
    file_.cannot(node, "with an energy that is not that of a stable neo-Hookean solid");
  }

  /// The last digit may differ.
  static bool same_energy(std::string a, std::string b) {
    const auto split = [](std::string& text) {
      std::vector<double> numbers;
      std::string rest;
      for (std::size_t k = 0; k < text.size();) {
        const std::size_t end = std::min(text.find_first_not_of("0123456789.e+-", k), text.size());
        const bool digit = text[k] >= '0' && text[k] <= '9';
        const auto number = digit ? longest_number(text, k, end) : std::nullopt;
        if (number) {
          numbers.push_back(number->first);
          k = number->second;
        } else {
          rest += text[k++];
        }
      }
      text = rest;
      return numbers;
    };
    const std::vector<double> of_a = split(a), of_b = split(b);
    if (a != b || of_a.size() != of_b.size()) return false;
    for (std::size_t k = 0; k < of_a.size(); ++k) {
      if (std::abs(of_a[k] - of_b[k]) > 1e-12 * std::abs(of_a[k])) return false;
    }
    return true;
  }

  /// The number that begins at `from`, and where it ends.
  static std::optional<std::pair<double, std::size_t>> longest_number(const std::string& text, std::size_t from,
                                                                      std::size_t end) {
    for (std::size_t to = end; to > from; --to) {
      if (const auto number = parse_number(std::string_view(text).substr(from, to - from))) return {{*number, to}};
    }
    return std::nullopt;
  }

  void muscle(const pugi::xml_node& node) {
    if (!knows_pressure(node)) return;
    if (file_.value(node, "g3", 0.0) != 0.0) return file_.cannot(node.child("g3"), "other than 0");
    BlemkerMuscle<BlemkerFibre> law;
    law.along_Pa = positive(node, "g1");
    law.across_Pa = positive(node, "g2");
    law.bulk_Pa = positive(node, "k");
    law.curve.toe = not_negative(node, "p1", 0.0, kLargestOther);
    law.curve.exponent = positive(node, "p2", {}, kLargestOther);
    law.curve.optimal_stretch = positive(node, "Lofl", {}, kLargestOther);
    law.curve.peak_Pa = positive(node, "smax");
    law.curve.straight = positive(node, "lam_max", {}, kLargestOther) / law.curve.optimal_stretch;
    take_activation(node, "activation");
    out_.follows_axes = true;
    out_.laws.push_back(law);
  }

  void tendon(const pugi::xml_node& node) {
    if (!knows_pressure(node)) return;
    BlemkerMuscle<ExponentialFibre> law;
    law.along_Pa = positive(node, "g1");
    law.across_Pa = positive(node, "g2");
    law.bulk_Pa = positive(node, "k");
    law.curve.toe_Pa = positive(node, "l1");
    law.curve.exponent = positive(node, "l2", {}, kLargestOther);
    law.curve.straight = positive(node, "lam_max", {}, kLargestOther);
    out_.follows_axes = true;
    out_.laws.push_back(law);
  }

  ExponentialFibre exponential(const pugi::xml_node& node) {
    out_.follows_axes = true;
    ExponentialFibre fibre;
    fibre.toe_Pa = positive(node, "c3");
    fibre.exponent = positive(node, "c4", {}, kLargestOther);
    fibre.straight = positive(node, "lam_max", {}, kLargestOther);
    fibre.straight_Pa = not_negative(node, "c5", 0.0);
    return fibre;
  }

  void trans_iso(const pugi::xml_node& node) {
    if (!knows_pressure(node)) return;
    mooney_rivlin(node);
    if (file_.value(node, "c3", 0.0) > 0.0) out_.laws.push_back(IsochoricFibres<ExponentialFibre>{exponential(node)});
    const pugi::xml_node active = node.child("active_contraction");
    if (!active) return;
    CalciumTension tension;
    tension.calcium = positive(active, "ca0", {}, kLargestOther);
    const double most = not_negative(active, "camax", 0.0, kLargestOther);
    tension.largest_calcium = most > 0.0 ? most : tension.calcium;  // FEBio's way to say that they are the same
    tension.largest_Pa = positive(active, "Tmax", 1.0);
    tension.steepness_1_um = positive(active, "beta", {}, kLargestOther);
    tension.shortest_um = positive(active, "l0", {}, kLargestOther);
    tension.reference_um = positive(active, "refl", {}, kLargestOther);
    take_activation(active, "ascl");
    out_.follows_axes = true;
    out_.laws.push_back(UnsplitFibres<CalciumTension>{tension});
  }

  void coupled(const pugi::xml_node& node) {
    if (file_.value(node, "c2", 0.0) != 0.0) return file_.cannot(node.child("c2"), "other than 0 in a coupled law");
    out_.laws.push_back(NeoHookean{2.0 * positive(node, "c1"), positive(node, "k")});
    if (file_.value(node, "c3", 0.0) > 0.0) out_.laws.push_back(UnsplitFibres<ExponentialFibre>{exponential(node)});
  }

  /// Of the two halves that were written for one fibre, the active one is taken.
  void active_fibre(const pugi::xml_node& node) {
    const std::string name = node.attribute("name").value();
    const auto words = words_of(name);
    const auto number = [&](std::size_t word, const char* key) {
      return named_number(node, std::string(words[word]), std::string(key) + "=");
    };
    const auto curves = words.size() == 5 && words[1] == "muscle_fibre" ? find_curve_set(words[2]) : std::nullopt;
    if (curves) {
      MuscleFibre fibre{positive(node, "smax"), number(3, "rest_length"), number(4, "gain"), *curves};
      take_fibres(node, fibre, words[0] == "active");
    } else if (words.size() == 6 && words[1] == "posed_fibre") {
      PosedFibre fibre{positive(node, "smax"), number(2, "active"), number(3, "active_slope"),
                       number(4, "passive_length"), number(5, "gain")};
      take_fibres(node, fibre, words[0] == "active");
    } else {
      file_.cannot(node, "that is not named as a fibre of Myotact: other tables of tension are not read");
    }
  }

  template <class Fibre>
  void take_fibres(const pugi::xml_node& node, const Fibre& fibre, bool active) {
    check_table(node, febio_fibre_table(fibre, active));
    if (!active) return;
    take_activation(node, "activation");
    out_.follows_axes = true;
    out_.laws.push_back(UnsplitFibres<Fibre>{fibre});
  }

  double named_number(const pugi::xml_node& node, const std::string& word, const std::string& key) const {
    const auto number = word.starts_with(key) ? parse_number(word.substr(key.size())) : std::nullopt;
    if (number && std::abs(*number) <= kLargestOther) return *number;
    throw file_.error(
        node, fmt::format("is named \"{}\" where {}NUMBER must stand, at most {}", word, key, to_text(kLargestOther)));
  }

  /// A table that somebody changed is no longer what its name says.
  void check_table(const pugi::xml_node& node, const std::string& wanted) const {
    std::string found = "<interpolate>LINEAR</interpolate>\n<extend>EXTRAPOLATE</extend>\n<points>\n";
    for (const pugi::xml_node& point : node.child("stl").child("points").children("pt")) {
      found += fmt::format("<pt>{}</pt>\n", point.child_value());
    }
    if (found + "</points>\n" == wanted) return;
    throw file_.error(node, "has a table <stl> that its name does not describe; export it again, or take it out");
  }

  void uniaxial(const pugi::xml_node& node) {
    const double tension_Pa = not_negative(node, "T0", 0.0);
    out_.follows_axes = true;
    if (tension_Pa > 0.0) out_.laws.push_back(UnsplitFibres<ConstantTension>{{tension_Pa}});
  }

  void isotropic(const pugi::xml_node& node) {
    const double tension_Pa = not_negative(node, "T0", 0.0);
    if (tension_Pa > 0.0) out_.laws.push_back(IsotropicTension{tension_Pa});
  }

  bool in_motion_;
  FebioFile& file_;
  FebioReadMaterial out_;
};

}  // namespace

FebioReadMaterial read_febio_material(const pugi::xml_node& material, bool in_motion, FebioFile& file) {
  return FebioLawReader(in_motion, file).read(material);
}

}  // namespace myotact::exchange
