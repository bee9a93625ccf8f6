#pragma once

#include "anatomy/specimen.h"
#include "exchange/vtk_xml.h"
#include "simulation/simulation.h"

// A limb as ParaView and other programs on VTK open it. World frame, metres; `simulation` is one of the specimen, after
// its last step or settle.

namespace myotact::exchange {

/// The tets of all muscles in one grid, where they are now.
///   points  displacement_m (from the file pose), velocity_m_s, attachment (body, or -1)
///   tets    muscle (index), region (0 belly, 1 tendon, 2 aponeurosis), fibre (unit), stretch, volume_ratio,
///           fibre_stress_Pa, stress_Pa (Cauchy: xx yy zz xy yz xz), von_mises_Pa, pressure_Pa; and of the whole muscle
///           activation, tension_N, fibre_length (over optimal)
///   whole   TimeValue [s], muscle_keys, body_keys
/// NaN where nothing computes it: stresses of muscles that are no finite elements, velocities of those that follow.
VtkPiece vtk_tissue(const anatomy::Specimen& specimen, const simulation::Simulation& simulation);

/// Skins and bones in one surface, where they are now.
///   triangles  part (bones first, then muscles; as part_keys), muscle (index, or -1), and of muscles activation,
///              tension_N, fibre_length, volume_error (volume over that at rest, minus 1); NaN of bones
///   whole      TimeValue [s], part_keys
VtkPiece vtk_surfaces(const anatomy::Specimen& specimen, const simulation::Simulation& simulation);

}  // namespace myotact::exchange
