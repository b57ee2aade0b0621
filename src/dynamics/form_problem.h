#pragma once
/// From the world and its contacts to the contact problem of one step (docs/theory.md).

#include "base/thread_team.h"
#include "core/world.h"
#include "dynamics/contact_law_parameters.h"
#include "solver/problem.h"

namespace talus::dynamics {

/// The bodies, and the free velocity v + h g of each (T4); those that do not move, planes among them, have
/// none. Then the local frames of the contacts, their friction, and the constant c of the relative velocity
/// of each (T5).
///
/// Normal part: Signorini's condition on U_n + g/h >= 0 for a gap g >= 0 (T11) keeps bodies apart at the next
/// midpoint, q_m + h v, where the next gaps are taken. An overlap is taken back by overlap_correction of what
/// it is above the allowed one. Overlaps up to ten allowed ones, and gaps up to a twentieth of one where a
/// contact bears load, are errors of the solves before: they are taken back no faster than the `tolerance` of
/// a solve lets them arise, relative to the forces that `contacts` remembers. A contact that the free motion
/// would close within the step, with U_n- < 0, obeys U_n >= -e_n U_n- instead where that is more (T12).
/// Tangential part: c_t = e_t U_t- for a contact that is or gets closed. Shared out to the team, if there is
/// one; the result is the same.
void form_problem(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                  double tolerance, solver::ContactProblem& problem, ThreadTeam* team = nullptr);

}  // namespace talus::dynamics
