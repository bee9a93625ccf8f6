#include "exchange/febio_laws.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace myotact::exchange {

namespace {

using namespace simulation;

/// Tables of fibres: linear between their points, so the error is the square of the step times an eighth of the
/// curvature, 3e-4 of the peak for fibres that run through the whole muscle and 1e-3 for ones a third as long.
constexpr double kTableStep = 0.0025, kTableFrom = 0.3, kTableTo = 2.0;

template <class T>
const T* law_in(const std::vector<Law>& laws) {
  const auto found =
      std::find_if(laws.begin(), laws.end(), [](const Law& law) { return std::holds_alternative<T>(law); });
  return found == laws.end() ? nullptr : &std::get<T>(*found);
}

std::string element(const char* name, double value) {
  return fmt::format("<{}>{}</{}>\n", name, to_text(value), name);
}
std::string raised_element(const char* name, double value) {
  return fmt::format("<{} lc=\"1\">{}</{}>\n", name, to_text(value), name);
}

/// Young's modulus and Poisson's ratio of Lame's.
std::string young_of(double shear_Pa, double lambda_Pa) {
  return element("E", shear_Pa * (3.0 * lambda_Pa + 2.0 * shear_Pa) / (lambda_Pa + shear_Pa)) +
         element("v", 0.5 * lambda_Pa / (lambda_Pa + shear_Pa));
}

/// Every tet has its own axes, whose first one is the fibre.
constexpr const char* kAlongFirstAxis = "<fiber type=\"vector\"><vector>1,0,0</vector></fiber>\n";

std::string exponential_text(const ExponentialFibre& fibre) {
  const double end_Pa = fibre.toe_Pa * fibre.exponent * std::exp(fibre.exponent * (fibre.straight - 1.0));
  return element("c3", fibre.toe_Pa) + element("c4", fibre.exponent) +
         element("c5", fibre.straight_Pa > 0.0 ? fibre.straight_Pa : end_Pa) + element("lam_max", fibre.straight);
}

/// Nominal stress along a stretch while the sides are held.
double held_stress_Pa(const Law& law, double stretch) {
  return std::visit(
      [stretch](const auto& matrix) {
        const Point<double> point = make_point<double>({stretch, 0, 0, 0, 1, 0, 0, 0, 1}, {});
        Response<double> response;
        matrix.template add<double>(point, 0.0, response);
        return response.P[0] + matrix.template volume<double>(point.J).slope_Pa * point.cofactor[0];
      },
      law);
}

/// One material or part of a mixture.
struct FebioPart {
  std::string type, content, name;
};

/// What becomes of one law that stands for itself.
class PartsOf {
 public:
  PartsOf(double activation, FebioMaterial& out) : activation_(activation), out_(out) {}

  std::vector<FebioPart> operator()(const NeoHookean& law) const {
    return {{"neo-Hookean", young_of(law.shear_Pa, law.lambda_Pa), ""}};
  }
  std::vector<FebioPart> operator()(const Corotated& law) const {
    const NeoHookean like{law.shear_Pa, law.lambda_Pa};
    out_.notes.push_back(fmt::format(
        "corotated has no like in FEBio; the nearest, neo-Hookean of the same moduli, is the same at rest only: held "
        "at "
        "the sides it bears {} Pa at a stretch of 0.9 where corotated bears {}, and {} Pa at 1.1 where it bears {}",
        to_text(held_stress_Pa(like, 0.9)), to_text(held_stress_Pa(law, 0.9)), to_text(held_stress_Pa(like, 1.1)),
        to_text(held_stress_Pa(law, 1.1))));
    return (*this)(like);
  }
  std::vector<FebioPart> operator()(const StableNeoHookean& law) const {
    return {{"hyperelastic", "<W>" + febio_energy(law) + "</W>\n", ""}};
  }
  std::vector<FebioPart> operator()(const MooneyRivlin& law) const {
    return {{"Mooney-Rivlin", element("c1", law.c1_Pa) + element("c2", law.c2_Pa) + element("k", law.bulk_Pa), ""}};
  }
  std::vector<FebioPart> operator()(const BlemkerMuscle<BlemkerFibre>& law) const {
    const BlemkerFibre& fibre = law.curve;
    return {{"muscle material",
             element("k", law.bulk_Pa) + element("g1", law.along_Pa) + element("g2", law.across_Pa) +
                 element("g3", 0.0) + element("p1", fibre.toe) + element("p2", fibre.exponent) +
                 element("Lofl", fibre.optimal_stretch) + element("smax", fibre.peak_Pa) +
                 element("lam_max", fibre.straight * fibre.optimal_stretch) +
                 raised_element("activation", activation_) + kAlongFirstAxis,
             ""}};
  }
  std::vector<FebioPart> operator()(const BlemkerMuscle<ExponentialFibre>& law) const {
    if (law.curve.straight_Pa > 0.0) return {};  // FEBio's goes on without a kink
    return {{"tendon material",
             element("k", law.bulk_Pa) + element("g1", law.along_Pa) + element("g2", law.across_Pa) +
                 element("l1", law.curve.toe_Pa) + element("l2", law.curve.exponent) +
                 element("lam_max", law.curve.straight) + kAlongFirstAxis,
             ""}};
  }
  std::vector<FebioPart> operator()(const UnsplitFibres<MuscleFibre>& law) const { return tabled(law.curve); }
  std::vector<FebioPart> operator()(const UnsplitFibres<PosedFibre>& law) const { return tabled(law.curve); }
  std::vector<FebioPart> operator()(const UnsplitFibres<ConstantTension>& law) const {
    return {{"prescribed uniaxial active contraction", raised_element("T0", activation_ * law.curve.tension_Pa), ""}};
  }
  std::vector<FebioPart> operator()(const IsotropicTension& law) const {
    return {{"prescribed isotropic active contraction", raised_element("T0", activation_ * law.tension_Pa), ""}};
  }
  template <class Other>
  std::vector<FebioPart> operator()(const Other& /*law*/) const {
    return {};
  }

 private:
  /// Passive and active fibres, each with a table of its own.
  template <class Fibre>
  std::vector<FebioPart> tabled(const Fibre& fibre) const {
    const std::string name = febio_fibre_name(fibre), smax = element("smax", fibre.peak_Pa);
    const auto table = [&](bool active) {
      return "<stl type=\"point\">\n" + febio_fibre_table(fibre, active) + "</stl>\n";
    };
    return {{"active fiber stress", smax + element("activation", 1.0) + table(false), "passive " + name},
            {"active fiber stress", smax + raised_element("activation", activation_) + table(true), "active " + name}};
  }

  double activation_;
  FebioMaterial& out_;
};

/// Laws that have a name together.
std::vector<FebioPart> named_together(const std::vector<Law>& laws, double activation, FebioMaterial& out) {
  const auto* uncoupled = law_in<MooneyRivlin>(laws);
  const auto* isochoric = law_in<IsochoricFibres<ExponentialFibre>>(laws);
  const auto* calcium = law_in<UnsplitFibres<CalciumTension>>(laws);
  if (uncoupled && isochoric && laws.size() == (calcium ? 3u : 2u)) {
    std::string text = element("k", uncoupled->bulk_Pa) + element("c1", uncoupled->c1_Pa) +
                       element("c2", uncoupled->c2_Pa) + exponential_text(isochoric->curve) + kAlongFirstAxis;
    if (calcium) {
      const CalciumTension& c = calcium->curve;
      text += "<active_contraction type=\"active_contraction\">\n" + raised_element("ascl", activation) +
              element("Tmax", c.largest_Pa) + element("ca0", c.calcium) + element("camax", c.largest_calcium) +
              element("beta", c.steepness_1_um) + element("l0", c.shortest_um) + element("refl", c.reference_um) +
              "</active_contraction>\n";
      out.notes.emplace_back(
          "calcium_tension: the tension is Cauchy stress in FEBio and goes by the isochoric stretch; "
          "here the volume ratio in it is the number 1, which differs by about J - 1");
    }
    return {{"trans iso Mooney-Rivlin", text, ""}};
  }
  const auto* coupled = law_in<NeoHookean>(laws);
  const auto* unsplit = law_in<UnsplitFibres<ExponentialFibre>>(laws);
  if (coupled && unsplit && laws.size() == 2) {
    return {{"coupled trans-iso Mooney-Rivlin",
             element("c1", 0.5 * coupled->shear_Pa) + element("c2", 0.0) + exponential_text(unsplit->curve) +
                 element("k", coupled->lambda_Pa) + kAlongFirstAxis,
             ""}};
  }
  return {};
}

/// All laws one by one; a mixture adds them up.
std::vector<FebioPart> each_for_itself(const std::vector<Law>& laws, const std::string& name, double activation,
                                       FebioMaterial& out) {
  std::vector<FebioPart> parts;
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const std::vector<FebioPart> more = std::visit(PartsOf(activation, out), laws[k]);
    if (more.empty()) {
      throw Error(ExitStatus::BadData,
                  fmt::format("{}: law {} of the region has no like in FEBio where it stands; what has: neo_hookean, "
                              "mooney_rivlin, stable_neo_hookean, blemker_muscle, blemker_tendon without a kink, "
                              "mooney_rivlin with isochoric_exponential_fibre and calcium_tension, neo_hookean with "
                              "exponential_fibre, muscle_fibre, fibre_tension, isotropic_tension",
                              name, k + 1));
    }
    parts.insert(parts.end(), more.begin(), more.end());
  }
  return parts;
}

template <class Fibre>
std::string fibre_points(Fibre fibre, bool active) {
  fibre.peak_Pa = 1.0;
  std::string text = "<interpolate>LINEAR</interpolate>\n<extend>EXTRAPOLATE</extend>\n<points>\n";
  const int points = static_cast<int>(std::lround((kTableTo - kTableFrom) / kTableStep));
  for (int k = 0; k <= points; ++k) {
    const double stretch = kTableFrom + k * kTableStep;
    const double passive = fibre.at(stretch, 0.0).stress_Pa;
    const double value = active ? fibre.at(stretch, 1.0).stress_Pa - passive : passive;
    text += fmt::format("<pt>{:.6g},{:.9g}</pt>\n", stretch, stretch * value);
  }
  return text + "</points>\n";
}

std::string named(const FebioPart& part) {
  return part.name.empty() ? "" : fmt::format(" name=\"{}\"", escape_markup(part.name));
}

}  // namespace

std::string febio_fibre_name(const MuscleFibre& fibre) {
  return fmt::format("muscle_fibre {} rest_length={} gain={}",
                     curve_set_names()[static_cast<std::size_t>(fibre.curves)], to_text(fibre.rest_length),
                     to_text(fibre.gain));
}

std::string febio_fibre_name(const PosedFibre& fibre) {
  return fmt::format("posed_fibre active={} active_slope={} passive_length={} gain={}", to_text(fibre.active),
                     to_text(fibre.active_slope), to_text(fibre.passive_length), to_text(fibre.gain));
}

std::string febio_fibre_table(const MuscleFibre& fibre, bool active) {
  return fibre_points(fibre, active);
}

std::string febio_fibre_table(const PosedFibre& fibre, bool active) {
  return fibre_points(fibre, active);
}

std::string febio_energy(const StableNeoHookean& matrix) {
  const std::string half = to_text(0.5 * matrix.shear_term_Pa());
  return fmt::format("{}*(I1-3)-{}*ln(I1+1)+{}*(J-{})^2", half, half, to_text(0.5 * matrix.volume_term_Pa()),
                     to_text(matrix.rest_ratio()));
}

FebioMaterial febio_material(const measure::CaseMaterial& material, const std::string& name, int id,
                             double activation) {
  FebioMaterial out;
  std::vector<FebioPart> parts = named_together(material.laws, activation, out);
  if (parts.empty()) parts = each_for_itself(material.laws, name, activation, out);
  const std::string density = material.density_kg_m3 ? element("density", *material.density_kg_m3) : "";
  if (parts.size() == 1) {
    out.text = fmt::format("<material id=\"{}\" name=\"{}\" type=\"{}\">\n{}{}</material>\n", id, name, parts[0].type,
                           density, parts[0].content);
    return out;
  }
  out.text = fmt::format("<material id=\"{}\" name=\"{}\" type=\"solid mixture\">\n{}", id, name, density);
  for (const FebioPart& part : parts) {
    out.text += fmt::format("<solid{} type=\"{}\">\n{}</solid>\n", named(part), part.type, part.content);
  }
  out.text += "</material>\n";
  return out;
}

}  // namespace myotact::exchange
