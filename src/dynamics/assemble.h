#pragma once
/// From the world and its contacts to the contact problem of one step.

#include "core/world.h"
#include "dynamics/contact_law_parameters.h"
#include "solver/problem.h"

namespace talus {

/// Free velocity v + h g of every body, and for each contact the constant c of its relative velocity.
///
/// Normal part: Signorini's condition on U_n + g/h >= 0 for a gap g >= 0 (the gap+/h rule) keeps bodies apart
/// at the next midpoint, q_m + h v, where the next gaps are taken. A contact that the free motion would close
/// within the step, with U_n- < 0, obeys U_n >= -e_n U_n- instead where that is more. An overlap is taken
/// back by overlap_correction of itself. Tangential part: c_t = e_t U_t- for a contact that is or gets
/// closed.
void assemble(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
              ContactProblem& problem);

}  // namespace talus
