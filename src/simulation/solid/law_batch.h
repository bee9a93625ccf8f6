#pragma once

#include <vector>

#include "simulation/element/tet_batch.h"
#include "simulation/solid/law.h"

// Laws at one point of eight tets.

namespace myotact::simulation {

/// Adds stress and tangent of a law, without its volume term and without energy. `activation` 0 .. 1, of all lanes.
void respond(const Law& law, const Point<Eight>& point, double activation, Response<Eight>& response);

/// Sum of the laws' volume terms at the volume ratio J of each point.
VolumeTerm<Eight> volume_terms(const std::vector<Law>& laws, const Eight& J);

/// The same at one point.
VolumeTerm<double> volume_term_at(const std::vector<Law>& laws, double J);

/// Energy density of the laws without their volume terms, and that of the volume terms [Pa].
double shape_energy_Pa(const std::vector<Law>& laws, const Point<double>& point, double activation);
double volume_energy_Pa(const std::vector<Law>& laws, double J);

/// Stress and tangent of the laws, volume terms included, at one point. Its energy is that of the volume terms alone.
Response<double> respond_at(const std::vector<Law>& laws, const Point<double>& point, double activation);

/// A volume term acts at a point of eight tets.
void add_volume_at(const Point<Eight>& point, const VolumeTerm<Eight>& term, Response<Eight>& response);

/// Cuts off the negative eigenvalues of a tangent (9 x 9, packed as in point.h), lane by lane.
void make_definite(std::array<double, kPacked>& C);
void make_definite(std::array<Eight, kPacked>& C);

/// Whether the law has fibres, so that its tets need a direction.
bool needs_fibre(const Law& law);

}  // namespace myotact::simulation
