#include <iostream>

#include <fmt/format.h>

#include "anatomy/calibration_file.h"
#include "anatomy/hinge_chains.h"
#include "app/options.h"
#include "core/file.h"
#include "simulation/simulation.h"

namespace myotact::app {

namespace {

/// Every muscle of finite elements, whatever a scene makes of it: by itself, and on the bones.
void calibrate_all(anatomy::Specimen& specimen, int workers) {
  for (anatomy::Muscle& muscle : specimen.muscles) {
    muscle.fibre_fit.reset();
    muscle.fibre_fit_on_bones.reset();
  }
  simulation::SimulationSettings settings;
  settings.workers = workers;
  for (const auto contact : {simulation::Contact::None, simulation::Contact::Bones}) {
    settings.contact = contact;
    const simulation::Simulation simulation(specimen, settings);
    for (std::size_t m = 0; m < specimen.muscles.size(); ++m) {
      anatomy::Muscle& muscle = specimen.muscles[m];
      auto& fit = contact == simulation::Contact::None ? muscle.fibre_fit : muscle.fibre_fit_on_bones;
      fit = simulation.fibre_fit(static_cast<int>(m));
    }
  }
}

void print_table(const anatomy::Specimen& specimen) {
  std::cout << fmt::format("{:40} {:>12}  {:>8} {:>8} {:>8}\n", "muscle", "force/line", "offset", "scale", "gain");
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    const anatomy::FibreFit& fit = *muscle.fibre_fit;
    std::cout << fmt::format("{:40} {:12.3f}  {:8.3f} {:8.3f} {:8.3f}\n", muscle.key, fit.force, fit.offset, fit.scale,
                             fit.gain);
  }
}

}  // namespace

int calibrate(const Options& options) {
  const std::filesystem::path file = options.file / anatomy::kCalibrationFile;
  // With the joints that scenes make of it: a fit is known again by them.
  anatomy::Specimen specimen = anatomy::with_hinge_chains(anatomy::load_specimen(options.file));
  require_writable(file);
  calibrate_all(specimen, options.workers);
  write_file(file, anatomy::calibration_json(specimen));
  if (options.json)
    std::cout << anatomy::calibration_json(specimen);
  else
    print_table(specimen);
  return static_cast<int>(ExitStatus::Done);
}

}  // namespace myotact::app
