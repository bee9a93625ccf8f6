#include "remote/frame_fit.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/vector.h"
#include "remote/served_scene.h"

namespace myotact::remote {

namespace {

bool is_place(const std::array<double, 3>& place_m) {
  return to_vec3(place_m).allFinite();
}

std::string wrong_count(const char* what, std::size_t count, std::size_t wanted) {
  return count == wanted ? "" : fmt::format("{} {}; the specimen has {}", count, what, wanted);
}

/// -1 is none.
std::string wrong_index(const char* what, int index, std::size_t count) {
  if (index >= -1 && index < static_cast<int>(count)) return "";
  return fmt::format("{} {}; must be -1 (none) or below {}", what, index, count);
}

template <typename... Texts>
std::string first_of(const Texts&... texts) {
  std::string first;
  ((first = first.empty() ? std::string(texts) : first), ...);
  return first;
}

std::string tool_misfit(const messages::ToolFrame& tool, const anatomy::Specimen& specimen) {
  const bool drawable = is_place(tool.tool_world_m) && is_place(tool.proxy_world_m) && is_place(tool.grip_world_m) &&
                        is_place(tool.force_world_N) && std::isfinite(tool.radius_m) && tool.radius_m >= 0.0;
  return first_of(drawable ? "" : "a tool whose place, force or radius is not a number",
                  wrong_index("grabbed line", tool.grabbed_line, specimen.muscles.size()),
                  wrong_index("touched muscle", tool.touched_muscle, specimen.muscles.size()),
                  wrong_index("grabbed body", tool.grabbed_body, specimen.bodies.size()),
                  wrong_index("touched body", tool.touched_body, specimen.bodies.size()));
}

std::string muscle_misfit(const messages::SceneFrame& frame, const anatomy::Specimen& specimen) {
  const std::size_t muscles = specimen.muscles.size();
  std::string problem = first_of(wrong_count("skins", frame.skins_world_m.size(), muscles),
                                 wrong_count("lines", frame.lines_world_m.size(), muscles),
                                 wrong_count("activations", frame.activations.size(), muscles),
                                 wrong_count("tensions", frame.tensions_N.size(), muscles),
                                 wrong_count("stretches", frame.stretches.size(), muscles),
                                 wrong_count("volume ratios", frame.volume_ratios.size(), muscles),
                                 wrong_count("smallest volume ratios", frame.smallest_volume_ratios.size(), muscles));
  for (std::size_t m = 0; m < muscles && problem.empty(); ++m) {
    problem =
        wrong_count("vertices of a skin", frame.skins_world_m[m].size(), specimen.muscles[m].skin.positions_m.size());
    const auto& line = frame.lines_world_m[m];
    if (!std::all_of(line.begin(), line.end(), is_place)) problem = "a muscle line with a place that is not a number";
  }
  return problem;
}

}  // namespace

std::string misfit(const messages::SceneFrame& frame, const anatomy::Specimen& specimen) {
  std::string problem =
      first_of(wrong_count("body poses", frame.body_poses.size(), specimen.bodies.size()),
               wrong_count("joints", frame.joints.size(), specimen.joints.size()), muscle_misfit(frame, specimen));
  for (const messages::JointFrame& joint : frame.joints) {
    problem = first_of(problem, wrong_count("muscles at a joint", joint.muscles.size(), specimen.muscles.size()));
  }
  if (frame.tools.size() > kMostHands) {
    problem = first_of(problem, fmt::format("{} tools; at most {}", frame.tools.size(), kMostHands));
  }
  for (const messages::ToolFrame& tool : frame.tools) problem = first_of(problem, tool_misfit(tool, specimen));
  for (const auto& spring : frame.springs_world_m) {
    if (!is_place(spring[0]) || !is_place(spring[1])) problem = first_of(problem, "a spring to no place");
  }
  return problem;
}

}  // namespace myotact::remote
