/// Table of thresholds by their distance to theta_c.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/trigonometry.h"
#include "figures/perturbation_figure.h"

namespace talus::figures {
namespace {

using session::Trial;
using session::TrialEnd;

/// State that needs a push of 0.7 to 1.575 sqrt(g D), with the middle 1.05.
const std::vector<Trial> pushed = {{0.0, 0.0, TrialEnd::rest},
                                   {5.0, 0.0, TrialEnd::avalanche},
                                   {0.7, 0.0, TrialEnd::rest},
                                   {1.575, 0.0, TrialEnd::avalanche}};
const std::vector<Trial> not_at_rest = {{0.0, 0.0, TrialEnd::avalanche}};
const std::vector<Trial> never = {{0.0, 0.0, TrialEnd::rest}, {5.0, 0.0, TrialEnd::rest}};

/// Returns the report of a bed that fails at 20 deg.
std::string report(std::vector<session::PerturbedState> states) {
  RunGroup group{"PBC", std::vector<runs::RunView>(1)};
  group.runs[0].analysis.theta_c = radians(20.0);
  const std::vector<session::PerturbationTable> tables = {{{}, std::move(states)}};
  return perturbation_markdown(group, tables);
}

/// Returns the cells of the first line that begins with a range, without spaces.
std::string row(const std::string& text, const std::string& range) {
  const std::size_t begin = text.find("| " + range);
  std::string line = text.substr(begin, text.find('\n', begin) - begin);
  std::erase(line, ' ');
  return line;
}

TEST(PerturbationReport, takes_the_mean_of_the_two_middle_thresholds_as_the_median_of_an_even_number) {
  EXPECT_EQ(row(report({{19.6, pushed}, {19.8, not_at_rest}}), "0 - 0.5"), "|0-0.5|2|1|0|0|<0.05|0.55|1.05|");
}

TEST(PerturbationReport, takes_the_middle_threshold_of_an_odd_number) {
  EXPECT_EQ(row(report({{19.6, pushed}, {19.7, never}, {19.8, not_at_rest}}), "0 - 0.5"),
            "|0-0.5|3|1|1|0|<0.05|1.05|>5|");
}

}  // namespace
}  // namespace talus::figures
