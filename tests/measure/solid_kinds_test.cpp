#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "measure/validation/nested_muscle.h"
#include "measure/validation/solid_inputs.h"
#include "support/complaint.h"

namespace myotact::measure {
namespace {

using myotact::testing::complaint;
using ::testing::HasSubstr;

Quantities run_kind(const std::string& name, const std::string& inputs) {
  const auto& kinds = validation_kinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == name; });
  if (kind == kinds.end()) throw std::runtime_error("no kind " + name);
  const nlohmann::json json = parse_json(inputs, "inputs");
  JsonObject object(JsonValue(json, "inputs"));
  Quantities quantities = kind->run(object);
  object.finish();
  return quantities;
}

TEST(BoxMesh, FillsTheBoxWithOrWithoutMirrors) {
  for (const bool mirrored : {true, false}) {
    const Box box{{0.3, 0.2, 0.1}, {3, 2, 2}, mirrored};
    geometry::TetMesh mesh = make_box(box);
    shake_inside(box, 0.25, mesh);
    EXPECT_EQ(mesh.corners.size(), 72U);
    EXPECT_NEAR(geometry::total_volume_m3(mesh), 0.006, 1e-15);
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) EXPECT_GT(geometry::corner_volume_m3(mesh, t), 0.0);
  }
}

TEST(SolidInputs, RefuseUnknownLawsAndKeysOfLaws) {
  const std::string start = R"({"size_m": [1, 1, 1], "cells": [1, 1, 1], "element": "linear", "state": "uniaxial",
                               "stretches": [1.1], "laws": [)";
  const auto refusal = [&](const std::string& law) {
    return complaint(ExitStatus::BadData, [&] { run_kind("homogeneous_state", start + law + "]}"); });
  };
  EXPECT_THAT(refusal(R"({"law": "neo_hooke"})"), HasSubstr("neo_hookean"));
  EXPECT_THAT(refusal(R"({"law": "neo_hookean", "shear_Pa": 1, "lambda_Pa": 1, "bulk_Pa": 1})"), HasSubstr("bulk_Pa"));
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
}

TEST(SolidKinds, AllElementsGiveTheSameHomogeneousState) {
  for (const std::string element : {R"("linear")", R"("patched")", R"("quadratic", "fluctuation_over_shear": 2)"}) {
    const Quantities q =
        run_kind("homogeneous_state", R"({"size_m": [0.1, 0.1, 0.1], "cells": [2, 2, 2], "element": )" + element +
                                          R"(, "state": "uniaxial", "stretches": [1.2],
      "laws": [{"law": "neo_hookean", "young_Pa": 60000, "poisson": 0.49}]})");
    EXPECT_NEAR(q.at("cauchy_Pa(1.2)"), 12117.96, 0.01);
    EXPECT_NEAR(q.at("nominal_Pa(1.2)"), q.at("cauchy_Pa(1.2)") * std::pow(q.at("lateral(1.2)"), 2.0), 1e-3);
    EXPECT_LT(q.at("spread(1.2)"), 1e-8);
  }
}

TEST(SolidKinds, LongQuadraticBeamBendsAsTimoshenkoSays) {
  const Quantities q = run_kind("cantilever", R"({"size_m": [0.4, 0.02, 0.02], "law": "neo_hookean", "young_Pa": 1e5,
    "poissons": [0], "force_N": 1e-6, "element": "quadratic", "fluctuation_over_shear": -1, "meshes": [[40, 2, 2]]})");
  EXPECT_NEAR(q.at("ratio_40x2x2(0)"), 1.0, 3e-3);
  EXPECT_EQ(q.at("spread_40x2x2"), 0.0);
}

/// Loads and ends must mean the same on the cage and on its refinement.
TEST(NestedMuscle, KeepsEndsAndLoadsWhenRefined) {
  const NestedMuscle cage = read_nested_muscle("canine_elbow", "biceps_brachii"), fine = refine_muscle(cage);
  EXPECT_EQ(fine.mesh.corners.size(), 8 * cage.mesh.corners.size());
  const auto solid_of = [](const NestedMuscle& muscle, simulation::ElementKind kind) {
    ElementChoice choice;
    choice.kind = kind;
    return simulation::Solid(uniform_solid(muscle.mesh, choice, {simulation::StableNeoHookean{1.0, 1.0}}), "muscle");
  };
  const simulation::Solid quadratic = solid_of(cage, simulation::ElementKind::Quadratic);
  const simulation::Solid linear = solid_of(fine, simulation::ElementKind::Linear);
  ASSERT_EQ(quadratic.nodes(), linear.nodes());
  EXPECT_EQ(ends_of_nodes(cage, quadratic), ends_of_nodes(fine, linear));
  // The same even load has the same resultant and centre, however it is shared out among nodes.
  const auto centre = [](const simulation::Solid& solid, const Eigen::VectorXd& shares) {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < solid.nodes(); ++n) sum += shares[n] * solid.rest_m().segment<3>(3 * n);
    return sum;
  };
  for (const auto share : {insertion_shares, belly_shares}) {
    const Eigen::VectorXd a = share(cage, quadratic), b = share(fine, linear);
    EXPECT_NEAR(a.sum(), 1.0, 1e-12);
    EXPECT_LT((centre(quadratic, a) - centre(linear, b)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace myotact::measure
