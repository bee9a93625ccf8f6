#pragma once

namespace myotact::simulation {

/// What a muscle is made of. Fem: quadratic tets, exact for the model. MassSpring: springs on the linear tets, a
/// preview (spring_net.h). Rigid: its shape alone, carried along by the bones.
enum class TissueModel { Fem, MassSpring, Rigid };

}  // namespace myotact::simulation
