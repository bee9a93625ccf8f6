#pragma once

namespace myotact::simulation {

/// Random hands and wills act on the built-in forelimb, one script of so many steps after the other, each let go for
/// half a second at its end. Expects that no number is unsound, no tissue is thrown about and no inversion stays.
void run_random_scripts(unsigned scripts, int steps);

}  // namespace myotact::simulation
