#pragma once

#include "anatomy/specimen.h"

namespace myotact::anatomy {

/// The same specimen with every universal and ball joint as a chain of two or three hinges about its centre. The first
/// hinge keeps the joint's place and key, the others follow at the end of the list as `KEY.2` and `KEY.3`; between them
/// lie links of no account (1 mg), bodies `KEY.link_2`, ... at the end of theirs. Each hinge rotates about its axis
/// after those before it have rotated, so that three axes at right angles are flexion, then abduction, then rotation;
/// near 90 degrees of the second the first and third fall together, which the ranges of a dog's joints stay clear of.
/// Groups, muscles and lines keep their indices. Call once, on a specimen without defects.
Specimen with_hinge_chains(Specimen specimen);

}  // namespace myotact::anatomy
