// The plane and the plate over every engine of the layer, on a virtual clock: what myotact fidelity plane and plate
// measure, in short.

#include "measure/fidelity/layer_fidelity.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myotact::measure {
namespace {

void expect_all_met(const LayerFidelity& fidelity) {
  EXPECT_GT(fidelity.figures.size(), 3u);
  for (const Figure& figure : fidelity.figures) {
    EXPECT_TRUE(figure.met()) << figure.what << ": " << figure.value << ' ' << figure.unit << ", goal " << figure.goal;
  }
}

/// Value of a column in the first row with these names in front.
double value_of(const LayerFidelity& fidelity, const std::vector<std::string>& names, const std::string& column) {
  for (std::size_t row = 0; row < fidelity.rows.size(); ++row) {
    if (!std::equal(names.begin(), names.end(), fidelity.rows[row].begin())) continue;
    for (std::size_t i = 0; i < fidelity.values[row].size(); ++i) {
      if (fidelity.columns[fidelity.rows[row].size() + i] == column) return fidelity.values[row][i];
    }
  }
  return std::nan("");
}

TEST(LayerFidelity, the_proxy_is_even_on_the_plane_and_no_rougher_than_the_published_methods) {
  const LayerFidelity plane = measure_plane(scene::load_scene("plane"), Effort::Short);
  expect_all_met(plane);
  for (const std::string& engine : layer_engines()) {
    EXPECT_NEAR(value_of(plane, {engine, "proxy", "steady", "x"}, "press N"), 1.0, 0.05);
  }
  EXPECT_EQ(layer_json(plane), layer_json(measure_plane(scene::load_scene("plane"), Effort::Short)));
}

TEST(LayerFidelity, a_lifted_plate_weighs_its_weight_by_every_grip) {
  const scene::Scene scene = scene::load_scene("plate");
  const LayerFidelity plate = measure_plate(scene, Effort::Short);
  expect_all_met(plate);
  for (const std::string& engine : layer_engines()) {
    // 40 mm, less what weight takes of the hand (300 N/m) and the grip (800 N/m).
    const double weight_N = scene.specimen.bodies[1].mass_kg * scene.settings.gravity_m_s2.norm();
    const double risen_mm = 40.0 - 1e3 * weight_N * (1.0 / 300.0 + 1.0 / 800.0);
    EXPECT_NEAR(value_of(plate, {engine, "own grip"}, "risen mm"), risen_mm, 1.0);
    EXPECT_TRUE(std::isfinite(value_of(plate, {engine, "own grip"}, "settling s")));
  }
}

TEST(LayerFidelity, a_scene_without_a_plate_is_refused) {
  EXPECT_THROW(measure_plate(scene::load_scene("plane"), Effort::Short), Error);
}

TEST(LayerFidelity, what_is_not_there_is_null_in_json) {
  LayerFidelity fidelity;
  fidelity.columns = {"engine", "settling s"};
  fidelity.rows = {{"myotact"}};
  fidelity.values = {{std::nan("")}};
  EXPECT_TRUE(nlohmann::json::parse(layer_json(fidelity))["rows"][0]["settling s"].is_null());
}

}  // namespace
}  // namespace myotact::measure
