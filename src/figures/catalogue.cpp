#include "figures/catalogue.h"

#include <array>

#include "figures/recipes.h"

namespace talus::figures {

std::span<const FigureRecipe> figure_catalogue() {
  using enum Material;
  static constexpr FigureRecipe recipes[] = {
      {"fig04-shear-stress", "Normalised shear stress against tan(theta) (paper, Fig. 4)", values,
       Subject::packing, "a run", shear_stress_figure},
      {"fig05-stress-ratio", "Stress ratio of the packing against sin(theta) (paper, Fig. 5)", values,
       Subject::packing, "a run", stress_ratio_figure},
      {"fig06-wall-stress", "Stress sigma_xx along a bed between walls (paper, Fig. 6)", frames,
       Subject::walls, "a bed between walls that has failed", wall_stress_figure},
      {"fig07-wall-ratio", "Shear stress at failure over the length between walls (paper, Fig. 7)", values,
       Subject::walls, "a bed between walls that has failed", wall_ratio_figure},
      {"fig08-stress-ratio-density", "Distribution of the stress ratio of grains (paper, Fig. 8)",
       distributions, Subject::overload,
       "a periodic bed that has failed, or has a threshold by --set gamma_c", gamma_density_figure},
      {"fig09-overloaded-fraction", "Overloaded fraction over tilt (paper, Fig. 9)", values,
       Subject::overload, "a periodic bed that has failed, or has a threshold by --set gamma_c",
       overloaded_fraction_figure},
      {"fig10-stress-ratio-maps", "Maps of the stress ratio of each grain (paper, Fig. 10)", frames,
       Subject::overload, "a run that has failed", gamma_maps},
      {"fig11-neighbourhoods", "Growing neighbourhoods of an overloaded grain (paper, Fig. 11)", frames,
       Subject::overload, "a run that has failed, with overloaded grains in the middle of its bed",
       neighbourhoods_figure},
      {"fig12-coarse-graining-length",
       "Coarse-graining length of overloaded grains over tilt (paper, Fig. 12)", values, Subject::overload,
       "a periodic bed that has failed, or has a threshold by --set gamma_c", length_figure},
      {"fig13-overloaded-maps", "Maps of the overloaded grains (paper, Fig. 13)", frames, Subject::overload,
       "a run that has failed", overload_maps},
      {"fig14-volume-strain", "Volume strain over tilt, and theta_d by each estimator (paper, Fig. 14)",
       values, Subject::packing, "a periodic bed", volume_strain_figure},
      {"overloaded-over-scale", "Overloaded fraction over the size of neighbourhoods", frames,
       Subject::overload, "a periodic bed that has failed", overload_scale_figure},
      {"contact-directions", "Directions of contact normals", distributions, Subject::packing,
       "a run that has failed", contact_directions},
      {"force-chains", "Force chains just before failure", frames, Subject::further, "a run that has failed",
       force_chains},
      {"force-distribution", "Distribution of the normal forces", distributions, Subject::further,
       "a run that has failed", force_distribution},
      {"critical-contacts", "Contacts with fully mobilised friction", values, Subject::further,
       "a run that has failed", critical_contacts_figure},
      {"correlations", "Correlation of forces and stresses over distance", distributions, Subject::further,
       "a run that has failed", correlations},
      {"dynamic-angle", "Angle at rest against theta_c and theta_d", values, Subject::further,
       "a run with tilt.after_failure whose flow has stopped", dynamic_angle_figure},
      {"cycles", "Cycles of the tilt, and what accumulates over them", frames, Subject::further,
       "a run whose tilt falls at least once before failure", cycles_figure},
      {"angle-distributions", "Distribution of theta_c, theta_d and theta_r over the runs", values,
       Subject::further, "at least two runs of an ensemble that have such an angle", angle_distributions},
      {"angle-correlations", "Correlation of theta_c, theta_d and theta_r over the runs", values,
       Subject::further, "at least two runs of an ensemble that have two such angles", angle_correlations},
      {"over-tilt", "Quantities of the analysis over tilt", values, Subject::further, "a run",
       quantities_over_tilt},
      {"before-failure", "Quantities of the analysis over the angle left to failure", values,
       Subject::further, "a run that has failed", quantities_before_failure},
      {"precursors", "What precedes failure in the contacts", values, Subject::further,
       "a run that has failed", precursors_figure},
      {"weak-contacts", "Directions of weak contacts over their mobilised friction", distributions,
       Subject::further, "a run that has failed", weak_contacts_figure},
      {"persistence", "Persistence of the force network", frames, Subject::further, "a run that has failed",
       persistence_figure},
      {"events", "Rearrangements on the way to failure", frames, Subject::further,
       "a run with rearrangements (talus events)", event_figure},
      {"difference-over-tilt", "Difference of two groups of runs over tilt", values, Subject::further,
       "exactly two groups of runs", differences_over_tilt},
      {"difference-before-failure", "Difference of two groups of runs over the angle left to failure", values,
       Subject::further, "exactly two groups of runs that have failed", differences_before_failure},
  };
  return recipes;
}

}  // namespace talus::figures
