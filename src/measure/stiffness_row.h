#pragma once

#include <string>
#include <vector>

#include "core/json_reader.h"

namespace myotact::measure {

/// What one muscle adds to a row.
struct MusclePart {
  std::string muscle;  // key
  double activation = 0.0;
  double torque_Nm = 0.0;                                 // positive flexes
  double K_schur_Nm_rad = 0.0;                            // of its tissue
  double K_muscle_Nm_rad = 0.0, K_geometry_Nm_rad = 0.0;  // of its line: r^2 k and -(dr/dq) F
};

/// How far one uncertain measure can take K.
struct BandPart {
  std::string cause;
  double down_Nm_rad = 0.0, up_Nm_rad = 0.0;  // >= 0
};

/// One row of stiffness.csv and what only its JSON holds. Numbers that could not be found are NaN.
struct StiffnessRow {
  std::string joint;
  double q_rad = 0.0;
  double common = 0.0, difference = 0.0;
  double K_schur_Nm_rad = 0.0;      // of the quasi-static system
  double K_perturbed_Nm_rad = 0.0;  // from the torque at q -+ the perturbation, activations held
  double K_line_Nm_rad = 0.0;       // of the muscle lines alone, passive joint included
  double net_torque_Nm = 0.0;
  double K_muscle_Nm_rad = 0.0, K_geometry_Nm_rad = 0.0;  // the lines' two parts
  double K_contact_Nm_rad = 0.0;                          // of the tissue: lost if contact forces were held
  double K_passive_Nm_rad = 0.0;
  double K_low_Nm_rad = 0.0, K_high_Nm_rad = 0.0;  // K_schur within what the anatomy leaves open, see stiffness_band.h
  double flexors = 0.0, extensors = 0.0;           // activations of the two driven sides
  double K_gravity_Nm_rad = 0.0;                   // of the weight of the bones, which no other K of the row contains
  bool held = false;       // net torque balanced to within 1e-3 of the stronger side's, before any difference is added
  bool converged = false;  // every static solve of the row did
  bool preview = false;    // mass-spring muscles have a part in it
  std::string stuck_line;  // key of a muscle whose line cannot clear its wrap here, or empty; `why` names it
  std::vector<BandPart> band;
  std::vector<MusclePart> muscles;  // that pull on the joint
  std::string why;                  // see stiffness_reason.h
};

std::string stiffness_csv(const std::vector<StiffnessRow>& rows);

/// A list of objects; numbers in their shortest round-trip text, NaN as null. Rows of a preview carry `mark`.
nlohmann::json stiffness_json(const std::vector<StiffnessRow>& rows);

/// What stiffness_json() wrote, to the bit. Throws Error BadData.
std::vector<StiffnessRow> read_stiffness_rows(const JsonValue& list);

}  // namespace myotact::measure
