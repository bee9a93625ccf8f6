#include "app/preview_mark.h"

#include <nlohmann/json.hpp>

namespace myotact::app {

bool is_preview(const scene::Scene& scene, const simulation::Simulation& simulation) {
  return simulation.joint(scene.co_contraction->joint).preview;
}

std::string marked_title(const std::string& title, bool preview) {
  return preview ? title + ": " + kPreviewMark : title;
}

std::string marked_json(const std::vector<measure::StiffnessRow>& rows, bool preview) {
  const std::string plain = measure::stiffness_json(rows);
  if (!preview) return plain;
  nlohmann::json json = nlohmann::json::parse(plain);
  for (nlohmann::json& row : json) row["mark"] = kPreviewMark;
  return json.dump(2) + "\n";
}

}  // namespace myotact::app
