#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/at.h"
#include "core/dense_matrix.h"
#include "core/text.h"
#include "measure/case_materials.h"
#include "measure/fit/fit_kinds.h"
#include "measure/fit/indentation_mesh.h"
#include "measure/solve_answer.h"

// Force of a ball or a flat punch against its depth in a block on a plate, by finite elements.
//
//   |  d   |      A contact of radius a: its nodes are moved down to the indenter's shape, whatever pulls there. At a
//   \_____/       given depth the true contact is the one that presses hardest: there no pressure is left at the edge,
//  --- a ----     so that what a is off by counts twice only as its square: a is found once, at the start values.
//
// Forces are solved at a few depths; between them F/d^m is a polynomial, m = 1 of a punch and 3/2 of a ball.

namespace myotact::measure {

namespace {

constexpr int kIndentationDepths = 3;

enum class IndenterShape { Ball, Punch };

/// Geometry of the measurement; no parameter changes it.
struct Indentation {
  IndentedBlock block;
  IndenterShape shape = IndenterShape::Ball;
  double radius_m = 0.0;
  bool sticks = false;  // the surface to the indenter

  double exponent() const { return shape == IndenterShape::Ball ? 1.5 : 1.0; }
  /// How much higher the indenter is there than in the middle.
  double height_m(double r_m) const {
    return shape == IndenterShape::Punch ? 0.0 : radius_m - std::sqrt(std::max(0.0, radius_m * radius_m - r_m * r_m));
  }
  double largest_contact_m() const {
    return shape == IndenterShape::Punch ? radius_m : std::min(0.9 * radius_m, 0.4 * block.width_m);
  }
};

Indentation read_indentation(const JsonValue& value) {
  constexpr double kSmallest_m = 1e-5, kLargest_m = 1.0;
  JsonObject fields(value);
  Indentation out;
  JsonObject block(fields.at("block"));
  out.block.width_m = block.at("width_m").number_between(kSmallest_m, kLargest_m);
  out.block.thickness_m = block.at("thickness_m").number_between(kSmallest_m, kLargest_m);
  if (const auto cells = block.find("cells")) out.block.cells = cells->integer_between(2, 12);
  block.finish();
  JsonObject indenter(fields.at("indenter"));
  out.shape = indenter.at("shape").one_of({"sphere", "punch"}) == "punch" ? IndenterShape::Punch : IndenterShape::Ball;
  const JsonValue radius = indenter.at("radius_m");
  out.radius_m = radius.number_between(kSmallest_m, kLargest_m);
  if (out.shape == IndenterShape::Punch && out.radius_m > 0.4 * out.block.width_m) {
    throw radius.error(fmt::format("is {}; must be at most 0.4 of the block's width, {}", to_text(out.radius_m),
                                   to_text(0.4 * out.block.width_m)));
  }
  indenter.finish();
  if (const auto friction = fields.find("friction")) out.sticks = friction->one_of({"none", "full"}) == "full";
  fields.find("materials");
  fields.finish();
  return out;
}

nlohmann::json indentation_model(const JsonValue& value, const std::filesystem::path& folder) {
  const auto [json, file] = model_or_file(value, folder);
  read_indentation(JsonValue(json, file));
  JsonObject(JsonValue(json, file)).at("materials");
  return json;
}

nlohmann::json indentation_setting(JsonObject&, const nlohmann::json& model, FitCurve& curve) {
  const Indentation indentation = read_indentation(JsonValue(model, "model"));
  const double deepest_m = *std::max_element(curve.x.begin(), curve.x.end());
  const double least_m = *std::min_element(curve.x.begin(), curve.x.end());
  if (!(least_m >= 0.0 && deepest_m > 0.0 && deepest_m <= 0.5 * indentation.block.thickness_m)) {
    throw bad_data(
        curve.file, "",
        fmt::format("has depths from {} to {} m; must lie between 0, where the indenter touches, and half of "
                    "the block's thickness, {}",
                    to_text(least_m), to_text(deepest_m), to_text(0.5 * indentation.block.thickness_m)));
  }
  curve.x_name = "depth_m";
  return nlohmann::json::object();
}

/// How much farther than the circle its corners must lie for a polygon of the mesh to have the circle's area.
double corner_share(int cells) {
  const double half_rad = std::numbers::pi / (8.0 * cells);
  return std::sqrt(half_rad / (std::sin(half_rad) * std::cos(half_rad)));
}

using HeldComponents = std::map<std::pair<int, int>, double>;

HeldComponents held_of(const Indentation& indentation, const geometry::TetMesh& mesh, double contact_m,
                       double depth_m) {
  HeldComponents held;
  for (int n = 0; n < static_cast<int>(mesh.nodes_m.size()); ++n) {
    const Vec3& p = mesh.nodes_m[at(n)];
    if (p.x() == 0.0) held[{n, 0}] = 0.0;
    if (p.y() == 0.0) held[{n, 1}] = 0.0;
    const bool pressed = is_pressed(p, indentation.block, contact_m);
    for (int c = 0; c < 3; ++c) {
      if (p.z() == 0.0 || (pressed && indentation.sticks)) held[{n, c}] = 0.0;
    }
    if (pressed) held[{n, 2}] = -(depth_m - indentation.height_m(std::hypot(p.x(), p.y())));
  }
  return held;
}

/// Force of the indenter on a block of such materials.
double pressed_force_N(const Indentation& indentation, const JsonValue& materials, double contact_m, double depth_m) {
  const double corners_m = contact_m * corner_share(indentation.block.cells);
  SolveCase input;
  input.name = "indentation";
  input.element = Element::T10;
  input.mesh.file = materials.file();
  input.mesh.mesh = geometry::make_quadratic(indented_mesh(indentation.block, corners_m));
  input.mesh.regions.assign(input.mesh.mesh.corners.size(), 0);
  read_materials(materials, input);
  for (const auto& [place, moved_m] : held_of(indentation, input.mesh.mesh, corners_m, depth_m)) {
    input.loads.held.push_back({place.first, place.second, moved_m});
  }
  input.tolerance = 1e-9;  // derivatives are differences of forces that differ by a ten-thousandth
  CaseOutput reaction;
  reaction.quantity = Quantity::Reaction;
  reaction.reduce = Reduction::Sum;
  for (int n = 0; n < static_cast<int>(input.mesh.mesh.nodes_m.size()); ++n) {
    if (is_pressed(input.mesh.mesh.nodes_m[at(n)], indentation.block, corners_m)) reaction.nodes.push_back(n);
  }
  input.outputs = {reaction};
  const SolveAnswer answer = solve_case(input, [](const SolveProgress&) {});
  if (!answer.converged) {
    throw materials.error(
        fmt::format("no equilibrium at a depth of {} m; measure less deep, or take a softer law", to_text(depth_m)));
  }
  return -4.0 * answer.outputs.front().second[2];  // of a quarter
}

/// Where a parabola through three places of rising x is highest, within them.
double highest_place(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  const double left = (y[1] - y[0]) / (x[1] - x[0]), right = (y[2] - y[1]) / (x[2] - x[1]);
  const double bend = (right - left) / (x[2] - x[0]);
  if (!(bend < 0.0)) return y[2] > y[0] ? x[2] : x[0];
  return std::clamp(0.5 * (x[0] + x[1]) - 0.5 * left / bend, x[0], x[2]);
}

/// The contact's radius at a depth, of the force's maximum. A ball in a half-space has a^2 = R d.
double contact_radius_m(const Indentation& indentation, const JsonValue& materials, double depth_m) {
  if (indentation.shape == IndenterShape::Punch) return indentation.radius_m;
  constexpr double kFactor = 1.35;
  constexpr int kMostShifts = 4;
  const double hertz_m2 = indentation.radius_m * depth_m, most_m2 = std::pow(indentation.largest_contact_m(), 2);
  std::array<double, 3> area = {hertz_m2 / kFactor, hertz_m2, hertz_m2 * kFactor}, force{};
  for (double& a : area) a = std::min(a, most_m2);
  if (area[1] >= most_m2) {
    throw materials.error(
        fmt::format("a ball of radius {} m at a depth of {} m touches too much of the block; measure "
                    "less deep, or give a wider block",
                    to_text(indentation.radius_m), to_text(depth_m)));
  }
  const auto force_at = [&](double area_m2) {
    return pressed_force_N(indentation, materials, std::sqrt(area_m2), depth_m);
  };
  for (std::size_t i = 0; i < 3; ++i) force[i] = force_at(area[i]);
  for (int shift = 0; shift < kMostShifts && force[2] > force[1] && area[2] * kFactor <= most_m2; ++shift) {
    area = {area[1], area[2], area[2] * kFactor};
    force = {force[1], force[2], force_at(area[2])};
  }
  return std::sqrt(highest_place(area, force));
}

/// A few depths of all curves, and what their contacts are.
struct IndentationPlan {
  Indentation indentation;
  std::vector<double> depth_m, contact_m;
};

IndentationPlan plan_indentation(const FitProblem& problem, const nlohmann::json& start) {
  IndentationPlan plan{read_indentation(JsonValue(start, problem.file, "/model")), {}, {}};
  double deepest_m = 0.0;
  for (const FitCurve& curve : problem.curves) {
    deepest_m = std::max(deepest_m, *std::max_element(curve.x.begin(), curve.x.end()));
  }
  const JsonValue materials(start.at("materials"), problem.file, "/model/materials");
  for (int k = 1; k <= kIndentationDepths; ++k) {
    plan.depth_m.push_back(deepest_m * k / kIndentationDepths);
    plan.contact_m.push_back(contact_radius_m(plan.indentation, materials, plan.depth_m.back()));
  }
  return plan;
}

/// Coefficients of F / d^m in powers of d / deepest.
Eigen::VectorXd force_polynomial(const IndentationPlan& plan, const JsonValue& materials) {
  Eigen::MatrixXd powers(kIndentationDepths, kIndentationDepths);
  Eigen::MatrixXd force(kIndentationDepths, 1);
  for (int k = 0; k < kIndentationDepths; ++k) {
    const double depth_m = plan.depth_m[at(k)], share = depth_m / plan.depth_m.back();
    for (int p = 0; p < kIndentationDepths; ++p) powers(k, p) = std::pow(share, p);
    force(k, 0) = pressed_force_N(plan.indentation, materials, plan.contact_m[at(k)], depth_m) /
                  std::pow(share, plan.indentation.exponent());
  }
  return solve_dense(powers, force).col(0);
}

void predict_indentation(FitProblem& problem) {
  std::vector<double> starts;
  for (const FitParameter& parameter : problem.parameters) starts.push_back(parameter.range.start);
  const IndentationPlan plan = plan_indentation(problem, model_with(problem, starts));
  problem.blind_share = 1e-3;
  problem.predict = [plan, curves = problem.curves, file = problem.file](const nlohmann::json& model) {
    const Eigen::VectorXd polynomial =
        force_polynomial(plan, JsonValue(model.at("materials"), file, "/model/materials"));
    std::vector<double> force_N;
    for (const FitCurve& curve : curves) {
      for (const double depth_m : curve.x) {
        const double share = depth_m / plan.depth_m.back();
        double sum = 0.0;
        for (Eigen::Index p = polynomial.size(); p-- > 0;) sum = sum * share + polynomial[p];
        force_N.push_back(sum * std::pow(share, plan.indentation.exponent()));
      }
    }
    return force_N;
  };
}

}  // namespace

FitKind indentation_kind() {
  return {"indentation",
          {"depth of the indenter", {{"depth_m", 1.0}, {"depth_mm", 1e-3}}},
          {"force", {{"force_N", 1.0}, {"force_mN", 1e-3}}},
          indentation_model,
          indentation_setting,
          predict_indentation};
}

}  // namespace myotact::measure
