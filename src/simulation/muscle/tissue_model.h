#pragma once

namespace myotact::simulation {

/// What a muscle is made of. Fem: quadratic tets, exact for the model. MassSpring: springs on the linear tets, a
/// preview (spring_net.h). Line: a musculotendon unit along its line (line_tissue.h), its shape carried along by the
/// bones. Rigid: its shape alone.
enum class TissueModel { Fem, MassSpring, Line, Rigid };

}  // namespace myotact::simulation
