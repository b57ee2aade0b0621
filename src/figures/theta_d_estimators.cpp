#include "figures/theta_d_estimators.h"

#include <algorithm>

#include "core/trigonometry.h"
#include "scenario/text.h"

namespace talus::figures {
namespace {

std::string times_gamma_c(double factor, const char* gamma_c) {
  return (factor == 1.0 ? "" : scenario::short_text(factor) + " ") + gamma_c;
}

}  // namespace

std::vector<Estimator> estimators_of(const runs::RunView& run) {
  std::vector<Estimator> estimators = {
      {&analysis::Analysis::dilation, 1, "{/:Italic ε_y}", "onset of dilation, centre of mass"},
      {&analysis::Analysis::dilation, 0, "{/:Italic ε_V}", "onset of dilation, free surface"}};
  const std::vector<analysis::RunThreshold>& thresholds = run.analysis.thresholds;
  for (std::size_t f = thresholds.size(); f-- > 0;)
    estimators.push_back({&analysis::RunThreshold::percolation, f,
                          "span, " + times_gamma_c(thresholds[f].factor, "Γ_c"),
                          "percolation at " + times_gamma_c(thresholds[f].factor, "Gamma_c")});
  for (std::size_t f = thresholds.size(); f-- > 0;)
    estimators.push_back({&analysis::RunThreshold::lc_jump, f,
                          "{/:Italic ℓ_c}, " + times_gamma_c(thresholds[f].factor, "Γ_c"),
                          "jump of the largest l_c at " + times_gamma_c(thresholds[f].factor, "Gamma_c")});
  return estimators;
}

double theta_d_of(const runs::RunView& run, const Estimator& estimator) {
  return degrees(
      analysis::number_of(analysis::quantity_of(estimator.member), run.analysis, estimator.element));
}

const runs::RunView& max_analysed(const std::vector<const runs::RunView*>& runs) {
  const auto found =
      std::ranges::find_if(runs, [](const runs::RunView* run) { return !run->analysis.thresholds.empty(); });
  return found == runs.end() ? *runs.front() : **found;
}

}  // namespace talus::figures
