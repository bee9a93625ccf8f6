#pragma once

#include <vector>

#include "anatomy/specimen.h"
#include "messages/local_model.h"
#include "simulation/skin/skin_embedding.h"

namespace myotact::simulation {

/// What each triangle of a muscle's skin is made of, from the tets under its corners at rest: their most frequent
/// region (aponeuroses feel like fascia: both are sheets) and the mean of their fibres, laid into the triangle. One
/// a triangle of the muscle's skin.
std::vector<messages::TriangleTissue> skin_tissue(const anatomy::Muscle& muscle, const SkinEmbedding& embedding);

}  // namespace myotact::simulation
