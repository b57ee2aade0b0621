#pragma once
/// The contact problem of one step, formed from the world and its contacts (docs/theory.md).

#include "base/thread_team.h"
#include "core/world.h"
#include "dynamics/contact_law_parameters.h"
#include "solver/problem.h"

namespace talus::dynamics {

/// Forms the contact problem: the bodies with their free velocities v + h g (T4), which are 0 for bodies that
/// do not move, including planes; then the local frames of the contacts, their friction, and the constant c
/// of their relative velocities (T5).
///
/// Normal part: Signorini's condition on U_n + g/h >= 0 for a gap g >= 0 (T11) keeps bodies apart at the next
/// midpoint, q_m + h v, at which the next gaps are computed. The share overlap_correction of the excess of an
/// overlap over the allowed one is removed. Overlaps up to ten times the allowed one, and gaps up to a
/// twentieth of it in contacts that bear load, are errors of earlier solves. They are not corrected faster
/// than the `tolerance` of a solve lets them arise, relative to the forces remembered in `contacts`. A
/// contact that the free motion would close within the step, with U_n- < 0, obeys U_n >= -e_n U_n- instead if
/// that is larger (T12). Tangential part: c_t = e_t U_t- for a contact that is closed or closes. A team, if
/// given, does the work together; the result is the same.
void form_problem(const World& world, const Contacts& contacts, const ContactLawParameters& law, double h,
                  double tolerance, solver::ContactProblem& problem, ThreadTeam* team = nullptr);

}  // namespace talus::dynamics
