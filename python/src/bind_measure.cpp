#include <string>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "binding.h"
#include "core/error.h"
#include "core/text.h"
#include "gil.h"
#include "live_scene.h"
#include "measure/probe/probe.h"
#include "measure/solve_answer.h"
#include "measure/stiffness_sweep.h"
#include "scene/co_contraction.h"

namespace myotact::python {

namespace {

struct Stopped {};

scene::Scene scene_to_sweep(const SceneChoice& choice, const std::string& joint) {
  scene::Scene scene = read_scene(choice);
  if (scene.specimen.muscles.empty()) {
    throw bad_data(scene.name, "/specimen", "has no muscles that could stiffen a joint; name a limb, such as elbow");
  }
  if (!joint.empty()) scene.co_contraction = scene::co_contraction_of(scene, joint);
  if (!scene.co_contraction) {
    throw bad_data(scene.name, "/co_contraction", "is missing; add it to the scene, or name a joint of the specimen");
  }
  return scene;
}

void require_in_range(const std::vector<double>& angles_rad, const anatomy::Joint& joint) {
  constexpr double kRounding_rad = 1e-9;
  const auto [lowest, highest] = joint.range_rad.at(0);
  for (const double angle_rad : angles_rad) {
    if (angle_rad >= lowest - kRounding_rad && angle_rad <= highest + kRounding_rad) continue;
    throw Error(ExitStatus::Usage, "angles: " + to_text(angle_rad) + " rad is outside the range of the joint " +
                                       joint.key + ", " + to_text(lowest) + " .. " + to_text(highest) + " rad");
  }
}

/// The table of the sweep as CSV. Empty `angles_rad`: the scene's own angle.
std::string stiffness(const SceneChoice& choice, std::vector<double> angles_rad, const std::vector<double>& levels,
                      const std::string& joint) {
  const auto rows = watched([&](const std::function<bool()>& stop) {
    const scene::Scene scene = scene_to_sweep(choice, joint);
    const auto index = static_cast<std::size_t>(scene.co_contraction->joint);
    if (angles_rad.empty()) angles_rad = {scene.joints[index].angle_rad};
    require_in_range(angles_rad, scene.specimen.joints[index]);
    measure::SweepWatch watch;
    watch.stopped = stop;
    return measure::sweep_stiffness(scene, {angles_rad, levels}, watch);
  });
  return measure::stiffness_csv(rows);
}

/// The answer as JSON, and its table as CSV.
std::pair<std::string, std::string> probe(const std::string& surface_file, const std::string& path_file,
                                          const std::string& frames_folder, const py::dict& how) {
  haptics::ContactSettings contact;
  contact.radius_m = how["radius"].cast<double>();
  contact.stiffness_N_m = how["stiffness"].cast<double>();
  contact.static_friction = contact.dynamic_friction = how["friction"].cast<double>();
  contact.damping_Ns_m = 0.0;  // as of the program: forces are those of the spring alone
  const auto rate_hz = how["rate"].cast<double>();
  const auto answer = watched([&](const std::function<bool()>& stop) {
    measure::ProbeInput input;
    input.contact = contact;
    input.rate_hz = rate_hz;
    input.path = measure::load_path(path_file);
    std::vector<std::string> notes;
    const geometry::TriangleMesh surface = measure::load_probe_surface(surface_file, notes);
    std::optional<measure::ProbeFrames> frames;
    if (!frames_folder.empty()) frames.emplace(frames_folder);
    input.surface = &surface;
    input.frames = frames ? &*frames : nullptr;
    return measure::run_probe(input, [&] { return !stop(); });
  });
  return {measure::probe_json(answer.summary), answer.csv};
}

/// The answer as JSON; where it did not converge, its "converged" is false.
std::string solve(const std::string& case_file, const std::string& vtk_file) {
  return watched([&](const std::function<bool()>& stop) -> std::string {
    try {
      const measure::SolveAnswer answer =
          measure::solve_case(measure::load_case(case_file), [&](const measure::SolveProgress&) {
            if (stop()) throw Stopped{};
          });
      if (!vtk_file.empty()) geometry::write_vtk(answer.deformed, answer.results, vtk_file);
      return measure::answer_json(answer);
    } catch (const Stopped&) {
      return "";
    }
  });
}

}  // namespace

void bind_measure(py::module_& module) {
  module.def("stiffness", &stiffness);
  module.def("probe", &probe);
  module.def("solve", &solve);
}

}  // namespace myotact::python
